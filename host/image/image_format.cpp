// The rows of the format table and the two ways of looking one up.
#include "image/image_format.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "image/image_png.hpp"

namespace brume {

using namespace std::string_view_literals;

namespace {
// Twice what is decoded at most: doubles, and mip maps.
constexpr std::size_t IMAGE_FILE_BYTES_MAX = std::size_t(2) << 30;
}  // namespace

const std::vector<ImageFormat>& image_formats() {
  static const std::vector<ImageFormat> formats = {
      {"exr", "openexr", {".exr"}, {"\x76\x2f\x31\x01"sv}, ImageOutput::LINEAR, true},
      {"png", "png", {".png"}, {"\x89PNG\r\n\x1a\n"sv}, ImageOutput::DISPLAY, true, png_encode},
      {"jpg", "jpeg", {".jpg", ".jpeg"}, {"\xff\xd8\xff"sv}, ImageOutput::DISPLAY, false},
      {"hdr", "hdr", {".hdr"}, {"#?RADIANCE"sv, "#?RGBE"sv}, ImageOutput::NONE, true},
      {"tif", "tiff", {".tif", ".tiff"}, {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv}, ImageOutput::NONE, true},
  };
  return formats;
}

std::string image_output_extensions() {
  std::string list;
  for (const ImageFormat& format : image_formats())
    if (format.output != ImageOutput::NONE)
      for (std::string_view extension : format.extensions) list += (list.empty() ? "" : ", ") + std::string(extension);
  return list;
}

const ImageFormat& image_format_of_output(const std::filesystem::path& file) {
  const std::string extension = file_ending(file);
  for (const ImageFormat& format : image_formats()) {
    const auto& known = format.extensions;
    if (format.output != ImageOutput::NONE && std::find(known.begin(), known.end(), extension) != known.end())
      return format;
  }
  throw InputError(file.string() + ": cannot write images of type '" + extension +
                   "'; known: " + image_output_extensions());
}

const ImageFormat& image_format_of_content(const std::filesystem::path& file) {
  const std::string head = file_head(file, 16, IMAGE_FILE_BYTES_MAX, "an image");
  std::string names;
  for (const ImageFormat& format : image_formats()) {
    for (std::string_view magic : format.magics)
      if (std::string_view(head).substr(0, magic.size()) == magic) return format;
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  throw InputError(file.string() + ": is not an image of a known format (by its content); known: " + names);
}

}  // namespace brume
