// SPDX-License-Identifier: Apache-2.0
// Which Striker a program is, for --version and for reports: written anew when the sources' commit has changed.
#pragma once

#include <string_view>

namespace striker::host {

// As "0.2.0": the project's version.
[[nodiscard]] std::string_view version();

// The commit that was built, as 12 hexadecimal digits; "-dirty" after it if tracked files differed from it;
// "unknown" if the sources were in no git repository of their own.
[[nodiscard]] std::string_view git_hash();

// CMake's, as "Release".
[[nodiscard]] std::string_view build_type();

// All three, as the last fields of a JSON report (nlohmann::ordered_json).
template <class Json>
void stamp(Json& report) {
  report["version"] = version();
  report["git_hash"] = git_hash();
  report["build_type"] = build_type();
}

}  // namespace striker::host
