// Lights with an area against closed forms: E of a square, a disc and a sphere, and shapes against the same ones made
// of quads.
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "film/film_write.hpp"
#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

constexpr double LIMIT = 1e-3;
const std::vector<std::string> FEWER = {"/render/light_samples=1024"};  // on each of many lights

// A white floor, seen from above in one pixel at the origin, under `shapes` of the material "lamp".
std::string floor_under(const std::string& shapes) {
  return R"({"camera": {"type": "orthographic", "eye": [0, 0.02, 0], "target": [0, 0, 0], "up": [0, 0, 1], "height": 1e-4},
    "film": {"size": [1, 1]}, "render": {"light_samples": 16384},
    "materials": {"lamp": {"diffuse": 0, "emission": 2}, "white": {"diffuse": 1}},
    "shapes": [{"type": "quad", "corner": [-1, 0, -1], "u": [0, 0, 2], "v": [2, 0, 0], "material": "white"})" +
         shapes + "]}";
}

double radiance_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const PlannedScene scene = flatten(scene_read_text(text, "dir/floor.json", overrides), {bvh_width_for(8), {}});
  return film_image(render_film(pocl(), scene, 8)).values[1];
}

std::string quad(const dvec3& corner, const dvec3& u, const dvec3& v) {
  const auto vec = [](const dvec3& p) {
    std::ostringstream text;
    text.precision(17);
    text << "[" << p.x << "," << p.y << "," << p.z << "]";
    return text.str();
  };
  return R"(, {"type": "quad", "material": "lamp", "corner": )" + vec(corner) + R"(, "u": )" + vec(u) + R"(, "v": )" +
         vec(v) + "}";
}

// [Howell10, C-11]: of a small plane to a rectangle a × b at height h, a corner of which is right above it.
double corner_factor(double a, double b, double h) {
  const double x = std::hypot(a, h), y = std::hypot(b, h);
  return (a / x * std::atan(b / x) + b / y * std::atan(a / y)) / (2 * M_PI);
}

TEST(AreaLights, SquareByItsFormFactor) {
  const double found = radiance_of(floor_under(quad({-0.5, 0.8, -0.5}, {1, 0, 0}, {0, 0, 1})));
  expect_relative(found, 2 * 4 * corner_factor(0.5, 0.5, 0.8), LIMIT, "square");
}

TEST(AreaLights, DiscByItsFormFactor) {
  const double found = radiance_of(floor_under(
      R"(, {"type": "cylinder", "base": [0, 0.7, 0], "top": [0, 0.7001, 0], "radius": 0.5, "material": "lamp"})"));
  expect_relative(found, 2 * 0.25 / (0.25 + 0.49), LIMIT, "disc");
}

TEST(AreaLights, SphereIsThePointLightInItsMiddle) {
  const double radius = 0.3;
  for (const double up : {0.4, 2.0, 1e4}) {
    std::ostringstream sphere;
    sphere.precision(17);
    sphere << R"(, {"type": "sphere", "center": [0, )" << up << R"(, 0], "radius": )" << radius
           << R"(, "material": "lamp"})";
    expect_relative(radiance_of(floor_under(sphere.str())), 2 * radius * radius / (up * up), LIMIT,
                    "sphere at " + std::to_string(up));
  }
}

TEST(AreaLights, BoxIsItsFaces) {
  const dvec3 lo(0.2, 0.3, -0.4), size(0.3, 0.4, 0.6);
  const dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  const double box = radiance_of(
      floor_under(R"(, {"type": "box", "min": [0.2, 0.3, -0.4], "max": [0.5, 0.7, 0.2], "material": "lamp"})"), FEWER);
  const double faces = radiance_of(floor_under(quad(lo, x, y) + quad(lo, y, z) + quad(lo, z, x) + quad(lo + x, y, z) +
                                               quad(lo + y, z, x) + quad(lo + z, x, y)),
                                   FEWER);
  expect_relative(box, faces, LIMIT, "box");
}

TEST(AreaLights, CylinderIsManyQuads) {
  constexpr int SIDES = 48;
  std::string quads;
  for (int i = 0; i < SIDES; ++i) {
    const auto rim = [&](int k) {
      const double turn = 2 * M_PI * k / SIDES;
      return dvec3(0.6 + 0.2 * std::cos(turn), -0.1, 0.2 * std::sin(turn));
    };
    quads += quad(rim(i), rim(i + 1) - rim(i), {0, 0.9, 0});
  }
  const double cylinder = radiance_of(floor_under(
      R"(, {"type": "cylinder", "base": [0.6, -0.1, 0], "top": [0.6, 0.8, 0], "radius": 0.2, "material": "lamp"})"));
  expect_relative(cylinder, radiance_of(floor_under(quads), FEWER), 4 * LIMIT, "side");  // its chords are shorter
}

// A triangle and its mirror image are the square.
TEST(AreaLights, TrianglesAreTheSquare) {
  const auto triangle = [](const char* last) {
    return std::string(
               R"(, {"type": "triangle", "material": "lamp", "vertices": [[-0.5, 0.8, -0.5], [0.5, 0.8, 0.5], )") +
           last + "]}";
  };
  const double found = radiance_of(floor_under(triangle("[-0.5, 0.8, 0.5]") + triangle("[0.5, 0.8, -0.5]")));
  expect_relative(found, 2 * 4 * corner_factor(0.5, 0.5, 0.8), LIMIT, "triangles");
}

// In a medium that is thin enough for both to be the same everywhere, light is scattered by what arrives.
TEST(AreaLights, LightsMediaAsThePointLightInItsMiddle) {
  const auto fog = [](const std::string& light) {
    return R"({"camera": {"type": "orthographic", "eye": [0, 0, 3], "target": [0, 0, 0], "height": 1e-3},
      "film": {"size": [1, 1], "spp": 16}, "render": {"light_samples": 64}, "materials": {"lamp": {"emission": 2}},
      "media": [{"density": {"type": "constant"}, "sigma_s": 0.5, "phase": {"type": "henyey_greenstein", "g": 0.5}}], )" +
           light + "}";
  };
  const double sphere =
      radiance_of(fog(R"("shapes": [{"type": "sphere", "center": [0, 6, 1], "radius": 0.1, "material": "lamp"}])"));
  const double intensity = 2 * M_PI * 0.01;
  const double point = radiance_of(
      fog(R"("lights": [{"type": "point", "position": [0, 6, 1], "intensity": )" + std::to_string(intensity) + "}]"));
  expect_relative(sphere, point, LIMIT, "fog");
}

// Of what lies in the plane of the floor but for rounding, nothing arrives: neighbours of a solid that emits would
// else light each other along their edge, by height over the cube of the distance.
TEST(AreaLights, WhatLiesInThePlaneLightsNothing) {
  const auto beside = [](double height) {
    std::ostringstream triangle;
    triangle << R"(, {"type": "triangle", "material": "lamp", "vertices": [[0.001, )" << height - 0.5
             << ", -0.5], [0.001, " << height - 0.5 << ", 0.5], [0.001, " << height + 1 << ", 0]]}";
    return radiance_of(floor_under(triangle.str()), {"/render/light_points=centroid", "/render/light_samples=1"});
  };
  const double area = 0.75, off = 1e-3, square = 2 * off * off;
  expect_relative(beside(off), 2 * area / 2 / square / M_PI, LIMIT, "above the floor");
  EXPECT_EQ(beside(1e-7), 0);
  EXPECT_EQ(beside(-1e-7), 0);
}

// Places are drawn by the seed; middles are not.
TEST(AreaLights, MiddlesAreWithoutNoise) {
  const std::string square = floor_under(quad({-0.5, 0.8, -0.5}, {1, 0, 0}, {0, 0, 1}));
  const auto drawn = [&](int seed) {
    return radiance_of(square, {"/render/light_samples=1", "/render/seed=" + std::to_string(seed)});
  };
  EXPECT_NE(drawn(1), drawn(2));
  const auto middle = [&](int seed) {
    return radiance_of(square, {"/render/light_points=centroid", "/render/seed=" + std::to_string(seed)});
  };
  EXPECT_EQ(middle(1), middle(2));
  expect_relative(middle(1), 2 * 1 / (0.8 * 0.8) / M_PI, 1e-5, "middle");
}

}  // namespace
}  // namespace brume::test
