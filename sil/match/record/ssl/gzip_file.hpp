// SPDX-License-Identifier: Apache-2.0
// A compressed file that is there whole or not at all, without a name or a time in its header: same content, same
// bytes, with the same zlib.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "firmware/host/atomic_file.hpp"

struct z_stream_s;  // zlib's

namespace striker::sil {

// Everything throws std::runtime_error with one line that names the file.
class GzipFile {
 public:
  explicit GzipFile(const std::filesystem::path& file);
  ~GzipFile();
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  void write(std::string_view bytes);
  void finish();

 private:
  void deflate_all(int flush);

  host::AtomicFile file_;
  std::unique_ptr<z_stream_s> stream_;
};

}  // namespace striker::sil
