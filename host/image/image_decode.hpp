// An image file as its values, decoded by brume-image. Private to host/image; what the values mean is image_read.cpp's.
#pragma once
#include <filesystem>

#include "image/image.hpp"
#include "image/image_protocol.hpp"

namespace brume {

struct DecodedImage {
  Image image;  // integers scaled to [0,1]
  Samples samples;
};
DecodedImage image_decode(const std::filesystem::path& file);

}  // namespace brume
