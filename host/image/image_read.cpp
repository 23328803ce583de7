// What decoded values mean: textures become linear RGB here. No files and no library.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "image/image_decode.hpp"

namespace brume {

namespace {

// The channels that a texture takes its red, green and blue from: by name, else the first three, else a grey one.
std::array<int, 3> texture_channels(const Image& image) {
  const std::array<int, 3> rgb = {image_channel(image, "R"), image_channel(image, "G"), image_channel(image, "B")};
  if (rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0) return rgb;
  if (image.channels >= 3) return {0, 1, 2};
  const int grey = image.channels == 2 && image.channel_names[0] == "A" ? 1 : 0;
  return {grey, grey, grey};
}

// Linear value of every integer code.
std::vector<float> srgb_table(int max_code) {
  std::vector<float> table(std::size_t(max_code) + 1);
  for (int code = 0; code <= max_code; ++code)
    table[std::size_t(code)] = static_cast<float>(srgb_decode(double(code) / max_code));
  return table;
}

// Back to the integer code, so that the decoding does not depend on how the library scaled it.
void decode_integers(std::vector<float>& values, int max_code) {
  const std::vector<float> table = srgb_table(max_code);
  for (float& value : values)
    value = table[std::size_t(std::clamp(std::lround(value * float(max_code)), 0L, long(max_code)))];
}

// Of texels with three channels: how many had one that is no radiance.
std::size_t clean(std::vector<float>& values) {
  std::size_t cleaned = 0;
  for (std::size_t texel = 0; texel + 2 < values.size(); texel += 3) {
    bool bad = false;
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = values[texel + c];
      if (std::isfinite(value) && value >= 0) continue;
      value = 0;
      bad = true;
    }
    cleaned += bad;
  }
  return cleaned;
}

}  // namespace

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

int image_channel(const Image& image, const std::string& name) {
  const auto& names = image.channel_names;
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

const std::string* metadata_find(const ImageMetadata& metadata, const std::string& key) {
  for (const auto& [name, value] : metadata)
    if (name == key) return &value;
  return nullptr;
}

Image image_read(const std::filesystem::path& file) { return image_decode(file).image; }

Image image_read_texture(const std::filesystem::path& file) {
  const DecodedImage decoded = image_decode(file);
  const Image& from = decoded.image;
  if (decoded.samples == Samples::OTHER_INTEGER)
    throw InputError(from.source + ": textures hold 8- or 16-bit unsigned integers, half or float, not other integers");
  const std::array<int, 3> channels = texture_channels(from);
  Image texture{from.width, from.height, 3, {}, {"R", "G", "B"}, from.from_integers, 0, from.source};
  const std::size_t pixels = std::size_t(from.width) * std::size_t(from.height);
  texture.values.resize(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      texture.values[i * 3 + c] = from.values[i * std::size_t(from.channels) + std::size_t(channels[c])];
  if (decoded.samples == Samples::UINT8) decode_integers(texture.values, 255);
  if (decoded.samples == Samples::UINT16) decode_integers(texture.values, 65535);
  texture.cleaned = clean(texture.values);
  return texture;
}

}  // namespace brume
