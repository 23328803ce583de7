// Display values → the bytes of a PNG file. Private to host/image.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace brume {

// 3 or 4 channels of 8 bits, sRGB, alpha not multiplied in. std::runtime_error, with libpng's words, where it cannot.
std::string png_encode(int width, int height, int channels, const std::vector<std::uint8_t>& codes);

}  // namespace brume
