// A scene around a bare volume: the densest view that it promises, and a camera that sees all of it.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "base/error.hpp"
#include "flat/bare_scene.hpp"
#include "flat/densest_view.hpp"
#include "plan/planned_scene.hpp"
#include "unit/vdb/vdb_fixture.hpp"

using namespace brume;
using namespace brume::test;
using testing::HasSubstr;

namespace {

using BareScene = Vdb;

double along(const Grid& grid, const dvec3& from, const dvec3& to) {
  return grid_line_integral(grid, grid_blocks(grid), from, glm::normalize(to - from));
}

// One voxel of density 1 is a tent: 1 voxel along an axis through its middle; along the diagonal 2 sqrt(3) times the
// integral of (1 - t)^3 over [0, 1], sqrt(3)/2.
TEST(DensestView, LineIntegralsAreExact) {
  Grid grid(ivec3(20));
  grid.border = Border::ZERO;
  for (const ivec3 at : {ivec3(7, 8, 15), ivec3(0, 0, 0)}) {
    grid.set(at, 1);
    const dvec3 middle = dvec3(at) + 0.5;
    EXPECT_NEAR(along(grid, middle - dvec3(50, 0, 0), middle), 1, 1e-12);
    EXPECT_NEAR(along(grid, middle - dvec3(0, 0, 50), middle), 1, 1e-12);
    EXPECT_NEAR(along(grid, middle - dvec3(50), middle), std::sqrt(3.0) / 2, 1e-12);
    grid.set(at, 0);
  }
}

// Against every ray of a picture that is fine enough: none sees more, and one sees nearly that much.
TEST(DensestView, NoOtherRaySeesMore) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 6; ++round) {
    Grid grid(ivec3(40, 30, 20));
    grid.border = Border::ZERO;
    for (int i = 0; i < 200; ++i)
      grid.set(ivec3(40 * uniform(random), 30 * uniform(random), 20 * uniform(random)), float(uniform(random)));
    grid.world_from_lattice = glm::rotate(glm::scale(dmat4(1), dvec3(1, 0.5, 0.1)), uniform(random), dvec3(1, 2, 3));
    const dvec3 target(grid.world_from_lattice * glm::dvec4(20, 15, 10, 1)), eye = target + dvec3(10, 20, 80);
    const double densest = grid_densest_view(grid, eye, target);
    const GridBlocks blocks = grid_blocks(grid);
    double seen = 0;
    for (int i = 0; i < 20000; ++i) {
      const dvec3 lattice(40 * uniform(random), 30 * uniform(random), 20 * uniform(random));
      const dvec3 to(grid.world_from_lattice * glm::dvec4(lattice, 1));
      seen = std::max(seen, grid_line_integral(grid, blocks, eye, glm::normalize(to - eye)));
    }
    EXPECT_GE(densest, 0.995 * seen) << round;
  }
}

double tau_of(const SceneDesc& scene, const Grid& grid) {
  return (scene.media[0].sigma_a.x + scene.media[0].sigma_s.x) *
         grid_densest_view(grid, scene.camera.eye, scene.camera.target);
}

// What is read to frame a volume is what flattening takes: the file may be gone by then.
TEST_F(BareScene, ReadsAVolumeOnce) {
  const auto g = grid("density", 2.0f);
  const std::filesystem::path path = file({g});
  LoadedScene loaded;
  std::string report;
  const SceneDesc scene = bare_scene(path, loaded, report);
  ASSERT_EQ(loaded.costs().size(), 1u);
  EXPECT_GT(loaded.costs()[0].bytes, 0u);
  std::filesystem::remove(path);
  const PlannedScene one = flatten(scene, loaded, {}), two = flatten(scene, loaded, {});
  EXPECT_EQ(one.voxels, two.voxels);
  EXPECT_EQ(loaded.costs().size(), 1u);
  EXPECT_THROW(flatten(scene, {}), InputError);
}

// Two voxels a hundred thousand apart, flat ones, a needle: what a lattice of lines does not meet, or not in any time.
TEST_F(BareScene, IsExposedWhateverTheShape) {
  const auto far = grid();
  far->tree().setValueOn(Coord(100003, 4, 5), 2.0f);
  const auto flat = grid();
  flat->fill(CoordBBox(Coord(0), Coord(9)), 1.0f);
  flat->setTransform(openvdb::math::Transform::createLinearTransform(
      openvdb::Mat4R(1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1e-6, 0., 0., 0., 0., 1.)));
  const auto needle = grid();
  needle->fill(CoordBBox(Coord(0), Coord(0, 2999, 0)), 1.0f);
  for (const FloatGrid::Ptr& g : {far, flat, needle}) {
    LoadedScene loaded;
    std::string report;
    const fs::path path = file({g});
    const SceneDesc scene = bare_scene(path, loaded, report);
    EXPECT_NEAR(tau_of(scene, volume_read(path)), 4, 0.01) << report;
    EXPECT_THAT(report, HasSubstr("the densest view is tau = 4"));
  }
}

TEST_F(BareScene, ValuesAtTheEndsOfFloatBecomeOne) {
  for (const float value : {1e-40f, 3e38f}) {
    LoadedScene loaded;
    std::string report;
    const SceneDesc scene = bare_scene(file({grid("density", value)}), loaded, report);
    ASSERT_EQ(scene.media[0].density.remap.size(), 2u);
    EXPECT_EQ(float(scene.media[0].density.remap[1].x), value);
    EXPECT_LT(scene.media[0].sigma_s.x, 1e3) << report;
  }
}

// All corners of the bounds, with the voxel over which the density fades, lie in the picture.
TEST_F(BareScene, TheCameraSeesAllOfIt) {
  const auto g = grid();
  g->fill(CoordBBox(Coord(0), Coord(30, 60, 9)), 1.0f);
  for (const ivec2 film : {ivec2(400, 100), ivec2(100, 400), ivec2(64, 64)}) {
    LoadedScene loaded;
    std::string report;
    const CameraDesc camera = bare_scene(file({g}), loaded, report, film).camera;
    const dvec3 forward = glm::normalize(camera.target - camera.eye);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up)), above = glm::cross(right, forward);
    const double half = std::tan(glm::radians(0.5 * camera.vfov));
    for (int corner = 0; corner < 8; ++corner) {
      const dvec3 p = dvec3(corner & 1 ? 31 : -1, corner & 2 ? 61 : -1, corner & 4 ? 10 : -1) - camera.eye;
      EXPECT_LT(std::abs(glm::dot(p, above) / glm::dot(p, forward)), half);
      EXPECT_LT(std::abs(glm::dot(p, right) / glm::dot(p, forward)), half * film.x / film.y);
    }
  }
}

TEST_F(BareScene, SaysWhichGridAndFillsLevelSets) {
  LoadedScene loaded;
  std::string report;
  bare_scene(file({grid("fire"), grid("fuel")}), loaded, report);
  EXPECT_THAT(report, HasSubstr("grid 'fire' of 'fire' (float, unknown), 'fuel' (float, unknown)"));
  const auto ball = grid("ball", -0.5f, 1.5f);
  ball->setGridClass(openvdb::GRID_LEVEL_SET);
  EXPECT_EQ(bare_scene(file({ball}), loaded, report).media[0].density.level_set, LEVEL_SET_FILL);
}

TEST_F(BareScene, AnEmptyFrameIsAnEmptyPicture) {
  LoadedScene loaded;
  std::string report;
  EXPECT_EQ(bare_scene(file({FloatGrid::create()}), loaded, report).media.size(), 1u);
  EXPECT_THAT(report, HasSubstr("nothing to see"));
}

}  // namespace
