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

TEST(Together, RaysHitWhatTheyHitAlone) {
  const auto folder = std::filesystem::temp_directory_path() / ("brume-together-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "ball.obj") << test::closed_mesh(5, 0.1).obj();
  const std::string others =
      R"({"type": "sphere", "radius": 0.98}, {"type": "box", "min": [0.5, 0.5, -2], "max": [0.6, 0.9, 2]}]})";
  const std::string instances =
      R"([{"translate": [0.6, 0, 0]}], [{"scale": [-0.9, 1.3, 0.5]}, {"rotate": [1, 2, 3, 50]}],
    [{"translate": [0.6, 0, 0]}], [{"scale": 0.02}, {"translate": [1.1, 0.3, 0]}], [{"scale": 0.02}, {"translate": [1.1, 0.36, 0]}])";
  const std::string texts[] = {
      R"({"shapes": [{"type": "mesh", "file": "ball.obj"}, )" + others,
      R"({"shapes": [{"type": "mesh", "file": "ball.obj", "instances": [)" + instances +
          R"(]}, {"type": "triangle", "vertices": [[-3, -1, 0.2], [3, -1, 0.2], [0, 1, 0.1]]}, )" + others};
  Context context(device_choose("portable computing language"));
  CheckRandom random;
  for (const int lanes : {4, 8, 16})
    for (const std::string& text : texts) {
      const PlannedScene scene = flatten(scene_read_text(text, folder / "ball.json", {}), {bvh_width_for(lanes), {}});
      const Probe probe(context, scene, lanes);
      for (const int count : {3, 16 * 4096 + 5})
        for (const auto& [cone, apart] : {std::pair{0.02, 0.0}, {0.1, 0.0}, {0.05, 0.05}, {1.0, 1.0}}) {
          const std::vector<float> rays = groups(count, cone, apart, random);
          std::vector<float> alone = probe.run("probe_hit", rays, 7, 5);
          const std::vector<float> together = probe.run("probe_hit_together", rays, 7, 5);
          EXPECT_EQ(std::memcmp(alone.data(), together.data(), alone.size() * sizeof(float)), 0)
              << lanes << " lanes, " << count << " rays, cone " << cone << ", apart " << apart;
        }
    }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace brume
