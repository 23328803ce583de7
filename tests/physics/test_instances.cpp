// Instances against the same meshes written out: stretched, turned and mirrored, lit, in shadow, mirrored in each other
// and seen through.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "film/film_write.hpp"
#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

const char* const TRANSFORMS[] = {
    R"({"scale": [1, 0.4, 0.7]}, {"rotate": [1, 2, 0.5, 40]}, {"translate": [-0.9, 0.1, 0]})",
    R"({"rotate": [0, 0, 1, 30]}, {"scale": [-0.6, 0.9, 0.5]}, {"translate": [0.8, 0.2, -0.3]})",
    R"({"scale": 0.5}, {"translate": [0, -0.2, 0.8]})"};

// A ball of triangles with its normals and texture coordinates.
std::string ball_text() {
  constexpr int AROUND = 24, UP = 12;
  std::string text;
  for (int j = 0; j <= UP; ++j)
    for (int i = 0; i <= AROUND; ++i) {
      const double a = 2 * M_PI * i / AROUND, b = M_PI * j / UP;
      const std::string p = std::to_string(std::sin(b) * std::cos(a)) + " " + std::to_string(-std::cos(b)) + " " +
                            std::to_string(-std::sin(b) * std::sin(a)) + "\n";
      text.append("v ").append(p).append("vn ").append(p).append("vt ").append(std::to_string(double(i) / AROUND));
      text.append(" ").append(std::to_string(double(j) / UP)).append("\n");
    }
  const auto corner = [](int i, int j) {
    const std::string n = std::to_string(j * (AROUND + 1) + i + 1);
    return n + "/" + n + "/" + n + " ";
  };
  for (int j = 0; j < UP; ++j)
    for (int i = 0; i < AROUND; ++i) {
      if (j > 0) text += "f " + corner(i, j) + corner(i + 1, j) + corner(i + 1, j + 1) + "\n";
      if (j < UP - 1 || j == 0) text += "f " + corner(i, j) + corner(i + 1, j + 1) + corner(i, j + 1) + "\n";
    }
  return text;
}

class Instances : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    for (const char* name : {"ball.obj", "ball0.obj", "ball1.obj", "ball2.obj"})
      std::ofstream(folder_ / name) << ball_text();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Film picture(const std::string& shapes, int lanes, int max_depth) const {
    const std::string text = R"({"camera": {"eye": [0.5, 1.4, 3.6], "target": [0, 0, 0], "vfov": 40},
      "film": {"size": [96, 96]}, "background": [0.3, 0.4, 0.6], "ambient": 0.1,
      "lights": [{"type": "directional", "direction": [-0.5, -1, -0.4], "irradiance": 2},
                 {"type": "point", "position": [1, 1.5, 1.5], "intensity": 2}],
      "materials": {"a": {"model": "blinn_phong", "diffuse": 0.8, "specular": 0.2, "shininess": 20, "texture": {"type": "checker", "scale": 6}},
                    "b": {"model": "phong", "diffuse": 0.2, "specular": 0.2, "shininess": 8, "reflection": 0.6},
                    "c": {"diffuse": 0.1, "refraction": 0.9, "ior": 1.3, "absorption": [0.1, 0.8, 1.5]}},
      "shapes": [{"type": "plane", "point": [0, -0.8, 0]}, )" +
                             shapes + R"(], "render": {"shadow_of_glass": "clear", "max_depth": )" +
                             std::to_string(max_depth) + "}}";
    return render_film(pocl(), flatten(scene_read_text(text, folder_ / "a.json", {}), {bvh_width_for(lanes), {}}),
                       lanes);
  }
  // Each with its own material, of a file of its own where they are written out.
  std::string shapes(const std::string& keys, bool instances) const {
    std::string all;
    for (int i = 0; i < 3; ++i) {
      const std::string steps = TRANSFORMS[i];
      all += std::string(i > 0 ? ", " : "") + R"({"type": "mesh", "material": ")" + "abc"[i] + R"(", "file": "ball)" +
             (instances ? "" : std::to_string(i)) + R"(.obj")" + keys +
             (instances ? R"(, "instances": [[)" + steps + "]]}" : R"(, "transform": [)" + steps + "]}");
    }
    return all;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      (std::string("brume-instances-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

constexpr double BOUNCES_LIMIT = 1e-4;  // a curved mirror or glass magnifies what its normals carry, four times over

// Pixels that see an edge of a triangle, a shadow or a square fall to either side by rounding; and light that grazes a
// facet or the edge of glass magnifies it.
void expect_same(const Film& a, const Film& b, double limit = KERNEL_LIMIT) {
  int off = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Packed3 &x = a.pixels()[i].radiance, &y = b.pixels()[i].radiance;
    off += std::max({std::abs(x.x - y.x), std::abs(x.y - y.y), std::abs(x.z - y.z)}) >
           limit * (1e-2 + std::max({y.x, y.y, y.z}));
  }
  EXPECT_LE(off, static_cast<int>(a.pixels().size() / 200));
}

TEST_F(Instances, AreTheMeshesWrittenOut) {
  for (const char* shading : {"phong", "flat", "gouraud"}) {
    const std::string keys = std::string(R"(, "shading": ")") + shading + '"';
    SCOPED_TRACE(shading);
    expect_same(picture(shapes(keys, true), 8, 0), picture(shapes(keys, false), 8, 0));
    expect_same(picture(shapes(keys, true), 8, 4), picture(shapes(keys, false), 8, 4), BOUNCES_LIMIT);
  }
}

// However small or large the mesh is in its own units.
TEST_F(Instances, DoNotDependOnTheUnitsOfTheMesh) {
  const std::string mesh = R"({"type": "mesh", "material": "b", "file": "ball)";
  const Film alone = picture(mesh + R"(0.obj", "transform": [{"scale": 0.7}]})", 16, 4);
  for (const auto& [size, back] : {std::pair("1e-6", "1e6"), std::pair("1e5", "1e-5")}) {
    SCOPED_TRACE(size);
    std::string shape = mesh;
    shape.append(R"(.obj", "transform": [{"scale": )").append(size).append(R"(}], "instances": [[{"scale": )");
    shape.append(back).append(R"(}, {"scale": 0.7}]]})");
    expect_same(picture(shape, 16, 4), alone, BOUNCES_LIMIT);
  }
}

}  // namespace
}  // namespace brume::test
