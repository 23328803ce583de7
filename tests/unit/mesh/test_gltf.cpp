// glTF files: nodes put meshes where they stand, base colour and emission become materials, images inside are found.
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "image/image.hpp"
#include "unit/mesh/foreign_fixture.hpp"

namespace brume::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Gltf : public Foreign {
 protected:
  void SetUp() override {
    Obj::SetUp();
    write(gltf_buffer(), "a.bin");
  }
  Mesh read_json(const json& file) const { return read_file("a.gltf", file.dump()); }
  std::string refusal_json(const json& file) const { return refusal_of("a.gltf", file.dump()); }
};

TEST_F(Gltf, ATriangleWithItsMaterial) {
  const Mesh mesh = read_json(gltf_json());
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.positions[1], glm::dvec3(1, 0, 0));
  EXPECT_EQ(mesh.triangles[0].group, GROUP_FLAT);  // as the standard says of faces without normals
  const auto uv = mesh.uvs[std::size_t(mesh.triangles[0].uv[2])];
  EXPECT_EQ(uv, glm::dvec2(0, 0.75));  // v = 0 is the bottom here
  const MeshMaterial& material = mesh.materials.at(std::size_t(mesh.triangles[0].material));
  EXPECT_EQ(material.name, "red");
  EXPECT_EQ(material.diffuse, glm::dvec3(1, 0.25, 0));
  EXPECT_EQ(material.emission, glm::dvec3(0, 0.5, 0));
  EXPECT_TRUE(mesh.notes.empty());
}

TEST_F(Gltf, BinaryFilesAreTheSame) {
  json file = gltf_json();
  file["buffers"][0].erase("uri");
  const Mesh mesh = read_file("a.glb", glb_text(file, gltf_buffer()));
  EXPECT_EQ(mesh.positions, read_json(gltf_json()).positions);
}

TEST_F(Gltf, NodesPutMeshesWhereTheyStand) {
  json file = gltf_json();
  file["scenes"][0]["nodes"] = {0, 1};
  file["nodes"] = json::parse(R"([{"mesh": 0, "scale": [2, 3, 4]},
    {"translation": [10, 0, 0], "children": [2]},
    {"mesh": 0, "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752], "translation": [0, 5, 0]}])");
  const Mesh mesh = read_json(file);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  const auto at = [&](std::size_t t, std::size_t k) {
    return mesh.positions[std::size_t(mesh.triangles[t].position[k])];
  };
  EXPECT_EQ(at(0, 1), glm::dvec3(2, 0, 0));
  EXPECT_EQ(at(0, 2), glm::dvec3(0, 3, 0));
  const glm::dvec3 turned = at(1, 1) - glm::dvec3(10, 6, 0);  // x became y
  EXPECT_NEAR(std::abs(turned.x) + std::abs(turned.y) + std::abs(turned.z), 0, 1e-6);
}

// As often as a copy would take more room than saying where it stands.
TEST_F(Gltf, AMeshOfSeveralNodesIsHeldOnce) {
  const auto read_with = [&](std::uint32_t triangles) {
    json file = gltf_json();
    std::string buffer = gltf_buffer();
    for (std::uint32_t i = 1; i < triangles; ++i) buffer += buffer.substr(60, 12);
    write(buffer, "a.bin");
    file["buffers"][0]["byteLength"] = buffer.size();
    file["bufferViews"][2]["byteLength"] = 12 * triangles;
    file["accessors"][2]["count"] = 3 * triangles;
    file["scenes"][0]["nodes"] = {0, 1, 2};
    file["nodes"] =
        json::parse(R"([{"mesh": 0, "scale": [2, 3, 4]}, {"mesh": 0, "translation": [10, 0, 0]}, {"mesh": 1}])");
    file["meshes"].push_back(file["meshes"][0]);
    return read_json(file);
  };
  const Mesh mesh = read_with(33);
  ASSERT_EQ(mesh.parts.size(), 1u);
  EXPECT_EQ(mesh.parts[0].first, 33u) << "behind the mesh of one node";
  EXPECT_EQ(mesh.parts[0].count, 33u);
  ASSERT_EQ(mesh.parts[0].placements.size(), 2u);
  EXPECT_EQ(mesh.parts[0].placements[0] * glm::dvec4(1, 1, 1, 1), glm::dvec3(2, 3, 4));
  EXPECT_EQ(mesh.parts[0].placements[1] * glm::dvec4(1, 1, 1, 1), glm::dvec3(11, 1, 1));
  EXPECT_EQ(mesh.triangles.size(), 66u);
  EXPECT_TRUE(read_with(32).parts.empty());
  EXPECT_EQ(read_with(32).triangles.size(), 96u);
}

TEST_F(Gltf, AMirroredNodeKeepsTheOuterSide) {
  json file = gltf_json();
  file["nodes"][0]["scale"] = {-1, 1, 1};
  const Mesh mesh = read_json(file);
  const auto at = [&](int k) { return mesh.positions[std::size_t(mesh.triangles[0].position[k])]; };
  EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).z, 0);
}

TEST_F(Gltf, NormalsAreTurnedWithTheirNodes) {
  json file = gltf_json();
  std::string buffer = gltf_buffer();
  for (int i = 0; i < 3; ++i)
    for (const float v : {1, 1, 0}) buffer += bytes_of(v);
  write(buffer, "a.bin");
  file["buffers"][0]["byteLength"] = buffer.size();
  file["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 36}});
  file["accessors"].push_back({{"bufferView", 3}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  file["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 3;
  file["nodes"][0]["scale"] = {2, 1, 1};
  const Mesh mesh = read_json(file);
  const glm::dvec3 n = mesh.normals[std::size_t(mesh.triangles[0].normal[0])];
  EXPECT_NEAR(n.x, 1 / std::sqrt(5.0), 1e-6);  // of the inverse scale
  EXPECT_NEAR(n.y, 2 / std::sqrt(5.0), 1e-6);
}

TEST_F(Gltf, ImagesLieBesideOrInside) {
  image_write_display(folder_ / "my image.png", 2, 1, {1, 1, 1, 0, 0, 0});
  std::string png;
  {
    std::ifstream in(folder_ / "my image.png", std::ios::binary);
    png.assign(std::istreambuf_iterator<char>(in), {});
  }
  json file = gltf_json();
  file["textures"] = {{{"source", 0}}};
  file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  file["images"] = {{{"uri", "my%20image.png"}}};
  EXPECT_EQ(read_json(file).materials[0].texture.file, folder_ / "my image.png");

  file["buffers"][0].erase("uri");
  file["buffers"][0]["byteLength"] = 72 + png.size();
  file["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 72}, {"byteLength", png.size()}});
  file["images"] = {{{"bufferView", 3}, {"mimeType", "image/png"}}};
  const Mesh inside = read_file("a.glb", glb_text(file, gltf_buffer() + png));
  const Image image = image_read_texture(inside.materials[0].texture.file);
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.values, image_read_texture(folder_ / "my image.png").values);
  EXPECT_THAT(inside.materials[0].texture.name, testing::StartsWith((folder_ / "a.glb").string()));
}

TEST_F(Gltf, SamplersSayHowImagesGoOn) {
  json file = gltf_json();
  file["textures"] = {{{"source", 0}, {"sampler", 0}}};
  file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  file["images"] = {{{"uri", "a.png"}}};
  const std::pair<int, MeshWrap> modes[] = {
      {10497, MeshWrap::REPEAT}, {33071, MeshWrap::CLAMP}, {33648, MeshWrap::MIRROR}};
  for (const auto& [mode, wrap] : modes) {
    file["samplers"] = {{{"wrapS", mode}, {"wrapT", mode}}};
    EXPECT_EQ(read_json(file).materials[0].texture.wrap, wrap) << mode;
  }
}

TEST_F(Gltf, WhatIsShownOtherwiseIsTold) {
  json file = gltf_json();
  file["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 1;
  file["materials"][0]["alphaMode"] = "BLEND";
  file["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
  const std::vector<std::string> notes = read_json(file).notes;
  EXPECT_THAT(notes, testing::Contains(HasSubstr("metallic and roughness are not shown")));
  EXPECT_THAT(notes, testing::Contains(HasSubstr("alpha is not shown")));
}

TEST_F(Gltf, DamagedFilesAreRefused) {
  const auto with = [&](const std::function<void(json&)>& change) {
    json file = gltf_json();
    change(file);
    return refusal_json(file);
  };
  EXPECT_THAT(refusal_of("a.gltf", ""), HasSubstr("is no glTF file"));
  EXPECT_THAT(refusal_of("a.glb", "solid"), HasSubstr("is no binary glTF file"));
  EXPECT_THAT(refusal_of("a.gltf", "{}"), HasSubstr("is damaged where it begins"));
  EXPECT_THAT(with([](json& f) { f["buffers"][0]["uri"] = "none.bin"; }), HasSubstr("none.bin"));
  EXPECT_THAT(with([](json& f) { f["buffers"][0]["byteLength"] = 1000000000000; }), HasSubstr("byteLength"));
  EXPECT_THAT(with([](json& f) { f["accessors"][0]["count"] = 4000000000; }), HasSubstr("out of range"));
  EXPECT_THAT(with([](json& f) { f["bufferViews"][0]["byteOffset"] = 100000; }), HasSubstr("out of range"));
  EXPECT_THAT(with([](json& f) { f["nodes"][0]["mesh"] = 7; }), HasSubstr("out of bounds"));
  EXPECT_THAT(with([](json& f) { f["nodes"][0]["children"] = {0}; }), HasSubstr("recursive"));
  EXPECT_THAT(with([](json& f) { f["nodes"][0]["translation"] = {1e39, 0, 0}; }), HasSubstr("no number up to 1e38"));
  EXPECT_THAT(with([](json& f) { f["materials"][0]["emissiveFactor"] = {-1, 0, 0}; }), HasSubstr("a colour is no"));
}

TEST_F(Gltf, IndicesOutOfRangeAreRefused) {
  for (const std::uint32_t index : {3u, 1000u, 0xffffffffu}) {
    write(gltf_buffer(index), "a.bin");
    EXPECT_NE(refusal_json(gltf_json()), "accepted") << index;
  }
}

// 2^40 triangles, and as deep as a stack is not.
TEST_F(Gltf, NodesThatMultiplyEndSoon) {
  json file = gltf_json();
  file["nodes"].clear();
  for (int i = 0; i < 40; ++i) file["nodes"].push_back({{"children", {i + 1, i + 1}}});
  file["nodes"].push_back({{"mesh", 0}});
  EXPECT_NE(refusal_json(file), "accepted");
  file["nodes"].clear();
  for (int i = 0; i < 200000; ++i) file["nodes"].push_back({{"children", {i + 1}}});
  file["nodes"].push_back({{"mesh", 0}});
  EXPECT_NE(refusal_json(file), "accepted");
}

}  // namespace
}  // namespace brume::test
