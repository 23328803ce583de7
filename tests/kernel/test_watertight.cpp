// A closed mesh is never seen through: not by random rays from within, nor by rays aimed at its edges and corners,
// along the axes, or in the planes of its boxes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "check/check_parts.hpp"
#include "closed_mesh.hpp"
#include "plan/planned_scene.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

constexpr double ROUGHNESS = 0.02;  // of the ball: rays from its core meet it once, at distances of 0.6 to 1.4
constexpr double CORE = 0.3;
constexpr int AT_ONCE = 1 << 20;

class Watertight : public testing::Test {
 protected:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("brume-watertight-" + std::to_string(getpid()));
  Context context_{device_choose("portable computing language")};
  CheckRandom random_;

  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  PlannedScene ball(int levels, int lanes) const {
    std::ofstream(folder_ / "ball.obj") << test::closed_mesh(levels, ROUGHNESS).obj();
    const char* text = R"({"shapes": [{"type": "mesh", "file": "ball.obj"}]})";
    PlannedScene scene = flatten(scene_read_text(text, folder_ / "ball.json", {}), {bvh_width_for(lanes), {}});
    EXPECT_EQ(scene.triangles.size(), std::size_t(20) << (2 * levels));
    return scene;
  }

  dvec3 within(const PlannedScene& scene) { return scene.point(random_.in_box(CORE / std::sqrt(3.0))); }

  // Rays that get out, or are told that they do.
  int escapes(const PlannedScene& scene, const std::vector<float>& rays, int lanes) {
    const Probe probe(context_, scene, lanes);
    const std::vector<float> hits = probe.run("probe_hit", rays, 7, 5), found = probe.run("probe_occluded", rays, 7, 1);
    int out = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double t = hits[5 * i] * scene.unit;
      out += !(t > 1 - ROUGHNESS - CORE - 0.1 && t < 1 + ROUGHNESS + CORE) || found[i] != 1;
    }
    return out;
  }

  int escapes_at_random(int levels, int lanes, int count) {
    const PlannedScene scene = ball(levels, lanes);
    int out = 0;
    for (int left = count; left > 0; left -= AT_ONCE) {
      std::vector<float> rays;
      for (int i = 0; i < std::min(left, AT_ONCE); ++i) {
        push3(rays, within(scene));
        push3(rays, random_.direction());
        rays.push_back(INFINITY);
      }
      out += escapes(scene, rays, lanes);
    }
    return out;
  }
};

dvec3 corner(const Triangle& t, int k) { return {t.p[k].x, t.p[k].y, t.p[k].z}; }

TEST_F(Watertight, NoRandomRayGetsOut) {
  for (const int lanes : {1, 4, 8, 16}) EXPECT_EQ(escapes_at_random(6, lanes, 100000), 0) << lanes;
}

TEST_F(Watertight, LongTenMillionRandomRaysStayWithin) {
  for (const int lanes : {1, 4, 8, 16}) EXPECT_EQ(escapes_at_random(7, lanes, 10000000), 0) << lanes;
}

TEST_F(Watertight, NoRayAimedAtEdgesAndCornersGetsOut) {
  for (const int lanes : {1, 4, 8, 16}) {
    const PlannedScene scene = ball(5, lanes);
    std::vector<float> rays;
    for (const Triangle& t : scene.triangles)
      for (int k = 0; k < 3; ++k) {
        const dvec3 from = corner(t, k), to = corner(t, (k + 1) % 3);
        for (const double share : {0.0, 0.5, random_.uniform(0, 1)}) {
          const dvec3 origin = within(scene);
          push3(rays, origin);
          push3(rays, glm::normalize(from + share * (to - from) - origin));
          rays.push_back(INFINITY);
        }
      }
    EXPECT_EQ(escapes(scene, rays, lanes), 0) << lanes;
  }
}

// Two zeros in the direction, and two coordinates of a corner in the origin: what boxes and triangles begin and end at.
TEST_F(Watertight, NoRayInThePlanesOfBoxesGetsOut) {
  for (const int lanes : {1, 4, 8, 16}) {
    const PlannedScene scene = ball(6, lanes);
    std::vector<float> rays;
    for (const Triangle& t : scene.triangles)
      for (int axis = 0; axis < 3; ++axis) {
        dvec3 origin = corner(t, 0), dir(0);
        origin[axis] = 0;
        dir[axis] = corner(t, 0)[axis] < 0 ? -1 : 1;
        if (glm::length(scene.world(origin)) > CORE) continue;
        push3(rays, origin);
        push3(rays, dir);
        rays.push_back(INFINITY);
      }
    ASSERT_GT(rays.size(), 7u * 1000);
    EXPECT_EQ(escapes(scene, rays, lanes), 0) << lanes;
  }
}

}  // namespace
}  // namespace brume
