// SPDX-License-Identifier: Apache-2.0
// Every byte that a file holds, gzipped or not: NULs as they are, and nothing behind the end of what was compressed,
// which zlib's own gzread would pass over.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

struct z_stream_s;  // zlib's

namespace striker::sil {

// Everything throws std::runtime_error with one line that names the file.
class GzipReader {
 public:
  explicit GzipReader(const std::filesystem::path& file);
  ~GzipReader();
  GzipReader(const GzipReader&) = delete;
  GzipReader& operator=(const GzipReader&) = delete;

  // What comes next, in pieces as they fall; empty at the end. Valid until the next call.
  [[nodiscard]] std::string_view next();

 private:
  using Buffer = std::array<char, 1U << 14U>;

  void load();
  [[nodiscard]] std::string_view inflated();
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path file_;
  std::ifstream input_;
  Buffer loaded_;
  Buffer inflated_;
  std::unique_ptr<z_stream_s> stream_;  // none: the file is not compressed
  std::size_t size_ = 0;                // of what is loaded
  bool is_whole_ = false;               // the end of what was compressed has come
};

// All of it.
[[nodiscard]] std::string read_gzip_file(const std::filesystem::path& file);

}  // namespace striker::sil
