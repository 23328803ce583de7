// An image file as its values, decoded in a child process. Private to host/image; what the values mean is
// image_read.cpp's.
#pragma once
#include <filesystem>

#include "image/image.hpp"

namespace brume {

enum class Samples { UINT8, UINT16, OTHER_INTEGER, FLOATING };

struct DecodedImage {
  Image image;  // integers scaled to [0,1]
  Samples samples;
};
DecodedImage image_decode(const std::filesystem::path& file);

// Limits and threads of OpenImageIO; every function of this folder that enters the library calls it first.
void image_library_setup();

}  // namespace brume
