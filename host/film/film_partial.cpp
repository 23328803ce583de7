// The channels of a part and their way back. See film_partial.hpp.
#include "film/film_partial.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "base/error.hpp"
#include "image/image_protocol.hpp"

namespace brume {

namespace {

// A float of FilmPixel and its channel.
struct Field {
  const char* name;
  std::size_t offset;
};

#define SUM(name) \
  { "brume." #name, offsetof(FilmPixel, name) }
#define VECTOR(name)                                                             \
  {"brume." #name ".X", offsetof(FilmPixel, name) + offsetof(Packed3, x)},       \
      {"brume." #name ".Y", offsetof(FilmPixel, name) + offsetof(Packed3, y)}, { \
    "brume." #name ".Z", offsetof(FilmPixel, name) + offsetof(Packed3, z)        \
  }
constexpr Field FIELDS[] = {
    VECTOR(radiance), VECTOR(squares), VECTOR(normal),   VECTOR(transmittance), SUM(samples),      SUM(depth),
    SUM(hits),        SUM(lookups),    SUM(shadow_rays), SUM(secondary_rays),   SUM(dropped_rays), SUM(dropped_weight),
    SUM(invalid),     SUM(clear),      SUM(error),
};
#undef SUM
#undef VECTOR
static_assert(sizeof(FilmPixel) == std::size(FIELDS) * sizeof(float) + sizeof(FilmPixel::key), "every field is kept");

// A float holds 24 bits of the key's 32.
constexpr const char *KEY_LOW = "brume.key.low", *KEY_HIGH = "brume.key.high";
constexpr std::uint32_t HALF = 1u << 16;
constexpr float WHOLE_MAX = 1 << 24;  // whole numbers that a float holds

std::string first_name(std::size_t layer) { return "brume.cover." + std::to_string(layer) + ".first"; }
std::string count_name(std::size_t layer) { return "brume.cover." + std::to_string(layer) + ".count"; }

[[noreturn]] void fail(const std::string& source, const std::string& cause) {
  throw InputError(source + ": is no partial picture to go on from: " + cause);
}

int channel_need(const Image& image, const std::string& name) {
  const int channel = image_channel(image, name);
  if (channel < 0) fail(image.source, "it has no channel '" + name + "'");
  return channel;
}

// Values of one channel, one after another.
class Channel {
 public:
  Channel(const Image& image, const std::string& name)
      : image_(image), name_(name), channel_(std::size_t(channel_need(image, name))) {}
  float at(std::size_t pixel) const { return image_.values[pixel * std::size_t(image_.channels) + channel_]; }
  std::uint32_t whole_at(std::size_t pixel, float end) const {
    const float value = at(pixel);
    if (!(value >= 0 && value < end) || value != std::floor(value)) {
      fail(image_.source, "damaged: '" + name_ + "' of pixel " + pixel_text(pixel, image_.width) + " is " +
                              std::to_string(value) + ", not a whole number below " +
                              std::to_string(std::uint32_t(end)));
    }
    return static_cast<std::uint32_t>(value);
  }

 private:
  const Image& image_;
  std::string name_;
  std::size_t channel_;
};

std::size_t pixel_count(const Image& image) { return std::size_t(image.width) * std::size_t(image.height); }

void read_sums(const Image& image, Film& film) {
  for (const Field& field : FIELDS) {
    const Channel channel(image, field.name);
    for (std::size_t i = 0; i < pixel_count(image); ++i) {
      const float value = channel.at(i);
      std::memcpy(reinterpret_cast<char*>(&film.pixels()[i]) + field.offset, &value, sizeof value);
    }
  }
  const Channel low(image, KEY_LOW), high(image, KEY_HIGH);
  for (std::size_t i = 0; i < pixel_count(image); ++i)
    film.pixels()[i].key = low.whole_at(i, HALF) + HALF * high.whole_at(i, HALF);
}

void read_cover(const Image& image, int spp, SampleCover& cover) {
  for (std::size_t layer = 0; layer == 0 || image_channel(image, first_name(layer)) >= 0; ++layer) {
    const Channel first(image, first_name(layer)), count(image, count_name(layer));
    for (std::size_t i = 0; i < pixel_count(image); ++i) {
      const SampleRange range{first.whole_at(i, WHOLE_MAX), count.whole_at(i, WHOLE_MAX)};
      if (range.end() > std::uint32_t(spp) || cover.held(i, range))
        fail(image.source, "damaged: pixel " + pixel_text(i, image.width) + " holds samples " +
                               std::to_string(range.first) + "-" + std::to_string(range.end() - 1) +
                               " twice or beyond the " + std::to_string(spp) + " of the picture");
      cover.add(i, range);
    }
  }
}

// What the sums say of their number of samples is what the cover says.
void check_counts(const FilmPart& part) {
  for (std::size_t i = 0; i < part.cover.pixels(); ++i) {
    double held = 0;
    for (const SampleRange& range : part.cover.of(i)) held += range.count;
    const FilmPixel& pixel = part.film.pixels()[i];
    if (double(pixel.samples) + double(pixel.invalid) == held) continue;
    fail(part.source, "damaged: pixel " + pixel_text(i, part.film.size().x) + " holds " + std::to_string(held) +
                          " samples, its sums are those of " +
                          std::to_string(double(pixel.samples) + double(pixel.invalid)));
  }
}

int whole_number(const FilmPart& part, const std::string& key) {
  const std::string& text = part.value(key);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1)
    fail(part.source, "damaged: brume:" + key + " is '" + text + "', not a number from 1 on");
  return value;
}

}  // namespace

const std::vector<std::string>& part_keys() {
  static const std::vector<std::string> keys = {"version", "size", "spp", "seed", "scene_hash"};
  return keys;
}

std::string pixel_text(std::size_t pixel, int width) {
  return std::to_string(pixel % std::size_t(width)) + "," + std::to_string(pixel / std::size_t(width));
}

const std::string& FilmPart::value(const std::string& key) const {
  static const std::string none;
  const std::string* found = metadata_find(metadata, key);
  return found ? *found : none;
}

PartChannels::PartChannels(const Film& film, const SampleCover& cover) {
  const std::vector<FilmPixel>& pixels = film.pixels();
  for (const Field& field : FIELDS)
    channels.push_back({field.name,
                        reinterpret_cast<const float*>(reinterpret_cast<const char*>(pixels.data()) + field.offset),
                        sizeof(FilmPixel) / sizeof(float)});
  const auto add = [&](const std::string& name, auto value) {
    std::vector<float>& plane = planes_.emplace_back(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) plane[i] = static_cast<float>(value(i));
    channels.push_back({name, plane.data()});
  };
  add(KEY_LOW, [&](std::size_t i) { return pixels[i].key % HALF; });
  add(KEY_HIGH, [&](std::size_t i) { return pixels[i].key / HALF; });
  for (std::size_t k = 0; k < cover.layers().size(); ++k) {
    add(first_name(k), [&](std::size_t i) { return cover.layers()[k][i].first; });
    add(count_name(k), [&](std::size_t i) { return cover.layers()[k][i].count; });
  }
}

std::string part_size_problem(glm::ivec2 size, int other_channels, std::size_t layers) {
  constexpr int KEY_CHANNELS = 2;
  return image_size_problem(size.x, size.y, int(std::size(FIELDS)) + KEY_CHANNELS + 2 * int(layers) + other_channels);
}

FilmPart film_part_read(const std::filesystem::path& file) {
  const Image image = image_read(file);
  FilmPart part{image.source, {}, Film({image.width, image.height}), SampleCover(pixel_count(image)), 0};
  for (const auto& [key, value] : image.metadata) part.metadata.emplace_back(key.substr(METADATA_PREFIX.size()), value);
  for (const std::string& key : part_keys())
    if (!metadata_find(part.metadata, key)) fail(part.source, "it has no attribute 'brume:" + key + "'");
  const std::string size = std::to_string(image.width) + "x" + std::to_string(image.height);
  if (part.value("size") != size)
    fail(part.source, "damaged: brume:size is '" + part.value("size") + "', the picture " + size);
  part.spp = whole_number(part, "spp");
  read_sums(image, part.film);
  read_cover(image, part.spp, part.cover);
  check_counts(part);
  return part;
}

void film_parts_match(const std::string& source, const ImageMetadata& metadata, const FilmPart& part) {
  const auto refuse = [&](const std::string& key, const std::string& wanted) {
    throw InputError(part.source + ": is no part of the picture of " + source + ": brume:" + key + " is " +
                     part.value(key) + " and not " + wanted);
  };
  for (const std::string& key : part_keys()) {
    const std::string* wanted = metadata_find(metadata, key);
    if (wanted && *wanted != part.value(key)) refuse(key, *wanted);
  }
}

}  // namespace brume
