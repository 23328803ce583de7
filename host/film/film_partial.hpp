// A picture in part: which samples of which pixels a film holds, and the .exr file that keeps its sums, so that parts
// can be joined and renders go on.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "film/film.hpp"
#include "image/image.hpp"

namespace brume {

// Samples [first, first + count) of a pixel.
struct SampleRange {
  std::uint32_t first, count;
  std::uint32_t end() const { return first + count; }
  bool operator==(const SampleRange& other) const { return first == other.first && count == other.count; }
};

// The samples that each pixel holds. Almost always one range, or none.
class SampleCover {
 public:
  explicit SampleCover(std::size_t pixels) : layers_(1, std::vector<SampleRange>(pixels)) {}

  std::size_t pixels() const { return layers_.front().size(); }
  bool has_none(std::size_t pixel) const { return layers_.front()[pixel].count == 0; }
  std::vector<SampleRange> of(std::size_t pixel) const;  // ascending, with gaps between them
  // The first sample of `range` that the pixel holds.
  std::optional<std::uint32_t> held(std::size_t pixel, SampleRange range) const;
  void add(std::size_t pixel, SampleRange range);  // of which it holds none yet
  // What the pixel lacks of `wanted`, ascending.
  std::vector<SampleRange> missing(std::size_t pixel, SampleRange wanted) const;

  // Layer k has the k-th range of every pixel, of count 0 where there are fewer.
  const std::vector<std::vector<SampleRange>>& layers() const { return layers_; }
  ImageWindow window(int width) const;  // the smallest that has all pixels with samples; all 0: none has

 private:
  std::vector<std::vector<SampleRange>> layers_;
};

// Keys of the metadata by which two parts belong together, in the order in which they are told: version, size, spp,
// seed, scene_hash; "brume:" stands before them in a file.
const std::vector<std::string>& part_keys();

// "x,y" of pixel number `pixel` of a film of this width, for messages.
std::string pixel_text(std::size_t pixel, int width);

struct FilmPart {
  std::string source;      // the file, for messages
  ImageMetadata metadata;  // without the "brume:"
  Film film;
  SampleCover cover;
  int spp;  // of the whole picture

  const std::string& value(const std::string& key) const;  // "" where there is none
};

// Channels "brume.*" that hold a film's sums and its cover bit for bit. The film must outlive them.
struct PartChannels {
  PartChannels(const Film& film, const SampleCover& cover);
  std::vector<ImageChannel> channels;

 private:
  std::vector<std::vector<float>> planes_;  // of what is no float in the film
};

// Why a film of that size is not kept in part (its file could not be read again); "" if it can be. other_channels: R,
// G, B and planes beside; layers: of its cover.
std::string part_size_problem(glm::ivec2 size, int other_channels, std::size_t layers = 1);

// InputError, naming file and cause, for what is no such file, for a damaged one, and those of image_read.
FilmPart film_part_read(const std::filesystem::path& file);

// InputError, naming the file, the key and both values, where a part is not one of the picture that `source` is (part
// of).
void film_parts_match(const std::string& source, const ImageMetadata& metadata, const FilmPart& part);

}  // namespace brume
