// Text of unknown origin on its way to a terminal or into JSON.
#pragma once
#include <string>
#include <string_view>

namespace brume {

// On one line and in UTF-8: control characters become "?", bytes that are no UTF-8 "\xE4". What is UTF-8 stays.
std::string text_printable(std::string_view text);

}  // namespace brume
