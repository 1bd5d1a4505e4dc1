// SPDX-License-Identifier: Apache-2.0
// Prints the message table as a DBC file, for candump users, cantools, canmatrix, SavvyCAN and the like.
#pragma once

#include <string_view>

namespace striker::can {

// Takes the next piece of text; `context` is the caller's.
using PutText = void (*)(void* context, std::string_view text);

void print_dbc(PutText put, void* context);

}  // namespace striker::can
