// Ambient occlusion against closed forms.
#include <cmath>
#include <glm/geometric.hpp>

#include "film/film_write.hpp"
#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

// One pixel of a floor, seen from right above at x, under `shapes`.
double open_sky(double x, const std::string& shapes, const std::vector<std::string>& overrides = {}, int samples = 1) {
  const std::string at = std::to_string(x);
  const std::string text = R"({"camera": {"type": "orthographic", "eye": [)" + at + R"(, 0.01, 0], "target": [)" + at +
                           R"(, 0, 0], "up": [0, 0, 1], "height": 1e-5}, "film": {"size": [1, 1], "spp": )" +
                           std::to_string(samples) +
                           R"(}, "render": {"integrator": "ambient_occlusion", "directions": 1024},
      "shapes": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0]})" +
                           shapes + "]}";
  const PlannedScene scene = flatten(scene_read_text(text, "dir/floor.json", overrides), {bvh_width_for(8), {}});
  return film_image(render_film(pocl(), scene, 8)).values[1];
}

TEST(AmbientOcclusion, NothingInTheWayIsOne) {
  for (const char* directions : {"1", "7", "64", "1000"})
    EXPECT_EQ(open_sky(0.3, "", {std::string("/render/directions=") + directions}), 1);
}

TEST(AmbientOcclusion, AWallTakesHalf) {
  const std::string wall = R"(, {"type": "plane", "point": [0, 0, 0], "normal": [1, 0, 0]})";
  for (const double x : {0.01, 0.5, 3.0}) EXPECT_NEAR(open_sky(x, wall), 0.5, 2e-3);
}

// [Howell10, B-43]: a hemisphere of radius 1 that stands on the floor, x from its middle.
TEST(AmbientOcclusion, AHemisphereByItsFormFactor) {
  const std::string hemisphere = R"(, {"type": "sphere", "center": [0, 0, 0], "radius": 1})";
  for (const double x : {1.05, 1.5, 3.0}) {
    const double off = std::sqrt(x * x - 1), factor = (std::atan(1 / off) - off / (x * x)) / M_PI;
    EXPECT_NEAR(open_sky(x, hemisphere, {"/render/directions=16384"}, 4), 1 - factor, 1e-3) << x;
  }
}

// Below a shell of radius 1 the sky is closed, unless what is that far does not count.
TEST(AmbientOcclusion, DistanceBoundsWhatIsInTheWay) {
  const std::string shell = R"(, {"type": "sphere", "center": [0, 0, 0], "radius": 1})";
  EXPECT_EQ(open_sky(0, shell), 0);
  EXPECT_EQ(open_sky(0, shell, {"/render/distance=1.01"}), 0);
  EXPECT_EQ(open_sky(0, shell, {"/render/distance=0.99"}), 1);
}

}  // namespace
}  // namespace brume::test
