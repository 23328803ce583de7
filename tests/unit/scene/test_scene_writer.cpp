// scene_write gives back what was read; the families and the published schema name the same members.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "scene/families.hpp"
#include "scene/scene_writer.hpp"
#include "unit/scene/scene_texts.hpp"

namespace brume {
namespace {

using testing::HasSubstr;

TEST(SceneWriter, WritesBackEveryKey) {
  const std::string text = scene_write(scene_of(SCENE_FULL), "dir");
  nlohmann::json expected = nlohmann::json::parse(SCENE_FULL);
  expected["media"][1]["density"]["path"] =
      std::filesystem::path("/data/smoke.vdb").lexically_relative(std::filesystem::absolute("dir")).generic_string();
  EXPECT_EQ(nlohmann::json::parse(text), expected) << text;
  EXPECT_EQ(scene_write(scene_of(text), "dir"), text);
}

TEST(SceneWriter, DefaultsReadBack) {
  const std::string text = scene_write(scene_of("{}"), "dir");
  EXPECT_EQ(scene_write(scene_of(text), "dir"), text);
  EXPECT_THAT(text, HasSubstr("\"eye\": [0, 0, 5]"));
  EXPECT_THAT(text, HasSubstr("\"vfov\": 40"));
}

TEST(SceneWriter, KeepsDoubles) {
  SceneDesc scene = scene_of("{}");
  scene.background = {1.0 / 3.0, 1e-300, 1e21};
  EXPECT_EQ(scene_of(scene_write(scene, "dir")).background, scene.background);
}

TEST(SceneWriter, PathsFollowTheFolder) {
  const std::string text = scene_write(scene_of(SCENE_FULL), "elsewhere/deep");
  const SceneDesc scene = scene_read_text(text, "elsewhere/deep/b.json", {});
  EXPECT_EQ(scene.materials[0].texture->file, "dir/maps/wood [1, 2].png");
  EXPECT_EQ(std::get<MeshDesc>(scene.shapes[6].geometry).file, "models/bunny.obj");
  EXPECT_TRUE(std::filesystem::equivalent("/", scene.media[1].density.file.parent_path().parent_path()));
  EXPECT_NO_THROW(scene_read_text(scene_write(scene_of(SCENE_FULL), ""), "b.json", {}));
}

TEST(SceneWriter, RefusesNamesThatAreNoText) {
  SceneDesc scene = scene_of(SCENE_FULL);
  scene.media[1].density.file = "/data/\xff.vdb";
  EXPECT_THROW(scene_write(scene, "dir"), InputError);
}

TEST(Families, NameEveryMemberOnce) {
  for (const Family* family :
       {&camera_family(), &light_family(), &falloff_family(), &material_family(), &texture_family(), &phase_family(),
        &interpolation_family(), &method_family(), &shape_family(), &mesh_shading_family(), &medium_family(),
        &liquid_model_family(), &presence_family()})
    for (std::size_t i = 0; i < family->size(); ++i) {
      EXPECT_EQ((*family)[i].id, static_cast<int>(i));
      EXPECT_EQ(family_find(*family, (*family)[i].name), &(*family)[i]);
    }
  EXPECT_EQ(method_family().size(), std::size_t(METHOD_COUNT));
}

TEST(Families, MethodsKnowWhatTheyFit) {
  EXPECT_EQ(method_fits(METHOD_DDA_NEAREST), FITS_NEAREST);
  EXPECT_EQ(method_fits(METHOD_MARCH_MIDPOINT), FITS_NEAREST | FITS_TRILINEAR);
  EXPECT_FALSE(method_has_step(METHOD_DDA_GAUSS2));
  EXPECT_TRUE(method_has_step(METHOD_HOMOGENEOUS));
}

// The published schema names the same members as the tables.
TEST(SceneSchema, ListsEveryFamily) {
  std::ifstream in(std::string(BRUME_SOURCE_DIR) + "/scenes/scene.schema.json");
  const nlohmann::json schema = nlohmann::json::parse(in);
  const auto names = [](const Family& family) {
    nlohmann::json list = nlohmann::json::array();
    for (const FamilyRow& row : family) list.push_back(row.name);
    return list;
  };
  const nlohmann::json& lists = schema["definitions"];
  EXPECT_EQ(lists["falloff"]["enum"], names(falloff_family()));
  const nlohmann::json& medium = lists["medium"]["properties"];
  EXPECT_EQ(medium["type"]["enum"], names(medium_family()));
  EXPECT_EQ(medium["model"]["enum"], names(liquid_model_family()));
  EXPECT_EQ(medium["presence"]["enum"], names(presence_family()));
  EXPECT_EQ(lists["model"]["enum"], names(material_family()));
  EXPECT_EQ(lists["interpolation"]["enum"], names(interpolation_family()));
  EXPECT_EQ(lists["shading"]["enum"], names(mesh_shading_family()));
  Family methods = method_family();
  methods.insert(methods.begin(), {METHOD_AUTO, "auto", ""});
  EXPECT_EQ(lists["method"]["enum"], names(methods));
  const auto types = [&](const char* part) {
    nlohmann::json list = nlohmann::json::array();
    for (const nlohmann::json& one : lists[part]["oneOf"]) list.push_back(one["properties"]["type"]["const"]);
    return list;
  };
  EXPECT_EQ(types("camera"), names(camera_family()));
  EXPECT_EQ(types("light"), names(light_family()));
  EXPECT_EQ(types("phase"), names(phase_family()));
  EXPECT_EQ(types("shape"), names(shape_family()));
  EXPECT_EQ(types("texture"), names(texture_family()));
  EXPECT_EQ(lists["texture"]["oneOf"][0]["properties"]["wrap"]["enum"], names(wrap_family()));
  const nlohmann::json& render = schema["properties"]["render"]["properties"];
  Family shadows = shadow_family();
  shadows.insert(shadows.begin(), {SHADOW_AUTO, "auto", ""});
  EXPECT_EQ(render["shadow"]["enum"], names(shadows));
  Family rules = in_scattering_family();
  rules.insert(rules.begin(), {IN_SCATTERING_AUTO, "auto", ""});
  EXPECT_EQ(render["in_scattering"]["enum"], names(rules));
  EXPECT_EQ(schema["properties"]["film"]["properties"]["transfer"]["enum"], names(transfer_family()));
  EXPECT_EQ(render["storage"]["enum"], names(storage_family()));
  const nlohmann::json& file = lists["density"]["oneOf"].back()["properties"];
  EXPECT_EQ(file["level_set"]["enum"], names(level_set_family()));
  EXPECT_EQ(file["negative"]["enum"], names(negative_family()));
}

}  // namespace
}  // namespace brume
