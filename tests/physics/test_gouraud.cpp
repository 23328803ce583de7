// Gouraud's shading lights the vertices and blends their colours: a highlight inside a triangle is missed, which
// normals that are blended show.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "film/film_write.hpp"
#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

// A triangle of which the middle mirrors the light towards the camera, its normals leaning outwards.
class Gouraud : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "facet.obj") << "v -1 -1 0\nv 1 -1 0\nv 0 1 0\n"
                                            "vn -0.4 -0.4 0.82\nvn 0.4 -0.4 0.82\nvn 0 0.5 0.866\n"
                                            "f 1//1 2//2 3//3\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Image picture(const std::string& shading, const std::string& specular) const {
    const std::string text = R"({"camera": {"type": "orthographic", "eye": [0, 0, 5], "target": [0, 0, 0], "height": 2},
      "film": {"size": [33, 33]}, "lights": [{"type": "directional", "direction": [0, 0, -1]}],
      "materials": {"m": {"model": "blinn_phong", "diffuse": 0.5, "specular": )" +
                             specular + R"(, "shininess": 200}},
      "shapes": [{"type": "mesh", "file": "facet.obj", "material": "m", "shading": ")" +
                             shading + R"("}]})";
    const PlannedScene scene = flatten(scene_read_text(text, folder_ / "facet.json", {}), {bvh_width_for(8), {}});
    return film_image(render_film(pocl(), scene, 8));
  }
  static float at(const Image& image, int x, int y) {
    return image.values[3 * static_cast<std::size_t>(y * image.width + x)];
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      (std::string("brume-gouraud-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Gouraud, MissesTheHighlightInsideOfAFacet) {
  const float blended_normals = at(picture("phong", "1"), 16, 20), without = at(picture("phong", "0"), 16, 20);
  EXPECT_GT(blended_normals, without + 0.5f);
  EXPECT_NEAR(at(picture("gouraud", "1"), 16, 20), at(picture("gouraud", "0"), 16, 20), 1e-5);
}

// The middle of the lower side: half of what each of its ends sends, N·L/π.
TEST_F(Gouraud, BlendsWhatTheCornersSend) {
  const Image image = picture("gouraud", "0");
  const double low = 0.5 / M_PI * 0.82 / std::sqrt(0.4 * 0.4 * 2 + 0.82 * 0.82),
               high = 0.5 / M_PI * 0.866 / std::sqrt(0.25 + 0.866 * 0.866);
  for (const int y : {8, 16, 24}) {
    const double share = 0.5 * (1 + 1 - 2 * (y + 0.5) / 33);  // of the upper corner
    EXPECT_NEAR(at(image, 16, y), (1 - share) * low + share * high, 1e-5);
  }
}

}  // namespace
}  // namespace brume::test
