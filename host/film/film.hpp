// The finished picture: linear radiance and named planes, and the sums from which they come.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/family.hpp"
#include "shared/aov.h"

namespace brume {

// BRUME_AOVS: id = Aov.
const Family& aov_family();
int aov_channels(Aov aov);
// Names of its channels in a file: "depth.Z", "normal.X", ...
std::vector<std::string> aov_channel_names(Aov aov);

// Adds the sums of samples of the same pixel that `sum` does not hold yet. To a pixel without samples: an exact copy.
void film_pixel_merge(FilmPixel& sum, const FilmPixel& part);

// One named plane: `channels` floats per pixel, row 0 at the top.
struct Plane {
  std::string name;  // "rgb" for the radiance, else the AOV's name
  int channels;
  std::vector<float> values;
};

class Film {
 public:
  Film(glm::ivec2 size) : size_(size), pixels_(std::size_t(size.x) * size.y) {}

  glm::ivec2 size() const { return size_; }
  std::vector<FilmPixel>& pixels() { return pixels_; }
  const std::vector<FilmPixel>& pixels() const { return pixels_; }
  Film cut(glm::ivec2 lo, glm::ivec2 hi) const;  // the pixels [lo, hi) as a film of their own

  Plane radiance() const { return radiance({0, 0}, size_); }  // sums / samples; 0 where nothing was rendered
  Plane radiance(glm::ivec2 lo, glm::ivec2 hi) const;         // the same of the pixels [lo, hi)
  Plane alpha() const;       // 1 - transmittance to the background, mean of its channels; 0 where nothing was rendered
  Plane aov(Aov aov) const;  // see BRUME_AOVS; where nothing was rendered: depth inf, the others 0

 private:
  glm::ivec2 size_;
  std::vector<FilmPixel> pixels_;
};

}  // namespace brume
