// A film into an image file: linear with its AOVs as layers (.exr), or through the display curve (.png, .jpg).
#pragma once
#include <filesystem>
#include <vector>

#include "film/film.hpp"
#include "film/film_partial.hpp"
#include "image/image.hpp"
#include "shared/transfer.h"

namespace brume {

struct FilmWriteOptions {
  double exposure = 0;     // stops, display formats only
  std::vector<Aov> aovs;   // linear formats only
  ImageMetadata metadata;  // linear formats only; stored as "brume:<key>"
  bool alpha =
      false;  // a channel A, for a film without background: multiplied in in .exr, not in .png, left out in .jpg
  const SampleCover* cover = nullptr;  // of a film that others can be joined to: linear formats keep its sums
  ImageWindow window{};                // of the pixels that were rendered: all that is stored, in linear formats
  int transfer = TRANSFER_GAMMA;       // display formats only
};

// R, G, B, A where there is one, and those of the planes.
int film_channels(const std::vector<Aov>& aovs, bool alpha);

// The extension decides: linear radiance R, G, B, A and layers such as "normal.X", or display values. Errors: those of
// image_write_exr and image_write_display. To fail before the rendering, call image_check_writable first.
void film_write(const Film& film, const std::filesystem::path& file, const FilmWriteOptions& options);

// The radiance as an image with channels R, G, B, as a written .exr reads back; of the pixels [lo, hi), or all.
Image film_image(const Film& film, glm::ivec2 lo, glm::ivec2 hi);
inline Image film_image(const Film& film) { return film_image(film, {0, 0}, film.size()); }

}  // namespace brume
