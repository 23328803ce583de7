// Shapes behind a BVH: the same bits as where every ray tries each of them.
#include <gtest/gtest.h>

#include <sstream>

#include "check/check_images.hpp"
#include "check/check_parts.hpp"
#include "plan/planned_scene.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

std::string vec(const dvec3& v) {
  std::ostringstream text;
  text << '[' << v.x << ',' << v.y << ',' << v.z << ']';
  return text.str();
}

// Of each kind; some of them twice, or with a face in common, so that distances are equal.
std::string shapes_text(int count) {
  CheckRandom random;
  std::string text = R"({"type": "plane", "point": [0, -1.1, 0], "material": "checker"})";
  for (int i = 0; i < count; ++i) {
    const dvec3 at = random.in_box(1), size = 0.02 + 0.1 * (random.in_box(0.5) + 0.5);
    const std::string shapes[] = {
        R"({"type": "sphere", "center": )" + vec(at) + R"(, "radius": 0.08, "material": "mirror"})",
        R"({"type": "cylinder", "base": )" + vec(at) + R"(, "top": )" + vec(at + size) + R"(, "radius": 0.05})",
        R"({"type": "quad", "material": "glass", "corner": )" + vec(at) + R"(, "u": )" + vec(size) +
            R"(, "v": [0, 0.2, -0.1]})",
        R"({"type": "box", "material": "checker", "min": )" + vec(at) + R"(, "max": )" + vec(at + size) + "}"};
    for (int twice = 0; twice < (i % 8 == 3 ? 2 : 1); ++twice) text += ",\n" + shapes[i % 4];
    if (i % 12 == 0)
      text +=
          R"(, {"type": "box", "material": "mirror", "min": )" + vec(at) + R"(, "max": )" + vec(at + 2.0 * size) + "}";
  }
  return text;
}

PlannedScene scene_of(int count, const std::string& bvh, int lanes) {
  const std::string text = R"({
    "camera": {"eye": [1, 1.5, 3.5], "target": [0, 0, 0], "vfov": 40}, "film": {"size": [48, 48]},
    "lights": [{"type": "directional", "direction": [-1, -2, -1]}, {"type": "point", "position": [0.1, 2, 1], "intensity": 9}],
    "materials": {"mirror": {"diffuse": 0.3, "reflection": 0.5}, "glass": {"refraction": 0.9, "ior": 1},
                  "checker": {"texture": {"type": "checker", "scale": 4}}},
    "media": [{"type": "liquid", "model": "surface", "bounds": [[-0.4, -0.4, -0.4], [0.4, 0.4, 0.4]],
               "density": {"type": "perlin", "resolution": [9, 9, 9], "scale": 2}}],
    "shapes": [)" + shapes_text(count) +
                           R"(],
    "render": {"max_depth": 3, "shadow_of_glass": "clear", "bvh": ")" +
                           bvh + R"("}})";
  return flatten(scene_read_text(text, "shapes.json", {}), {bvh_width_for(lanes), {}});
}

class ShapeBvh : public testing::TestWithParam<int> {};

TEST_P(ShapeBvh, IsTheListBitByBit) {
  Context context(device_choose("portable computing language"));
  for (const int count : {16, 300}) {
    const PlannedScene listed = scene_of(count, "list", GetParam()), behind = scene_of(count, "sah", GetParam());
    ASSERT_LT(listed.shape_root, 0);
    ASSERT_GE(behind.shape_root, 0);
    EXPECT_EQ(listed.shape_list.size(), listed.shapes.size());
    EXPECT_EQ(behind.shape_list.size(), 2u);  // the plane and the water
    const Film a = render_film(context, listed, GetParam()), b = render_film(context, behind, GetParam());
    ASSERT_EQ(a.pixels().size(), b.pixels().size());
    int hits = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
      const FilmPixel &one = a.pixels()[i], &two = b.pixels()[i];
      EXPECT_EQ(one.radiance.x, two.radiance.x) << count << " shapes, pixel " << i;
      EXPECT_EQ(one.radiance.y, two.radiance.y) << count << " shapes, pixel " << i;
      EXPECT_EQ(one.radiance.z, two.radiance.z) << count << " shapes, pixel " << i;
      EXPECT_EQ(one.key, two.key) << count << " shapes, pixel " << i;
      hits += one.hits > 0;
    }
    EXPECT_GT(hits, 500);
  }
}

INSTANTIATE_TEST_SUITE_P(Lanes, ShapeBvh, testing::Values(1, 4, 8, 16), testing::PrintToStringParamName());

TEST(ShapeBvhOf, FewShapesIsTheirList) {
  const char* text = R"({"shapes": [{"type": "sphere", "radius": 1}, {"type": "plane", "point": [0, -1, 0]},
                                    {"type": "sphere", "center": [2, 0, 0], "radius": 1}]})";
  const PlannedScene scene = flatten(scene_read_text(text, "few.json", {}), {4, {}});
  EXPECT_LT(scene.shape_root, 0);
  EXPECT_EQ(scene.shape_list, (std::vector<std::int32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace brume
