// By libpng itself: the picture that is asked for most often does not wait for all that the image library brings.
#include "image/image_png.hpp"

#include <png.h>

#include <cstring>
#include <stdexcept>

namespace brume {

namespace {

// Of the filtered rows as deflate stores them at worst (5 bytes in 16 KB), in chunks of 8 KB with 12 bytes of their
// own.
std::size_t bytes_at_most(std::size_t row_bytes, std::size_t rows) {
  const std::size_t raw = (row_bytes + 1) * rows;
  return raw + raw / 256 + 4096;
}

}  // namespace

std::string png_encode(int width, int height, int channels, const std::vector<std::uint8_t>& codes) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  png_alloc_size_t bytes = bytes_at_most(std::size_t(width) * std::size_t(channels), std::size_t(height));
  std::string file(bytes, '\0');
  if (!png_image_write_to_memory(&image, file.data(), &bytes, 0, codes.data(), 0, nullptr))
    throw std::runtime_error(image.message);
  file.resize(bytes);
  return file;
}

}  // namespace brume
