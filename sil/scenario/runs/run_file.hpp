// SPDX-License-Identifier: Apache-2.0
// A results file of many runs: whole lines of JSON, one a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace striker::sil {

class RunFile {
 public:
  // `header` is the first line, which says what the runs are of. A file with another one is refused
  // (std::runtime_error). The runs of a file that is there are read; an incomplete last line is cut off.
  RunFile(std::filesystem::path file, std::string header);

  // What is there, by number.
  [[nodiscard]] const std::map<std::uint64_t, std::string>& runs() const { return runs_; }
  void read_again();

  // Several processes may append at once: a line is one write.
  void append(std::uint64_t number, const std::string& line);
  // Writes all anew, sorted.
  void finish();

 private:
  void cut_incomplete_line() const;

  std::filesystem::path file_;
  std::string header_;
  std::map<std::uint64_t, std::string> runs_;
};

}  // namespace striker::sil
