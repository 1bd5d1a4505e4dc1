// SPDX-License-Identifier: Apache-2.0
// Whole files in and out. Errors are std::runtime_error with a one-line message that names the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace striker::host {

// More than any text has that a person writes: for `read_file`.
inline constexpr std::size_t most_text_bytes = std::size_t{16} << 20U;

// A pipe and a device are read, too: of what has more than `most_bytes`, such as /dev/zero, no more than that is, and it is
// refused. Takes memory of twice its size, and a second a GiB.
[[nodiscard]] std::string read_file(const std::filesystem::path& file,
                                    std::size_t most_bytes = std::size_t{1} << 30U);

// Written to a temporary file beside it, then renamed: the file is whole or not there.
void write_file(const std::filesystem::path& file, std::string_view content);

// Throws unless a file can be made in this directory (which is made if it is missing).
void require_writable(const std::filesystem::path& directory);

}  // namespace striker::host
