// A third voice beside kernels and reference: pictures of the same scenes by Mitsuba 3. Its pixels carry noise, means
// over blocks an eighth of it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "check/check_images.hpp"
#include "film/film_compare.hpp"
#include "film/film_write.hpp"
#include "plan/planned_scene.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

constexpr int BLOCK = 8;
constexpr double BLOCK_LIMIT = 0.01;  // rel. rmse over the means of blocks: their noise is some 0.3 %
constexpr double MEAN_LIMIT = 0.003;  // of the whole picture: a real difference from here on

std::filesystem::path test_data() {
  const char* folder = std::getenv("BRUME_TEST_DATA");
  return folder ? folder : BRUME_SOURCE_DIR "/../shared/data";
}

struct Voice {
  const char* name;
  bool elsewhere;  // needs files that belong to others and are not in the repository
};

std::filesystem::path folder_of(const Voice& voice) {
  return voice.elsewhere ? test_data() / "reference/mitsuba"
                         : std::filesystem::path(BRUME_SOURCE_DIR "/tests/data/mitsuba");
}

class Mitsuba : public testing::TestWithParam<Voice> {};

TEST_P(Mitsuba, AgreesInTheMeansOfBlocks) {
  const std::filesystem::path folder = folder_of(GetParam()), scene = folder / (std::string(GetParam().name) + ".json");
  if (!std::filesystem::exists(scene)) GTEST_SKIP() << scene << " is not there";
  const Image theirs = image_read(folder / (std::string(GetParam().name) + ".exr"));
  const SceneDesc desc = scene_read(scene, {"/render/light_samples=16"});
  const DeviceInfo device = device_choose("portable computing language");
  const int lanes = lanes_choose(device, 0);
  const PlannedScene flat = flatten(desc, {bvh_width_for(lanes), {}});
  Context context(device);
  const Image ours = film_image(render_film(context, flat, lanes));

  const CompareResult blocks = image_compare(block_means(ours, BLOCK), block_means(theirs, BLOCK));
  EXPECT_LE(blocks.rel_rmse, BLOCK_LIMIT);
  EXPECT_NEAR(blocks.mean_a / blocks.mean_b, 1, MEAN_LIMIT);
  EXPECT_EQ(blocks.nan, 0u);
  RecordProperty("rel_rmse", std::to_string(blocks.rel_rmse));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Mitsuba,
                         testing::Values(Voice{"fog_grey", false}, Voice{"fog_rgb_hg", false}, Voice{"lit_room", false},
                                         Voice{"spot_textured", true}, Voice{"area_box", true}),
                         [](const auto& voice) { return voice.param.name; });

}  // namespace
}  // namespace brume
