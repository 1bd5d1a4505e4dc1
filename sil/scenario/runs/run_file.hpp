// SPDX-License-Identifier: Apache-2.0
// A results file of many runs: whole lines of JSON, one a run. Each ends with a digest of itself and of the header, so
// that a line which was edited, or is of another file, is told instead of counted:
//
//   {"run":7, ... ,"digest":"0123456789abcdef"}
//
// 16 hexadecimal digits: FNV-1a of 64 bits (Fowler, Noll, Vo: draft-eastlake-fnv) over the header, an end of line, and
// the line without its digest. It finds what happens to files, not who forges them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sil/scenario/runs/run_lock.hpp"

namespace striker::sil {

class RunFile {
 public:
  // `header` is the first line, which says what the runs are of. A file with another one is refused
  // (std::runtime_error). The runs of a file that is there are read; an incomplete last line is cut off. One program at
  // a time: another one's file is refused; of an mpirun the first process stands for all.
  RunFile(std::filesystem::path file, std::string header);

  // What is there, by number, without digests.
  [[nodiscard]] const std::map<std::uint64_t, std::string>& runs() const { return runs_; }
  // Throws std::runtime_error with the file and line that is no run, was edited, or tells a run that is there otherwise.
  void read_again();

  // Several processes may append at once: a line is one write. `line` is a JSON object with "run".
  void append(std::uint64_t number, const std::string& line);
  // Writes all anew, sorted; also what others have appended.
  void finish();

 private:
  void cut_incomplete_line() const;
  void take(int line_number, std::string_view line);
  [[nodiscard]] std::string signed_line(const std::string& line) const;

  std::filesystem::path file_;
  std::string header_;
  std::optional<RunLock> lock_;
  std::map<std::uint64_t, std::string> runs_;
};

}  // namespace striker::sil
