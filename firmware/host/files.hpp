// SPDX-License-Identifier: Apache-2.0
// Whole files in and out. Errors are std::runtime_error with a one-line message that names the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace striker::host {

[[nodiscard]] std::string read_file(const std::filesystem::path& file);

// Written to a temporary file beside it, then renamed: the file is whole or not there.
void write_file(const std::filesystem::path& file, std::string_view content);

// Throws unless a file can be made in this directory (which is made if it is missing).
void require_writable(const std::filesystem::path& directory);

}  // namespace striker::host
