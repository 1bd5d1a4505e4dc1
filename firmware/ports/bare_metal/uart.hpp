// A board's serial port, letter by letter.
#pragma once

namespace striker::bare_metal::uart {

void start();
[[nodiscard]] bool has_letter();
[[nodiscard]] char take_letter();
void put_letter(char letter);  // waits for room

}  // namespace striker::bare_metal::uart
