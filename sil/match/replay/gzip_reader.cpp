// SPDX-License-Identifier: Apache-2.0
#include "sil/match/replay/gzip_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace striker::sil {

namespace {

constexpr int gzip_window_bits = 15 + 16;
constexpr std::string_view gzip_mark = "\x1f\x8b";

}  // namespace

GzipReader::GzipReader(const std::filesystem::path& file)
    : file_(file), input_(file, std::ios::binary), loaded_(), inflated_() {
  if (!input_ || std::filesystem::is_directory(file)) {
    throw std::runtime_error(
        fmt::format("{}: cannot be read ({})", file.string(),
                    input_ ? "it is a directory" : std::generic_category().message(errno)));
  }
  load();
  if (!std::string_view(loaded_.data(), size_).starts_with(gzip_mark)) {
    return;
  }
  stream_ = std::make_unique<z_stream>();
  stream_->next_in = reinterpret_cast<const Bytef*>(loaded_.data());
  stream_->avail_in = static_cast<uInt>(size_);
  if (inflateInit2(stream_.get(), gzip_window_bits) != Z_OK) {
    fail("cannot be read: there is no memory");
  }
}

GzipReader::~GzipReader() {
  if (stream_) {
    inflateEnd(stream_.get());
  }
}

void GzipReader::fail(const char* what) const {
  throw std::runtime_error(fmt::format("{}: {}", file_.string(), what));
}

void GzipReader::load() {
  input_.read(loaded_.data(), static_cast<std::streamsize>(loaded_.size()));
  size_ = static_cast<std::size_t>(input_.gcount());
  if (input_.bad()) {
    fail("cannot be read to its end");
  }
}

std::string_view GzipReader::next() {
  if (stream_) {
    return inflated();
  }
  const std::size_t size = std::exchange(size_, 0);
  if (size == 0) {
    load();
    return {loaded_.data(), std::exchange(size_, 0)};
  }
  return {loaded_.data(), size};
}

std::string_view GzipReader::inflated() {
  std::size_t size = 0;
  while (!is_whole_ && size == 0) {
    if (stream_->avail_in == 0) {
      load();
      stream_->next_in = reinterpret_cast<const Bytef*>(loaded_.data());
      stream_->avail_in = static_cast<uInt>(size_);
    }
    if (stream_->avail_in == 0) {
      fail("cannot be read to its end: it was cut off");
    }
    stream_->next_out = reinterpret_cast<Bytef*>(inflated_.data());
    stream_->avail_out = static_cast<uInt>(inflated_.size());
    const int result = inflate(stream_.get(), Z_NO_FLUSH);
    if (result != Z_OK && result != Z_STREAM_END) {
      fail("cannot be read to its end: it is damaged");
    }
    is_whole_ = result == Z_STREAM_END;
    size = inflated_.size() - stream_->avail_out;
  }
  if (size == 0 && (stream_->avail_in != 0 || input_.peek() != std::ifstream::traits_type::eof())) {
    fail("holds something behind its end, which was not compressed with it");
  }
  return {inflated_.data(), size};
}

std::string read_gzip_file(const std::filesystem::path& file) {
  GzipReader reader(file);
  std::string content;
  for (auto piece = reader.next(); !piece.empty(); piece = reader.next()) {
    content += piece;
  }
  return content;
}

}  // namespace striker::sil
