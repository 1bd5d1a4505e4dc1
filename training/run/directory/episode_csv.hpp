// SPDX-License-Identifier: Apache-2.0
// A table whose first column counts episodes: kept in memory, written whole, and read back when a run is
// resumed. Errors are std::runtime_error with one line that names the file.
#pragma once

#include <filesystem>
#include <string>

namespace striker::training {

class EpisodeCsv {
 public:
  // `header` is its first line, with the line's end.
  EpisodeCsv(std::filesystem::path file, std::string header);

  void reserve(int rows);  // room for so many, so that adding them allocates nothing
  void add(const std::string& line) { text_ += line; }
  void write() const;

  // From the file: the header and exactly the first `rows` rows, numbered from 0; later ones are dropped.
  void keep(int rows);
  // From the file: the header and the rows up to this episode.
  void keep_up_to(int episode);

 private:
  [[nodiscard]] std::string content() const;

  std::filesystem::path file_;
  std::string header_;
  std::string text_;
};

}  // namespace striker::training
