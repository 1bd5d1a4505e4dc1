// SPDX-License-Identifier: Apache-2.0
// The live page, whole: striker_view.html with its scripts in it, put into the program by the build.
#pragma once

#include <string_view>

namespace striker::sil {

[[nodiscard]] std::string_view view_page();

}  // namespace striker::sil
