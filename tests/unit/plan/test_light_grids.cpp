// Light grids (shared/light_grid.h): where their points lie, and what is interpolated between them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "plan/planned_scene.hpp"
#include "reference/light_grid.hpp"
#include "reference/render.hpp"
#include "scene/scene_reader.hpp"

namespace brume::reference {
namespace {

// A rotated box of unequal sides and voxels under one light.
PlannedScene fog_under(const std::string& light, int cells) {
  const std::string text = R"({
    "camera": {"eye": [0, 0, 5], "target": [0, 0, 0]}, "lights": [)" +
                           light + R"(],
    "media": [{"bounds": [[-1, -0.5, -0.8], [1, 0.5, 0.8]], "transform": [{"rotate": [0, 1, 0.2, 25]}], "sigma_a": 0.5, "sigma_s": 1.5,
               "density": {"type": "perlin", "resolution": [19, 12, 17], "scale": 2, "seed": 3}}],
    "render": {"shadow": "grid", "light_grid": )" +
                           std::to_string(cells) + "}}";
  return flatten(scene_read_text(text, "fog.json", {}), {});
}

std::string sun(const std::string& direction) {
  return R"({"type": "directional", "direction": [)" + direction + R"(], "irradiance": [1, 1, 1]})";
}

// Each axis, both ways; along an axis of the box, halfway between two, along a diagonal of the box.
std::vector<std::string> suns() {
  return {sun("0.3, -1, 0.4"),   sun("-0.3, 1, 0.2"), sun("1, 0.2, -0.5"), sun("-1, 0.6, 0.3"), sun("0.1, 0.4, 1"),
          sun("0.7, 0.1, -0.8"), sun("0, 1, 0.2"),    sun("1, 0, 1"),      sun("2, 1, 1.6")};
}

// Points of a medium's box in cell space, the outermost `inset` of the way between two from its sides.
template <typename Visit>
void each_point(const Medium& medium, double inset, const Visit& visit) {
  constexpr int N = 9;
  const dvec3 lo = vec_promote(medium.lo), size = vec_promote(medium.hi) - lo;
  for (int z = 0; z <= N; ++z)
    for (int y = 0; y <= N; ++y)
      for (int x = 0; x <= N; ++x) visit(lo + size * ((dvec3(x, y, z) + inset) / (N + 2 * inset)));
}

TEST(LightGrids, ColumnsRunAlongTheLight) {
  for (const std::string& light : suns()) {
    const PlannedScene scene = fog_under(light, 11);
    ASSERT_EQ(scene.light_grids.size(), 1u);
    const LightGrid& grid = scene.light_grids[0];
    EXPECT_LE(std::fabs(grid.slope_u), 1) << light;
    EXPECT_LE(std::fabs(grid.slope_v), 1) << light;
    const Affine& world = scene.placed[0].world_from_cell;
    const dvec3 along =
        affine_direction(world, affine_direction(grid.cell_from_grid, dvec3(0, 0, grid.from_first ? 1 : -1)));
    const dvec3 travel = vec_promote(scene.lights[0].direction) * static_cast<double>(grid.column_step);
    EXPECT_LT(glm::length(along - travel), 1e-5 * grid.column_step) << light;
  }
}

TEST(LightGrids, EveryPlaneHoldsThePointsAboutItsBox) {
  for (const std::string& light : suns()) {
    const PlannedScene scene = fog_under(light, 11);
    const LightGrid& grid = scene.light_grids[0];
    each_point(scene.medium(0), 0, [&](const dvec3& p) {
      const dvec3 g = affine_point(grid.grid_from_cell, p);
      EXPECT_GE(g.z, -1e-5) << light;
      EXPECT_LE(g.z, grid.nk - 1 + 1e-5) << light;
      const int k0 = std::min(static_cast<int>(std::floor(g.z)), grid.nk - 2);
      for (const int k : {k0, k0 + 1}) {
        if (std::fabs(g.z - k) >= 1 - 1e-5) continue;  // this plane counts for nothing
        const double u = g.x - std::floor(grid.slope_u * static_cast<float>(k));
        const double v = g.y - std::floor(grid.slope_v * static_cast<float>(k));
        EXPECT_GE(u, 0) << light;
        EXPECT_LT(u, grid.nu - 1) << light;
        EXPECT_GE(v, 0) << light;
        EXPECT_LT(v, grid.nv - 1) << light;
      }
    });
  }
}

// Root mean square of the difference of transmittances to the light between grid and traced rays.
double rms_of(const PlannedScene& scene) {
  const Context context(scene, {});
  const Medium medium = scene.medium(0);
  double sum = 0, count = 0;
  each_point(medium, 0.3, [&](const dvec3& p) {
    const dvec3 point = affine_point(medium.world_from_cell, p);
    const LightSample light = light_at(scene, scene.lights[0], point, {});
    double lookups = 0;
    const dvec3 traced = media_tau(context, {point, -light.travel}, light.distance, {}, lookups);
    const dvec3 blended = light_grid_tau(context.light_depths[0], scene.light_grids[0], medium, 0, point);
    sum += std::pow(std::exp(-traced.x) - std::exp(-blended.x), 2);
    ++count;
  });
  return std::sqrt(sum / count);
}

TEST(LightGrids, ConvergeToTracedRays) {
  std::vector<std::string> lights = suns();
  lights.emplace_back(R"({"type": "point", "position": [1.5, 1.2, 0.3], "intensity": [1, 1, 1]})");
  for (const std::string& light : lights) {
    const double coarse = rms_of(fog_under(light, 12)), fine = rms_of(fog_under(light, 48));
    EXPECT_LT(fine, 0.02) << light;
    EXPECT_LT(fine, 0.7 * coarse) << light;
  }
}

// The depths of a constant field grow linearly from the side that the light enters: along an axis no error is left,
// whatever the grid and up to the sides, along which it runs.
TEST(LightGrids, AreExactInAConstantFieldAlongAnAxis) {
  for (const char* direction : {"0, -1, 0", "1, 0, 0", "0, 0, 1", "0, 1e-7, -1"}) {
    const std::string text = R"({
      "camera": {"eye": [0, 0, 5], "target": [0, 0, 0]}, "lights": [)" +
                             sun(direction) +
                             R"(],
      "media": [{"bounds": [[-1, -2, -3], [2, 3, 1]], "density": {"type": "constant", "resolution": [7, 8, 9]},
                 "sigma_a": 0.2, "sigma_s": 0.1}],
      "render": {"method": "dda_gauss2", "shadow": "grid", "light_grid": 5}})";
    EXPECT_LT(rms_of(flatten(scene_read_text(text, "fog.json", {}), {})), 1e-6) << direction;
  }
}

// Boxes about one spot, turned against each other, and one beside them.
PlannedScene boxes_turned(int count, const std::string& beside) {
  std::string media;
  for (int i = 0; i < count; ++i)
    media += std::string(i ? "," : "") + R"({"sigma_s": 1, "transform": [{"rotate": [1, 1, 0, )" +
             std::to_string(40 * i) + R"(]}, {"translate": [3, 0, 0]}],
        "density": {"type": "perlin", "resolution": [8, 8, 8], "seed": )" +
             std::to_string(i) + "}}";
  return flatten(
      scene_read_text(R"({"camera": {"eye": [0, 0, 5], "target": [0, 0, 0]}, "lights": [)" + sun("0.3, -1, 0.4") +
                          R"(], "media": [)" + media + beside + R"(], "render": {"shadow": "grid", "light_grid": 8}})",
                      "boxes.json", {}),
      {});
}

TEST(LightGrids, MediaOnOneSpotShareOne) {
  const PlannedScene scene = boxes_turned(
      4,
      R"(, {"sigma_s": 1, "bounds": [[7, -1, -1], [9, 1, 1]], "density": {"type": "linear", "resolution": [4, 4, 4]}})");
  ASSERT_EQ(scene.light_grids.size(), 5u);
  for (const std::size_t i : {0u, 1u, 2u, 3u}) {
    EXPECT_EQ(scene.light_grids[i].media, 4);
    EXPECT_EQ(scene.light_grids[i].offset, 0);
  }
  EXPECT_EQ(scene.light_grids[4].media, 1);
  EXPECT_GT(scene.light_grids[4].offset, 0);
  // each finds the same place of the lattice, which reaches over all of them
  const Context context(scene, {});
  const std::vector<Medium>& media = context.media;
  for (const Medium& medium : media) {
    const LightGrid &own = light_grid_of(scene, medium, 0), &first = scene.light_grids[0];
    if (own.media == 1) continue;
    each_point(medium, 0.1, [&](const dvec3& p) {
      const dvec3 at = affine_point(own.grid_from_cell, p);
      const dvec3 world = affine_point(medium.world_from_cell, p);
      const dvec3 same = affine_point(first.grid_from_cell, affine_point(media[0].cell_from_world, world));
      EXPECT_LT(glm::length(at - same), 1e-4);
      EXPECT_GE(at.z, -1e-4);
      EXPECT_LE(at.z, first.nk - 1 + 1e-4);
      EXPECT_GE(at.x - first.slope_u * at.z, 1 - 1e-4);
      EXPECT_LE(at.x - first.slope_u * at.z, first.nu - 2 + 1e-4);
    });
  }
}

// The same box, whatever its voxels: the very grid of one.
TEST(LightGrids, OneBoxIsOneLattice) {
  const std::string box = R"(, {"sigma_s": 1, "transform": [{"translate": [3, 0, 0]}],
                                "density": {"type": "linear", "resolution": [5, 3, 7]}})";
  const PlannedScene one = boxes_turned(1, ""), two = boxes_turned(1, box);
  EXPECT_EQ(two.light_grids.size(), 2u);
  EXPECT_EQ(two.light_entries, one.light_entries);
}

}  // namespace
}  // namespace brume::reference
