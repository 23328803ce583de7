// Sums to means: how each plane follows from a pixel's sums. One row per AOV; no files, no tone curve.
#include "film/film.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace brume {

namespace {

using Values = std::array<float, 3>;

Values scaled(const Packed3& sum, double factor) {
  return {static_cast<float>(sum.x * factor), static_cast<float>(sum.y * factor), static_cast<float>(sum.z * factor)};
}

Values mean(const Packed3& sum, float count) { return count > 0 ? scaled(sum, 1.0 / double(count)) : Values{}; }

Values depth_of(const FilmPixel& pixel) {
  return {pixel.hits > 0 ? pixel.depth / pixel.hits : std::numeric_limits<float>::infinity()};
}

// The sum of unit vectors is shorter than its count where a pixel sees several surfaces: unit length again.
Values normal_of(const FilmPixel& pixel) {
  const Packed3& n = pixel.normal;
  const double length = std::hypot(double(n.x), double(n.y), double(n.z));
  return length > 0 ? scaled(n, 1.0 / length) : Values{};
}

Values transmittance_of(const FilmPixel& pixel) { return mean(pixel.transmittance, pixel.samples); }

Values cost_of(const FilmPixel& pixel) { return {pixel.samples > 0 ? pixel.lookups / pixel.samples : 0.0f}; }

Values variance_of(const FilmPixel& pixel) { return mean(pixel.squares, pixel.samples - 1); }

Values samples_of(const FilmPixel& pixel) { return {pixel.samples}; }

// Both parts are independent: of the walk in each sample, and of the samples as a set.
Values error_of(const FilmPixel& pixel) {
  const double n = pixel.samples;
  if (!(n > 0)) return {};
  const double squares = (double(pixel.squares.x) + pixel.squares.y + pixel.squares.z) / 3;
  return {static_cast<float>(std::sqrt(std::pow(pixel.error / n, 2) + (n > 1 ? squares / (n * (n - 1)) : 0)))};
}

void packed_add(Packed3& sum, const Packed3& part) {
  sum.x += part.x;
  sum.y += part.y;
  sum.z += part.z;
}

// na samples with the sum a and the squared deviations `squares` from their mean, and nb with b and `more`: deviations
// from the common mean are larger, by d² na nb / (na + nb) in all, d the difference of the means [Chan82].
float squares_merged(double squares, double a, double na, double more, double b, double nb) {
  if (!(na > 0 && nb > 0)) return static_cast<float>(squares + more);
  const double d = b / nb - a / na;
  return static_cast<float>(squares + more + d * d * na * nb / (na + nb));
}

Packed3 squares_merged(const FilmPixel& p, const FilmPixel& q) {
  const double n = p.samples, m = q.samples;
  return {squares_merged(p.squares.x, p.radiance.x, n, q.squares.x, q.radiance.x, m),
          squares_merged(p.squares.y, p.radiance.y, n, q.squares.y, q.radiance.y, m),
          squares_merged(p.squares.z, p.radiance.z, n, q.squares.z, q.radiance.z, m)};
}

// Every field but the vectors, `squares` and the key is a plain sum.
constexpr float FilmPixel::*SUMS[] = {&FilmPixel::samples,      &FilmPixel::depth,          &FilmPixel::hits,
                                      &FilmPixel::lookups,      &FilmPixel::shadow_rays,    &FilmPixel::secondary_rays,
                                      &FilmPixel::dropped_rays, &FilmPixel::dropped_weight, &FilmPixel::invalid,
                                      &FilmPixel::clear,        &FilmPixel::error};
static_assert(sizeof(FilmPixel) == sizeof(SUMS) / sizeof(*SUMS) * sizeof(float) + 4 * sizeof(Packed3) + sizeof(uint),
              "film_pixel_merge adds every field");

struct AovRow {
  const char* name;
  int channels;
  const char* letters;  // of the channels within the layer
  Values (*values)(const FilmPixel&);
};

constexpr const char* LETTERS[] = {"Z", "XYZ", "RGB", "Y", "RGB", "Y", "Y"};
constexpr Values (*VALUES[])(const FilmPixel&) = {depth_of,    normal_of,  transmittance_of, cost_of,
                                                  variance_of, samples_of, error_of};
static_assert(std::size(LETTERS) == AOV_COUNT && std::size(VALUES) == AOV_COUNT, "one entry per row of BRUME_AOVS");

const AovRow AOVS[] = {
#define ROW(id, name, channels, help) {name, channels, LETTERS[AOV_##id], VALUES[AOV_##id]},
    BRUME_AOVS(ROW)
#undef ROW
};

}  // namespace

void film_pixel_merge(FilmPixel& sum, const FilmPixel& part) {
  sum.squares = squares_merged(sum, part);  // reads the other sums
  packed_add(sum.radiance, part.radiance);
  packed_add(sum.normal, part.normal);
  packed_add(sum.transmittance, part.transmittance);
  for (float FilmPixel::*field : SUMS) sum.*field += part.*field;
  sum.key += part.key;
}

const Family& aov_family() {
  static const Family family = {
#define ROW(id, name, channels, help) {AOV_##id, name, help},
      BRUME_AOVS(ROW)
#undef ROW
  };
  return family;
}

int aov_channels(Aov aov) { return AOVS[aov].channels; }

std::vector<std::string> aov_channel_names(Aov aov) {
  std::vector<std::string> names;
  for (const char* letter = AOVS[aov].letters; *letter; ++letter)
    names.push_back(std::string(AOVS[aov].name) + "." + *letter);
  return names;
}

Plane Film::radiance(glm::ivec2 lo, glm::ivec2 hi) const {
  const glm::ivec2 part = hi - lo;
  Plane plane{"rgb", 3, std::vector<float>(std::size_t(part.x) * std::size_t(part.y) * 3)};
  auto value = plane.values.begin();
  for (int y = lo.y; y < hi.y; ++y) {
    const auto row = pixels_.begin() + std::ptrdiff_t(y) * size_.x;
    for (auto pixel = row + lo.x; pixel != row + hi.x; ++pixel)
      for (const float one : mean(pixel->radiance, pixel->samples)) *value++ = one;
  }
  return plane;
}

Film Film::cut(glm::ivec2 lo, glm::ivec2 hi) const {
  Film part(hi - lo);
  for (int y = lo.y; y < hi.y; ++y) {
    const auto row = pixels_.begin() + std::ptrdiff_t(y) * size_.x;
    std::copy(row + lo.x, row + hi.x, part.pixels_.begin() + std::ptrdiff_t(y - lo.y) * part.size_.x);
  }
  return part;
}

Plane Film::alpha() const {
  Plane plane{"alpha", 1, {}};
  plane.values.reserve(pixels_.size());
  for (const FilmPixel& pixel : pixels_)
    plane.values.push_back(pixel.samples > 0 ? std::fmax(1 - pixel.clear / pixel.samples, 0.0f) : 0.0f);
  return plane;
}

Plane Film::aov(Aov aov) const {
  const AovRow& row = AOVS[aov];
  Plane plane{row.name, row.channels, {}};
  plane.values.reserve(pixels_.size() * std::size_t(row.channels));
  for (const FilmPixel& pixel : pixels_) {
    const Values values = row.values(pixel);
    plane.values.insert(plane.values.end(), values.begin(), values.begin() + row.channels);
  }
  return plane;
}

}  // namespace brume
