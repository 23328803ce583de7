// See pictures.hpp.
#include "chart/pictures.hpp"

#include <algorithm>
#include <cmath>

#include "film/film_compare.hpp"
#include "film/film_display.hpp"

namespace brume {

namespace {

// Stops of "inferno" of matplotlib, evenly spaced: brightness grows evenly along it.
constexpr std::array<float, 3> RAMP[] = {{0.001f, 0.000f, 0.014f}, {0.258f, 0.039f, 0.406f}, {0.578f, 0.148f, 0.404f},
                                         {0.865f, 0.317f, 0.226f}, {0.988f, 0.645f, 0.040f}, {0.988f, 0.998f, 0.645f}};

int block_of(const Image& image) {
  return std::max(1, (std::max(image.width, image.height) + PICTURE_SIDE - 1) / PICTURE_SIDE);
}

double mean_of(const Image& image) {
  double sum = 0;
  for (const float value : image.values) sum += std::abs(value);
  return sum / static_cast<double>(image.values.size());
}

}  // namespace

std::array<float, 3> error_color(double relative) {
  constexpr std::size_t LAST = std::size(RAMP) - 1;
  const double share = std::log(relative / ERROR_LO) / std::log(ERROR_HI / ERROR_LO);
  const double place = (share > 0 ? std::min(share, 1.0) : 0) * LAST;  // of error 0, and of no number: black
  const std::size_t below = std::min(static_cast<std::size_t>(place), LAST - 1);
  const float t = static_cast<float>(place - static_cast<double>(below));
  std::array<float, 3> color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = RAMP[below][c] + t * (RAMP[below + 1][c] - RAMP[below][c]);
  return color;
}

void picture_write(const Image& image, const FilmDesc& film, const std::filesystem::path& file) {
  const Image small = block_means(image, block_of(image));
  image_write_display(file, small.width, small.height, film_display(small.values, film.exposure, film.transfer));
}

void error_map_write(const Image& image, const Image& exact, const std::filesystem::path& file) {
  const double mean = mean_of(exact);
  Image errors{image.width, image.height, 1, {}, {"Y"}, false, 0, "errors"};
  for (std::size_t i = 0; i < image.values.size(); i += 3) {
    float largest = 0;
    for (std::size_t c = i; c < i + 3; ++c) largest = std::max(largest, std::abs(image.values[c] - exact.values[c]));
    errors.values.push_back(static_cast<float>(mean > 0 ? largest / mean : largest));
  }
  const Image small = block_means(errors, block_of(errors));
  std::vector<float> colors;
  for (const float error : small.values)
    for (const float value : error_color(error)) colors.push_back(value);
  image_write_display(file, small.width, small.height, colors);
}

}  // namespace brume
