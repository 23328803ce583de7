// scene_read: defaults, paths, files that are no scenes, --set, mutated texts. Refusals part by part:
// test_scene_refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <random>

#include "scene/scene_writer.hpp"
#include "unit/scene/scene_texts.hpp"

namespace brume {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(SceneReader, EmptySceneIsTheDefaults) {
  const SceneDesc scene = scene_of("{}");
  EXPECT_EQ(scene.file, "dir/a.json");
  EXPECT_EQ(scene.camera.type, CAMERA_PERSPECTIVE);
  EXPECT_EQ(scene.camera.eye, dvec3(0, 0, 5));
  EXPECT_EQ(scene.camera.vfov, 40);
  EXPECT_EQ(scene.film.size, ivec2(512, 512));
  EXPECT_EQ(scene.film.spp, 1);
  EXPECT_EQ(scene.background, dvec3(0));
  EXPECT_TRUE(scene.lights.empty() && scene.materials.empty() && scene.shapes.empty() && scene.media.empty());
  EXPECT_EQ(scene.render.method, METHOD_AUTO);
  EXPECT_EQ(scene.render.step, 0.05);
  EXPECT_EQ(scene.render.max_depth, 5);
  EXPECT_EQ(scene.render.seed, 0);
}

TEST(SceneReader, PartsHaveDefaults) {
  const SceneDesc scene = scene_of(R"({"lights": [{"type": "spot", "position": [0, 1, 0], "direction": [0, -1, 0]}],
    "materials": {"m": {"texture": {"type": "checker"}}}, "shapes": [{"type": "sphere"}],
    "media": [{"density": {"type": "perlin"}, "phase": {"type": "henyey_greenstein"}}]})");
  EXPECT_EQ(scene.lights[0].intensity, dvec3(1));
  EXPECT_EQ(scene.lights[0].falloff, FALLOFF_INVERSE_SQUARE);
  EXPECT_EQ(scene.lights[0].angle, 30);
  EXPECT_EQ(scene.lights[0].softness, 0.1);
  EXPECT_EQ(scene.materials[0].model, MATERIAL_LAMBERT);
  EXPECT_EQ(scene.materials[0].diffuse, dvec3(0.5));
  EXPECT_EQ(scene.materials[0].texture->colors[0], dvec3(1));
  EXPECT_EQ(scene.shapes[0].material, -1);
  EXPECT_EQ(scene.shapes[0].place, "/shapes/0");
  EXPECT_EQ(std::get<SphereDesc>(scene.shapes[0].geometry).radius, 1);
  EXPECT_FALSE(scene.media[0].bounds);
  EXPECT_EQ(scene.media[0].interpolation, INTERPOLATION_TRILINEAR);
  EXPECT_EQ(scene.media[0].density.resolution, ivec3(64));
  EXPECT_EQ(scene.media[0].sigma_s, dvec3(0));
  EXPECT_EQ(scene.media[0].g, 0);
  EXPECT_EQ(scene.media[0].place, "/media/0");
}

TEST(SceneReader, ANumberIsAGreyTriple) {
  const SceneDesc scene =
      scene_of(R"({"background": 2, "media": [{"density": {"type": "constant"}, "sigma_a": 0.5}]})");
  EXPECT_EQ(scene.background, dvec3(2));
  EXPECT_EQ(scene.media[0].sigma_a, dvec3(0.5));
}

TEST(SceneReader, PathsAreRelativeToTheSceneFile) {
  const SceneDesc scene = scene_of(SCENE_FULL);
  EXPECT_EQ(scene.materials[0].texture->file, "dir/maps/wood [1, 2].png");
  EXPECT_EQ(std::get<MeshDesc>(scene.shapes[6].geometry).file, "models/bunny.obj");
  EXPECT_EQ(scene.media[1].density.file, "/data/smoke.vdb");
}

TEST(SceneReader, FilesThatAreNoScenes) {
  const auto error = [](const std::filesystem::path& file) {
    try {
      scene_read(file, {});
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  char name[] = "/tmp/brume_scene_XXXXXX";
  const std::filesystem::path folder = mkdtemp(name);
  const auto file = [&](const char* leaf, std::string_view bytes) {
    std::ofstream(folder / leaf, std::ios::binary) << bytes;
    return folder / leaf;
  };
  EXPECT_THAT(error(folder), HasSubstr(": is a folder, expected a scene file"));
  EXPECT_THAT(error(folder / "none.json"), HasSubstr(": cannot be opened: No such file"));
  EXPECT_THAT(error(file("empty.json", "")), HasSubstr("empty.json: is empty"));
  EXPECT_THAT(error(file("picture.json", std::string_view("\x89PNG\r\n\x1a\n\0\0", 10))),
              HasSubstr(": is not a plain text file"));
  EXPECT_THAT(error(file("large.json", "{}" + std::string(64u << 20, ' '))),
              HasSubstr(": is too large, expected a scene file of at most 64 MiB"));
  EXPECT_THAT(error("/dev/zero"), HasSubstr(": is not a regular file"));
  EXPECT_EQ(error(file("bom.json", "\xEF\xBB\xBF{}")), "no error");
  std::filesystem::remove_all(folder);
}

TEST(SceneOverrides, ChangeAndAdd) {
  const SceneDesc scene =
      scene_of(SCENE_FULL, {"/film/spp=16", "/render/method=dda_nearest", "/camera/eye=[9, 8, 7]", "/background=1",
                            "/lights/-={\"type\": \"point\", \"position\": [0, 0, 0]}", "/lights/3/position/1=5",
                            "/shapes/0/radius=2", "/render/method=\"auto\""});
  EXPECT_EQ(scene.film.spp, 16);
  EXPECT_EQ(scene.camera.eye, dvec3(9, 8, 7));
  EXPECT_EQ(scene.background, dvec3(1));
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.lights[3].position, dvec3(0, 5, 0));
  EXPECT_EQ(std::get<SphereDesc>(scene.shapes[0].geometry).radius, 2);
  EXPECT_EQ(scene.render.method, METHOD_AUTO);
  EXPECT_EQ(scene_of("{}", {"/render/method=dda_nearest"}).render.method, METHOD_DDA_NEAREST);
  EXPECT_EQ(scene_of("{}", {"/shapes/-/type=sphere"}).shapes.size(), 1u);
  EXPECT_EQ(scene_of("{}", {"/materials/a~1b/diffuse=1"}).materials[0].name, "a/b");
}

TEST(SceneOverrides, BadOnesAreRefused) {
  struct {
    const char* change;
    const char* error;
  } const table[] = {
      {"/film/spp", "--set /film/spp: expected /json/pointer=VALUE"},
      {"film/spp=1", "--set film/spp: expected /json/pointer=VALUE"},
      {"=1", "--set : expected /json/pointer=VALUE"},
      {"/a~2=1", "--set /a~2: not a JSON pointer"},
      {"/film/spp/x=1", "--set /film/spp/x: /film/spp is 9, expected an object or a list that has 'x'"},
      {"/lights/7=1", "--set /lights/7: '7' is beyond the end of the list; allowed: 0 to 3, or - to append"},
      {"/lights/4000000000=1", "--set /lights/4000000000: '4000000000' is not an index of a list"},
      {"/lights/-/x/999999999=1", "--set /lights/-/x/999999999: '999999999' is beyond the end of the list"},
      {"/lights/x=1", "--set /lights/x: 'x' is not an index of a list"},
      {"/lights/01=1", "--set /lights/01: '01' is not an index"},
      {"/film/sp=1", "dir/a.json: /film: unknown key 'sp' (did you mean 'spp'?)"},
      {"/film/spp=many", "dir/a.json: /film/spp: expected an integer in [1, 1048576], got \"many\""},
      {"/film/spp=1e400", "dir/a.json: /film/spp: expected an integer in [1, 1048576], got \"1e400\""},
      {"/film/spp=", "dir/a.json: /film/spp: expected an integer in [1, 1048576], got \"\""},
  };
  for (const auto& row : table) EXPECT_THAT(scene_error(SCENE_FULL, {row.change}), StartsWith(row.error)) << row.change;
  EXPECT_THAT(scene_error(SCENE_FULL, {"/film=" + std::string(100000, '[')}), HasSubstr("/film: expected an object"));
}

TEST(SceneReader, MutatedTextsParseOrAreRefused) {
  std::mt19937 random(1);
  const std::string full = SCENE_FULL;
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = full;
    const int changes = 1 + static_cast<int>(random() % 3);
    for (int k = 0; k < changes; ++k) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text[at] = "0123456789-+.eE\"[]{},:/*"[random() % 24];
          break;
        case 2:
          text.erase(at, 1 + random() % 8);
          break;
        case 3:
          text.resize(i % 5 ? at + 1 : text.size());
          break;
      }
      if (text.empty()) break;
    }
    try {
      scene_of(text);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
      EXPECT_LT(std::string_view(error.what()).size(), 600u) << error.what();
    }
  }
  EXPECT_GT(refused, 1000);  // and some are fine: a digit changed
  EXPECT_LT(refused, 2000);
}

TEST(SceneReader, ACameraAloneOrOfAScene) {
  const CameraDesc alone = camera_read(R"({"type": "orthographic", "eye": [1, 2, 3], "height": 4})", "c.json");
  EXPECT_EQ(alone.type, CAMERA_ORTHOGRAPHIC);
  EXPECT_EQ(alone.height, 4);
  const CameraDesc again = camera_read(camera_write(alone), "c.json");
  EXPECT_EQ(again.eye, dvec3(1, 2, 3));
  EXPECT_EQ(again.height, 4);
  EXPECT_EQ(camera_read(R"({"camera": {"vfov": 20}, "shapes": "not looked at"})", "a.json").vfov, 20);
  EXPECT_EQ(camera_read("{}", "c.json").vfov, 40);
}

TEST(SceneReader, WhatIsNoCameraIsRefused) {
  const auto error = [](const char* text) -> std::string {
    try {
      camera_read(text, "c.json");
    } catch (const InputError& refused) {
      return refused.what();
    }
    return "no error";
  };
  EXPECT_THAT(error("[]"), StartsWith("c.json: /: expected an object"));
  EXPECT_THAT(error(R"({"shapes": []})"), StartsWith("c.json: /: is a scene without a camera"));
  EXPECT_THAT(error(R"({"vfov": 180})"), StartsWith("c.json: /vfov: expected a number in (0, 180)"));
  EXPECT_THAT(error(R"({"camera": {"vfov": 180}})"), StartsWith("c.json: /camera/vfov: expected"));
  EXPECT_THAT(error(R"({"eye": [0, 0, 0]})"), StartsWith("c.json: /: eye and target are the same point"));
  EXPECT_THAT(error(R"({"fov": 20})"), StartsWith("c.json: /: unknown key 'fov' (did you mean 'vfov'?)"));
}

}  // namespace
}  // namespace brume
