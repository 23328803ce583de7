// Numbers in messages.
#pragma once
#include <cstdio>
#include <string>

namespace brume {

// Small ones as they are: "-1e-09", not "-0.000000".
inline std::string number_text(double value, int digits = 6) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace brume
