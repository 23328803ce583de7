// What a picture must not depend on: the size of the world, the distance of the camera and of lights.
#include <iterator>
#include <regex>

#include "closed_mesh.hpp"
#include "render/program.hpp"
#include "stability/worlds.hpp"

namespace brume::test {
namespace {

// "<n x>" becomes x · unit^n, "<x>" x · unit.
std::string in_units(const std::string& text, double unit) {
  static const std::regex quantity("<(-?[0-9] )?([^<>]*)>");
  std::string out;
  auto at = text.cbegin();
  for (auto i = std::sregex_iterator(text.begin(), text.end(), quantity); i != std::sregex_iterator(); ++i) {
    out.append(at, (*i)[0].first);
    const int power = (*i)[1].matched ? std::stoi((*i)[1].str()) : 1;
    out += number_text(std::stod((*i)[2].str()) * std::pow(unit, power));
    at = (*i)[0].second;
  }
  return out.append(at, text.cend());
}

// Depths of equal pixels: equal shares of the unit.
void expect_depths(const Film& film, const Film& base, double unit, const std::string& what) {
  double worst = 0;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    const FilmPixel &p = film.pixels()[i], &q = base.pixels()[i];
    if (p.key == q.key && q.hits > 0) worst = std::max(worst, std::abs(p.depth / (unit * q.depth) - 1));
  }
  EXPECT_LE(worst, 1e-5) << what;
}

constexpr const char* CORNERS_OBJ = "v -1 -1 0.2\nv 1 -1 -0.1\nv 0.2 0.9 0.4\nv -0.9 1 -0.6\nf 1 2 3\nf 1 3 4\n";

struct World {
  const char* name;
  std::string text;
};

const World WORLDS[] = {
    {"surfaces",
     R"({"camera": {"eye": [<0.4>, <2.4>, <3.8>], "target": [0, 0, 0], "vfov": 38}, "background": [0.1, 0.15, 0.2],
      "lights": [{"type": "point", "position": [<1.5>, <2.5>, <1.5>], "intensity": [<2 6>, <2 5>, <2 4>]},
        {"type": "directional", "direction": [-1, -1.5, -0.5], "irradiance": 1},
        {"type": "spot", "position": [<-1.5>, <2.5>, <1>], "direction": [<0.5>, <-1>, <-0.3>], "intensity": <2 8>},
        {"type": "point", "position": [<-2>, <1>, <2>], "intensity": 0.3, "falloff": "none"}],
      "materials": {"checker": {"diffuse": 1, "texture": {"type": "checker", "scale": <-1 2>}},
        "squares": {"diffuse": 1, "texture": {"type": "checker", "scale": 4}},
        "mirror": {"diffuse": 0.1, "reflection": 0.7}, "glass": {"diffuse": 0.1, "refraction": 0.8, "reflection": 0.1}},
      "shapes": [{"type": "sphere", "center": [<-0.2>, <0.1>, <0.1>], "radius": <0.55>, "material": "glass"},
        {"type": "cylinder", "base": [<0.8>, <-0.45>, <0.2>], "top": [<0.95>, <0.4>, 0], "radius": <0.25>, "material": "mirror"},
        {"type": "plane", "point": [0, <-0.5>, 0], "normal": [0, <1>, <0.05>], "material": "checker"},
        {"type": "quad", "corner": [<-1.5>, <-0.4>, <-1>], "u": [<3>, 0, <0.2>], "v": [0, <1.8>, <-0.1>], "material": "squares"},
        {"type": "box", "min": [<-0.3>, <-0.3>, <-0.2>], "max": [<0.3>, <0.3>, <0.2>],
          "transform": [{"rotate": [0, 1, 0.3, 35]}, {"translate": [<-1>, <-0.1>, <0.7>]}]},
        {"type": "triangle", "vertices": [[<0.3>, <-0.4>, <1>], [<0.9>, <-0.3>, <0.8>], [<0.5>, <0.2>, <0.9>]]}]})"},
    {"media",
     R"({"camera": {"eye": [<1.8>, <0.8>, <2.9>], "target": [0, 0, 0], "vfov": 42}, "background": [0.2, 0.3, 0.5],
      "lights": [{"type": "point", "position": [<0.4>, <1.4>, <0.5>], "intensity": <2 2>},
        {"type": "directional", "direction": [-0.4, -1, -0.6], "irradiance": 2}],
      "shapes": [{"type": "sphere", "center": [<-0.2>, <-0.1>, 0], "radius": <0.3>}],
      "media": [{"bounds": [[<-1>, <-1>, <-1>], [<1>, <1>, <1>]], "density": {"type": "perlin", "resolution": [12, 12, 12]},
          "sigma_a": [<-1 0.2>, <-1 0.5>, <-1 1>], "sigma_s": <-1 2>, "phase": {"type": "henyey_greenstein", "g": 0.6}},
        {"bounds": [[<-0.5>, <-1>, <-1>], [<1.2>, <0>, <0.3>]], "density": {"type": "constant"}, "sigma_a": <-1 0.5>,
          "sigma_s": <-1 0.4>, "emission": [<-1 0.1>, 0, <-1 0.3>]}]})"},
    {"mesh",
     R"({"camera": {"type": "orthographic", "eye": [0, <1>, <4>], "target": [0, 0, 0], "height": <2.5>}, "background": 0.1,
      "lights": [{"type": "directional", "direction": [-1, -1, -0.5], "irradiance": 3}],
      "shapes": [{"type": "mesh", "file": "corners.obj", "transform": [{"scale": <1>}]}]})"},
    {"rough ball",  // that mirrors and shades itself
     R"({"camera": {"eye": [<0.5>, <1.2>, <2.6>], "target": [0, 0, 0], "vfov": 45}, "background": [0.1, 0.2, 0.3],
      "lights": [{"type": "point", "position": [<2>, <1>, <0.4>], "intensity": <2 6>}],
      "materials": {"mirror": {"diffuse": 0.4, "reflection": 0.5}},
      "shapes": [{"type": "mesh", "file": "ball.obj", "transform": [{"scale": <1>}], "material": "mirror"},
        {"type": "quad", "corner": [<-2>, <-1>, <-2>], "u": [0, 0, <4>], "v": [<4>, 0, 0]}]})"},
    {"floor", R"({"camera": {"eye": [0, <2>, <4>], "target": [0, 0, 0], "vfov": 40}, "background": 0.3,
      "lights": [{"type": "point", "position": [0, <1>, 0], "intensity": <2 3>}],
      "materials": {"checker": {"diffuse": 1, "texture": {"type": "checker", "scale": <-1 1>}}},
      "shapes": [{"type": "plane", "material": "checker"}]})"},
};

using Scale = Program;

TEST_F(Scale, ThePictureIsTheSameFromTenToTheMinus25To25) {
  write("corners.obj", CORNERS_OBJ);
  write("ball.obj", closed_mesh(3, 0.05).obj());
  for (const World& world : WORLDS) {
    const Film base = film_of(scene_of(in_units(world.text, 1), folder_));
    expect_shows(base, world.name);
    for (const double unit : {1e-25, 1e-14, 3e-7, 1e-4, 1e4, 1e13, 1e25}) {
      const std::string what = std::string(world.name) + " times " + number_text(unit);
      const PlannedScene scene = scene_of(in_units(world.text, unit), folder_);
      const Film film = film_of(scene);
      expect_same(film, base, 1e-4, what);
      expect_depths(film, base, unit, what);
      expect_same(film, reference_of(scene), 1e-4, what + ", reference");
    }
  }
}

// Nor does what is small in a world care how large the sky about it is.
TEST(ScaleWithin, SmallThingsInALargeWorldStay) {
  const auto film = [](double radius) {
    std::string text = in_units(WORLDS[0].text, 1);
    text.insert(text.find(R"("mirror":)"), R"("sky": {"diffuse": 0, "emission": 0.3}, )");
    text.insert(text.find(R"({"type": "sphere")"),
                R"({"type": "sphere", "material": "sky", "radius": )" + number_text(radius) + "}, ");
    return film_of(scene_of(text));
  };
  const Film base = film(1e6);
  expect_shows(base, "sky");
  for (const double radius : {1e10, 1e15, 1e17}) expect_same(film(radius), base, 1e-4, number_text(radius));
}

// A power of two rounds nothing.
TEST_F(Scale, PowersOfTwoLeaveEveryBit) {
  write("corners.obj", CORNERS_OBJ);
  write("ball.obj", closed_mesh(3, 0.05).obj());
  for (const World& world : WORLDS) {
    const Film base = film_of(scene_of(in_units(world.text, 1), folder_));
    for (const double unit : {0x1p-80, 0x1p80}) {
      const Film film = film_of(scene_of(in_units(world.text, unit), folder_));
      for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        const FilmPixel &p = film.pixels()[i], &q = base.pixels()[i];
        ASSERT_EQ(p.radiance.x, q.radiance.x) << world.name << " " << unit << ", pixel " << i;
        ASSERT_EQ(p.depth, static_cast<float>(q.depth * unit)) << world.name << " " << unit << ", pixel " << i;
      }
    }
  }
}

std::string view_from(double distance, bool perspective, const std::string& more) {
  const std::string lens = perspective ? R"("vfov": )" + number_text(2 * std::atan(1 / distance) * 180 / M_PI)
                                       : R"("type": "orthographic", "height": 2)";
  return R"({"camera": {"eye": [0.3, )" + number_text(0.6 * distance) + ", " + number_text(0.8 * distance) +
         R"(], "target": [0.3, 0, 0], )" + lens + R"(},
    "lights": [{"type": "directional", "direction": [0, -0.6, -0.8], "irradiance": 3}],
    "shapes": [{"type": "sphere", "radius": 0.8}, {"type": "box", "min": [-1, -0.1, 0.7], "max": [1, 0.1, 0.9]})" +
         more + R"(], "background": 0.5,
    "media": [{"density": {"type": "perlin", "resolution": [16, 16, 16]}, "sigma_a": 1, "sigma_s": 0.5}]})";
}

constexpr const char* FLOOR = R"(, {"type": "plane", "point": [0, -0.5, 0]})";

TEST(CameraDistance, IsNoParameterOfParallelRays) {
  for (const char* more : {"", FLOOR}) {
    const Film near = film_of(scene_of(view_from(4, false, more)));
    expect_shows(near, more);
    for (const double distance : {5e2, 5e4, 5e7, 1e12, 1e20, 1e30}) {
      const PlannedScene scene = scene_of(view_from(distance, false, more));
      const Film film = film_of(scene);
      expect_same(film, near, 2e-5, number_text(distance) + more);
      expect_same(film, reference_of(scene), 1e-4, number_text(distance) + more + ", reference");
    }
  }
}

TEST(CameraDistance, NarrowLensesSeeWhatParallelRaysSee) {
  for (const char* more : {"", FLOOR}) {
    const Film parallel = film_of(scene_of(view_from(4, false, more)));
    for (const double distance : {5e5, 5e7, 1e10}) {
      const PlannedScene scene = scene_of(view_from(distance, true, more));
      const Film film = film_of(scene);
      expect_same(film, parallel, 5e-5, number_text(distance) + more);
      expect_same(film, reference_of(scene), 1e-4, number_text(distance) + more + ", reference");
      EXPECT_NEAR(film.pixels()[12 * 24 + 12].depth / distance, 1, 1e-5) << distance;
    }
  }
}

// A plane between a far camera and the scene hides it.
TEST(CameraDistance, PlanesBeforeTheSceneAreSeen) {
  for (const double distance : {8.0, 1e3, 1e9}) {
    const std::string wall =
        R"(, {"type": "plane", "point": [0, 0, )" + number_text(0.5 * distance) + R"(], "normal": [0, 0, 1]})";
    const PlannedScene scene = scene_of(view_from(distance, true, wall));
    const Film film = film_of(scene);
    expect_same(film, reference_of(scene), 1e-4, wall);
    for (const FilmPixel& p : film.pixels()) ASSERT_NEAR(p.depth / (0.375 * distance), 1, 0.2) << wall;
  }
}

TEST(LightDistance, FarPointLightsAreDirectional) {
  const char* text = R"({"camera": {"eye": [1.5, 1.5, 3.5]}, "background": 0.1, "lights": [%s],
    "shapes": [{"type": "sphere", "radius": 0.5}],
    "media": [{"density": {"type": "linear", "resolution": [8, 8, 8]}, "sigma_s": 0.9}]})";
  char scene[1000];
  std::snprintf(scene, sizeof scene, text, R"({"type": "directional", "direction": [-0.6, -0.8, 0], "irradiance": 2})");
  const Film sun = film_of(scene_of(scene));
  expect_shows(sun, "sun");
  for (const double distance : {1e6, 1e10, 1e15, 1e20, 1e30, 3e38}) {
    const std::string light = R"({"type": "point", "position": [)" + number_text(0.6 * distance) + ", " +
                              number_text(0.8 * distance) + R"(, 0], "intensity": )" +
                              number_text(2 * distance * distance) + "}";
    std::snprintf(scene, sizeof scene, text, light.c_str());
    expect_same(film_of(scene_of(scene)), sun, 1e-4, light);
  }
}

// A disc of radius 0.6 in the middle of the picture, from however far.
TEST(LightDistance, NarrowSpotsLightADisc) {
  for (const double distance : {10.0, 1e3, 2e4}) {
    const PlannedScene scene = scene_of(
        R"({"camera": {"type": "orthographic"}, "shapes": [{"type": "quad", "corner": [-1, -1, 0], "u": [2, 0, 0], "v": [0, 2, 0]}],
        "lights": [{"type": "spot", "falloff": "none", "softness": 0, "position": [0, 0, )" +
        number_text(distance) + R"(], "direction": [0, 0, -1], "angle": )" +
        number_text(std::atan(0.6 / distance) * 180 / M_PI) + "}]}");
    const Film film = film_of(scene);
    for (int i = 0; i < 24 * 24; ++i) {
      const double radius = std::hypot((i % 24 - 11.5) / 12, (i / 24 - 11.5) / 12);
      if (std::abs(radius - 0.6) < 0.01) continue;
      ASSERT_EQ(film.pixels()[std::size_t(i)].radiance.y > 0, radius < 0.6) << distance << ", pixel " << i;
    }
  }
}

}  // namespace
}  // namespace brume::test
