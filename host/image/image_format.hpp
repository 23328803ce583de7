// The table of image formats: how each is recognised and what is written to it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace brume {

enum class ImageOutput { NONE, LINEAR, DISPLAY };

struct ImageFormat {
  std::string_view name;                     // for messages
  std::string_view plugin;                   // OpenImageIO's name of the format
  std::vector<std::string_view> extensions;  // lower case, with the dot
  std::vector<std::string_view> magics;      // what a file of this format begins with
  ImageOutput output;
  bool alpha;  // it can hold one
  // Bytes of the file from 8-bit display values; null: asked of brume-image.
  std::string (*encode)(int width, int height, int channels, const std::vector<std::uint8_t>& codes) = nullptr;
};
const std::vector<ImageFormat>& image_formats();

// By the extension, in any case. InputError for one without a writer.
const ImageFormat& image_format_of_output(const std::filesystem::path& file);

// By the first bytes of the file. InputError where it cannot be opened or is none of the formats.
const ImageFormat& image_format_of_content(const std::filesystem::path& file);

// ".exr, .png, .jpg, .jpeg"
std::string image_output_extensions();

}  // namespace brume
