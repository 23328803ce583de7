// Densities in any unit, and values that float does not hold.
#include "render/program.hpp"
#include "stability/worlds.hpp"
#include "volume/formats/openvdb.hpp"

namespace brume::test {
namespace {

std::string fog_text(const std::string& density, double factor, const std::string& render) {
  return R"({"camera": {"eye": [3.5, 3.5, 40], "target": [3.5, 3.5, 3.5], "vfov": 15}, "background": 0.1,
    "lights": [{"type": "directional", "direction": [-1, -1, -1], "irradiance": 10}],
    "media": [{"bounds": [[0, 0, 0], [8, 8, 8]], "density": )" +
         density + R"(, "sigma_a": )" + number_text(0.05 / factor) + R"(, "sigma_s": )" + number_text(0.2 / factor) +
         R"(, "emission": )" + number_text(0.02 / factor) + R"(}], "render": {)" + render + "}}";
}

TEST(DensityUnit, OnlyDensityTimesCoefficientMatters) {
  const std::pair<const char*, double> renders[] = {
      {R"("method": "auto")", 1e-5},
      {R"("method": "dda_gauss2")", 1e-5},
      {R"("method": "march_midpoint")", 1e-5},
      {R"("method": "ratio_tracking")", 1e-5},
      {R"("method": "delta_tracking")", 1e-5},
      {R"("method": "dda_midpoint", "storage": "f16")", 1e-3},  // rounds densities
      {R"("method": "dda_midpoint", "storage": "u8")", 1e-5},
      {R"("method": "dda_midpoint", "shadow": "grid", "light_grid": 8)", 1e-5}};
  for (const auto& [render, limit] : renders) {
    const auto film = [render = render](double factor) {
      return film_of(
          scene_of(fog_text(R"({"type": "constant", "resolution": [8, 8, 8], "value": )" + number_text(factor) + "}",
                            factor, render),
                   "", 12));
    };
    const Film base = film(1);
    for (const double factor : {1e-37, 1e-21, 1e21, 1e37})
      expect_same(film(factor), base, limit, std::string(render) + " " + number_text(factor));
  }
}

using DensityUnitOfFiles = Program;

TEST_F(DensityUnitOfFiles, OnlyDensityTimesCoefficientMatters) {
  const auto film = [this](float factor) {
    Grid grid{ivec3(8)};
    for (int i = 0; i < 512; ++i) grid.set({i % 8, i / 8 % 8, i / 64}, factor * (0.5f + 0.01f * float(i * 37 % 97)));
    vdb_write(grid, folder_ / "a.vdb");
    return film_of(scene_of(fog_text(R"({"type": "file", "path": "a.vdb"})", factor, ""), folder_, 12));
  };
  const Film base = film(1);
  expect_shows(base, "file");
  for (const float factor : {1e-30f, 1e-10f, 1e10f, 1e37f}) expect_same(film(factor), base, 1e-5, number_text(factor));
}

// A light on a surface is brighter there than float holds: those samples are counted, the others stay.
TEST(NotFinite, IsCountedAndLeftOut) {
  const PlannedScene scene = scene_of(R"({"camera": {"eye": [0, 0, 3]}, "film": {"spp": 4}, "background": 0.25,
    "lights": [{"type": "point", "position": [0, 0, 0.01], "intensity": 3e33}],
    "shapes": [{"type": "quad", "corner": [-0.5, -0.5, 0]}]})");
  const Film film = film_of(scene), reference = reference_of(scene);
  double invalid = 0, expected = 0, seen = 0;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    const FilmPixel& p = film.pixels()[i];
    ASSERT_TRUE(std::isfinite(p.radiance.x + p.depth + p.normal.z + p.transmittance.x)) << i;
    ASSERT_EQ(p.samples + p.invalid, 4) << i;
    invalid += p.invalid;
    expected += reference.pixels()[i].invalid;
    seen += p.hits > 0;
  }
  EXPECT_GT(invalid, 10);
  EXPECT_NEAR(invalid, expected, 2);
  EXPECT_GT(seen, 10);
}

}  // namespace
}  // namespace brume::test
