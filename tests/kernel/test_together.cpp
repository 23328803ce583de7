// Rays that are followed together hit what each hits alone, to the bit: rays of a camera from far and near, through one
// another, along the axes, at random, and more or fewer than there are lanes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
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

// Nine of ten groups of 16 within a cone of that width, from points that are as far apart.
std::vector<float> groups(int count, double cone, double apart, CheckRandom& random) {
  std::vector<float> rays;
  dvec3 from(0), to(0);
  for (int i = 0; i < count; ++i) {
    if (i % 16 == 0) {
      from = random.in_box(2);
      to = random.in_box(1);
      if (i % 160 == 0) to = from + dvec3(i % 3 == 0, i % 3 == 1, i % 3 == 2);
    }
    const dvec3 origin = from + apart * random.in_box(1);
    push3(rays, origin);
    push3(rays, glm::normalize(to + cone * random.in_box(1) - origin));
    rays.push_back(INFINITY);
  }
  return rays;
}

class Together : public testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("brume-together-" + std::to_string(getpid()));
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
};

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST_F(Together, RaysHitWhatTheyHitAlone) {
  std::ofstream(folder / "ball.obj") << test::closed_mesh(5, 0.1).obj();
  const std::string others =
      R"({"type": "sphere", "radius": 0.98}, {"type": "box", "min": [0.5, 0.5, -2], "max": [0.6, 0.9, 2]}]})";
  const std::string instances =
      R"([{"translate": [0.6, 0, 0]}], [{"scale": [-0.9, 1.3, 0.5]}, {"rotate": [1, 2, 3, 50]}],
    [{"translate": [0.6, 0, 0]}], [{"scale": 0.02}, {"translate": [1.1, 0.3, 0]}], [{"scale": 0.02}, {"translate": [1.1, 0.36, 0]}])";
  const std::string texts[] = {
      R"({"shapes": [{"type": "mesh", "file": "ball.obj"}, )" + others,
      R"({"shapes": [{"type": "mesh", "file": "ball.obj", "instances": [)" + instances +
          R"(]}, {"type": "triangle", "vertices": [[-3, -1, 0.2], [3, -1, 0.2], [0, 1, 0.1]]}, )" + others,
      R"({"media": [{"type": "liquid", "model": "surface", "material": "water", "bounds": [[-0.9, -1, -0.8], [0.9, 1, 1]],
                     "density": {"type": "perlin", "resolution": [20, 17, 30], "scale": 3}}],
          "materials": {"water": {"refraction": 1}},
          "shapes": [{"type": "plane", "point": [0, -0.6, 0], "normal": [0.1, 1, 0]},
                     {"type": "plane", "point": [0, -0.6, 0], "normal": [0.1, 1, 0]},
                     {"type": "quad", "corner": [-1, -0.5, 0.3], "u": [2, 0.1, 0], "v": [0, 1, 0.2]},
                     {"type": "cylinder", "base": [0.3, -1, 0], "top": [0.3, 0.7, 0.2], "radius": 0.3}, )" +
          others};
  Context context(device_choose("portable computing language"));
  CheckRandom random;
  for (const auto& [lanes, text] : {std::pair{4, texts[0]},
                                    {8, texts[0]},
                                    {16, texts[0]},
                                    {8, texts[1]},
                                    {16, texts[1]},
                                    {4, texts[2]},
                                    {8, texts[2]},
                                    {16, texts[2]}}) {
    const PlannedScene scene = flatten(scene_read_text(text, folder / "ball.json", {}), {bvh_width_for(lanes), {}});
    const Probe probe(context, scene, lanes);
    for (const int count : {3, 16 * 4096 + 5})
      for (const auto& [cone, apart] : {std::pair{0.02, 0.0}, {0.1, 0.0}, {0.05, 0.05}, {1.0, 1.0}}) {
        std::vector<float> rays = groups(count, cone, apart, random);
        const std::string what = std::to_string(lanes) + " lanes, " + std::to_string(count) + " rays, cone " +
                                 std::to_string(cone) + ", apart " + std::to_string(apart);
        EXPECT_TRUE(same_bits(probe.run("probe_hit", rays, 7, 5), probe.run("probe_hit_together", rays, 7, 5))) << what;
        for (std::size_t i = 6; i < rays.size(); i += 7) rays[i] = static_cast<float>(random.uniform(-0.1, 1));
        EXPECT_TRUE(
            same_bits(probe.run("probe_occluded", rays, 7, 1), probe.run("probe_occluded_together", rays, 7, 1)))
            << what;
      }
  }
}

// By which rule triangles were parted changes nothing.
TEST_F(Together, RaysHitTheSameByEveryRule) {
  std::ofstream(folder / "ball.obj") << test::closed_mesh(3, 0.1).obj();
  Context context(device_choose("portable computing language"));
  CheckRandom random;
  const std::vector<float> rays = groups(8192, 0.05, 0.05, random);
  for (const int lanes : {1, 4, 8}) {
    std::vector<float> before;
    for (const char* rule : {"list", "midpoint", "sah"}) {
      const SceneDesc desc = scene_read_text(R"({"shapes": [{"type": "mesh", "file": "ball.obj"}]})",
                                             folder / "ball.json", {std::string("/render/bvh=") + rule});
      const PlannedScene scene = flatten(desc, {bvh_width_for(lanes), {}});
      const std::vector<float> hits = Probe(context, scene, lanes).run("probe_hit", rays, 7, 5);
      EXPECT_TRUE(before.empty() || same_bits(before, hits)) << rule << ", " << lanes << " lanes";
      before = hits;
    }
  }
}

}  // namespace
}  // namespace brume
