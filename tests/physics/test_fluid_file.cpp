// Water of a particle simulation: its density goes up to 1.33, which is no presence until a scene says what is meant.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/error.hpp"
#include "film/film_write.hpp"
#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

std::string scene_of_fluid(const std::string& more) {
  const char* folder = std::getenv("BRUME_TEST_DATA");
  const std::filesystem::path file = std::filesystem::path(folder ? folder : BRUME_SOURCE_DIR "/../shared/data") /
                                     "fluid/water_double_dam_break_26_density.vdb";
  if (!std::filesystem::exists(file)) return "";
  return R"({"camera": {"eye": [3, 2.5, 4], "target": [0, 0.4, 0], "vfov": 40}, "film": {"size": [48, 48]},
    "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": 3}],
    "media": [{"type": "liquid", "density": {"type": "file", "path": ")" +
         file.string() + R"("}, "sigma_a": [2, 1, 0.5])" + more + "}]}";
}

TEST(FluidFile, ItsRangeIsRefusedUntilAScaleIsAskedFor) {
  const std::string bare = scene_of_fluid("");
  if (bare.empty()) GTEST_SKIP() << "the fluid is not there";
  try {
    flatten(scene_read_text(bare, "a.json", {}), {8, {}});
    FAIL() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("1.3346"));
  }
  for (const char* presence : {"scale", "clamp"})
    for (const char* model : {"local_lighting", "surface"}) {
      const std::string text =
          scene_of_fluid(std::string(R"(, "presence": ")") + presence + R"(", "model": ")" + model + "\"");
      const PlannedScene scene = flatten(scene_read_text(text, "a.json", {}), {8, {}});
      const Image image = film_image(render_film(pocl(), scene, 8));
      const auto seen = std::count_if(image.values.begin(), image.values.end(), [](float v) { return v > 0; });
      EXPECT_TRUE(std::all_of(image.values.begin(), image.values.end(), [](float v) { return std::isfinite(v); }));
      if (std::string(model) == "local_lighting") {
        EXPECT_GT(seen, 100) << presence;
      }
    }
}

}  // namespace
}  // namespace brume::test
