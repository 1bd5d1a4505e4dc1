// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/ssl/gzip_file.hpp"

#include <zlib.h>

#include <array>
#include <cstddef>
#include <stdexcept>

namespace striker::sil {
namespace {

constexpr int fast = 3;  // a third of the time of zlib's own choice, for files that are a fifth larger
constexpr int gzip_window_bits = 15 + 16;
constexpr int memory_level = 8;

}  // namespace

GzipFile::GzipFile(const std::filesystem::path& file) : file_(file), stream_(std::make_unique<z_stream>()) {
  if (deflateInit2(stream_.get(), fast, Z_DEFLATED, gzip_window_bits, memory_level, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::runtime_error(file.string() + ": cannot be compressed: there is no memory");
  }
}

GzipFile::~GzipFile() {
  deflateEnd(stream_.get());
}

void GzipFile::write(std::string_view bytes) {
  stream_->next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream_->avail_in = static_cast<uInt>(bytes.size());
  deflate_all(Z_NO_FLUSH);
}

void GzipFile::finish() {
  deflate_all(Z_FINISH);
  file_.finish();
}

// Until zlib has nothing more to give: it fills the buffer as long as it has.
void GzipFile::deflate_all(int flush) {
  std::array<char, 1U << 14U> buffer;
  do {
    stream_->next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream_->avail_out = static_cast<uInt>(buffer.size());
    deflate(stream_.get(), flush);
    file_.write({buffer.data(), buffer.size() - stream_->avail_out});
  } while (stream_->avail_out == 0);
}

}  // namespace striker::sil
