// Levels of detail: where a volume stands and how dense it is does not depend on its level.
#include <cmath>

#include "closed_form.hpp"

namespace brume::test {
namespace {

// Optical depths of a medium, pixel by pixel, in a view along -z.
std::vector<double> depths(const std::string& medium, int level, int size) {
  const std::string text = R"({"camera": {"type": "orthographic", "eye": [0, 0, 5], "target": [0, 0, 0], "height": 2.5},
    "film": {"size": [)" + std::to_string(size) +
                           "," + std::to_string(size) + R"(]}, "background": [1, 1, 1],
    "media": [{)" + medium +
                           R"(, "sigma_a": 0.5}], "render": {"method": "dda_gauss2"}})";
  const PlannedScene scene =
      flatten(scene_read_text(text, "levels.json", {"/render/level=" + std::to_string(level)}), {bvh_width_for(8), {}});
  Film film({size, size});
  Renderer(pocl(), scene, {8, true, 0}).render(film, [](double) { return true; });
  std::vector<double> depths;
  for (const FilmPixel& pixel : film.pixels()) depths.push_back(-std::log(double(pixel.radiance.y)));
  return depths;
}

TEST(Levels, AConstantDensityIsTheSame) {
  for (const char* medium : {R"("density": {"type": "constant", "resolution": [23, 10, 31], "value": 0.7},
                                "bounds": [[-1, -0.5, -0.8], [0.7, 0.6, 1.1]])",
                             R"("density": {"type": "constant", "resolution": [1, 1, 1]})"}) {
    const std::vector<double> full = depths(medium, 0, 24);
    for (const int level : {1, 2, 8}) {
      const std::vector<double> its = depths(medium, level, 24);
      for (std::size_t i = 0; i < full.size(); ++i) EXPECT_NEAR(its[i], full[i], 2e-6) << medium << level << " " << i;
    }
  }
}

// Away from the borders, where half a voxel of it is cut flat.
TEST(Levels, ARampStaysWhereItIs) {
  const char* ramp = R"("density": {"type": "linear", "resolution": [96, 41, 33]})";
  const std::vector<double> full = depths(ramp, 0, 25), half = depths(ramp, 1, 25);
  double largest = 0;
  for (int y = 7; y < 18; ++y)
    for (int x = 7; x < 18; ++x) {
      const auto i = static_cast<std::size_t>(y * 25 + x);
      EXPECT_NEAR(half[i], full[i], 2e-3 * full[i]) << x << "," << y;
      largest = std::max(largest, full[i]);
    }
  EXPECT_GT(largest, 0.3);
}

// Of a grid that fades into nothing as well: the sum over all rays is that of the voxels, and so is its centre to a
// fraction of a voxel, of which some ten pixels show one (level 2).
TEST(Levels, KeepWhatAllRaysSumUpTo) {
  const std::string smoke = R"("density": {"type": "file", "path": ")" + std::string(BRUME_SOURCE_DIR) +
                            R"(/scenes/data/tank_08.vdb"}, "transform": [{"translate": [0, -0.3, 0]}])";
  for (const std::string& medium :
       {smoke, std::string(R"("density": {"type": "ball", "resolution": [45, 47, 43], "radius": 0.6})")}) {
    const auto moments = [&](int level) {
      std::array<double, 3> sum{};
      const std::vector<double> all = depths(medium, level, 200);
      for (std::size_t i = 0; i < all.size(); ++i) {
        sum[0] += all[i];
        sum[1] += all[i] * double(i % 200);
        sum[2] += all[i] * std::floor(double(i) / 200);
      }
      return std::array<double, 3>{sum[0], sum[1] / sum[0], sum[2] / sum[0]};
    };
    const auto full = moments(0);
    for (const int level : {1, 2}) {
      const auto its = moments(level);
      EXPECT_NEAR(its[0], full[0], 5e-3 * full[0]) << medium << ", level " << level;
      EXPECT_NEAR(its[1], full[1], 0.3) << "pixels along x, level " << level;
      EXPECT_NEAR(its[2], full[2], 0.3) << "pixels along y, level " << level;
    }
  }
}

}  // namespace
}  // namespace brume::test
