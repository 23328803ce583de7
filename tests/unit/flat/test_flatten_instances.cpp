// Meshes with instances in the flat scene: what is held once, where it stands, which of them are lights.
#include <glm/geometric.hpp>

#include "flat/flat_scene.hpp"
#include "flat/transform.hpp"
#include "plan/planned_scene.hpp"
#include "scene/scene_reader.hpp"
#include "shared/ray.h"
#include "unit/mesh/obj_fixture.hpp"

namespace brume {
namespace {

using namespace test;
using testing::HasSubstr;

// A strip of so many triangles in the plane z = 0.
std::string strip(int triangles) {
  std::string text = "v 0 0 0\nv 0 1 0\n";
  for (int i = 0; i < triangles; ++i)
    text += "v " + std::to_string(i / 2 + 1) + " " + std::to_string(i % 2) + " 0\nf -3 -2 -1\n";
  return text;
}

class FlattenInstances : public Obj {
 protected:
  void SetUp() override {
    Obj::SetUp();
    write(strip(40));
    write(strip(32), "small.obj");
  }
  PlannedScene flat(const std::string& shapes, const std::string& materials = "{}") const {
    const std::string text = R"({"materials": )" + materials + R"(, "shapes": [)" + shapes + "]}";
    return flatten(scene_read_text(text, folder_ / "a.json", {}), {});
  }
  std::string refused(const std::string& shapes, const std::string& materials = "{}") const {
    try {
      flat(shapes, materials);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
};

TEST_F(FlattenInstances, AFileThatSeveralShapesNameIsHeldOnce) {
  const std::string mesh = R"({"type": "mesh", "file": "a.obj", "transform": [{"scale": )";
  const PlannedScene scene = flat(mesh + "1}]}, " + mesh + "2}]}, " + mesh + R"(3}], "shading": "flat"})");
  EXPECT_EQ(scene.world_triangles(), 40u) << "of the shape that is shaded otherwise";
  EXPECT_EQ(scene.triangles.size(), 80u);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].first, 40);
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.frame.triangle_count, 40);
  EXPECT_GE(scene.frame.instance_root, 0);
}

TEST_F(FlattenInstances, OneOrAFewTrianglesAreWrittenOut) {
  const std::string small = R"({"type": "mesh", "file": "small.obj"})";
  EXPECT_EQ(flat(small + ", " + small).triangles.size(), 64u);
  EXPECT_TRUE(flat(small + ", " + small).instances.empty());
  EXPECT_TRUE(flat(R"({"type": "mesh", "file": "a.obj"})").instances.empty());
  EXPECT_EQ(flat(R"({"type": "mesh", "file": "a.obj"})").frame.instance_root, -1);
  const PlannedScene asked = flat(R"({"type": "mesh", "file": "small.obj", "instances": [[]]})");
  EXPECT_EQ(asked.instances.size(), 1u) << "where the scene asks for it, of any mesh";
  EXPECT_EQ(asked.world_triangles(), 0u);
}

// Corners of the mesh by the instance's own map, against the transform of shape and instance.
TEST_F(FlattenInstances, StandWhereTransformAndInstanceSay) {
  write("0 0 1 10 0 1 0 20 -1 0 0 30\n1 0 0 0 0 1 0 0 0 0 1 -5e3\n", "herd.txt");
  const PlannedScene scene =
      flat(R"({"type": "mesh", "file": "a.obj", "transform": [{"scale": [2, 3, 4]}], "instances": "herd.txt"})");
  ASSERT_EQ(scene.instances.size(), 2u);
  const Packed3 corner = scene.triangles[39].p[2];  // (20, 1, 0) of the file
  const auto stands = [&](int i) {
    return scene.world(transform_point(matrix(scene.instances[i].world_from_mesh), {corner.x, corner.y, corner.z}));
  };
  EXPECT_LT(glm::distance(stands(0), glm::dvec3(10, 23, -10)), 1e-3);
  EXPECT_LT(glm::distance(stands(1), glm::dvec3(40, 3, -5000)), 1e-3);
  for (const Instance& instance : scene.instances) {
    const dmat4 both = matrix(instance.mesh_from_world) * matrix(instance.world_from_mesh);
    for (int k = 0; k < 3; ++k) EXPECT_LT(glm::distance(glm::dvec3(both[k]), glm::dvec3(dmat4(1.0)[k])), 1e-6);
    for (const int offset : {3, 7, 11}) EXPECT_GE(instance.reach, std::abs(instance.world_from_mesh.m[offset]));
  }
}

TEST_F(FlattenInstances, SingularOnesAreRefusedByNumber) {
  std::string nothing;  // 1e-360
  for (int i = 0; i < 12; ++i) nothing += std::string(i > 0 ? ", " : "") + R"({"scale": [1, 1e-30, 1]})";
  EXPECT_THAT(refused(R"({"type": "mesh", "file": "a.obj", "instances": [[], [{"scale": [1e-12, 1, 1e12]}], [)" +
                      nothing + "]]}"),
              HasSubstr("/shapes/0: instance 2: the transform is singular"));
  write("1 0 0 0 0 1 0 0 0 0 0 0\n", "herd.txt");
  EXPECT_THAT(refused(R"({"type": "mesh", "file": "a.obj", "instances": "herd.txt"})"),
              HasSubstr("herd.txt: line 1: instance 0"));
}

const char* const GLOWS = R"({"glow": {"emission": 1}, "dark": {"emission": 1, "light": false}})";

TEST_F(FlattenInstances, EveryTriangleOfAnInstanceThatEmitsIsALight) {
  const std::string mesh = R"({"type": "mesh", "file": "small.obj", "instances": [[], [{"scale": [2, 3, 1]}]])";
  const PlannedScene scene = flat(mesh + R"(, "material": "glow"})", GLOWS);
  ASSERT_EQ(scene.light_sources.size(), 64u);
  EXPECT_EQ(scene.light_sources[0].instance, 0);
  EXPECT_EQ(scene.light_sources[32].instance, 1);
  EXPECT_EQ(scene.light_sources[32].primitive, scene.light_sources[0].primitive);
  EXPECT_NEAR(scene.light_sources[32].outer / scene.light_sources[0].outer, 6, 1e-5);
  EXPECT_TRUE(flat(mesh + R"(, "material": "dark"})", GLOWS).light_sources.empty());
}

TEST_F(FlattenInstances, MoreLightsThanThereIsRoomForAreRefused) {
  std::string herd;
  for (int i = 0; i < 131073; ++i) herd += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
  write(herd, "herd.txt");
  EXPECT_THAT(refused(R"({"type": "mesh", "file": "small.obj", "material": "glow", "instances": "herd.txt"})", GLOWS),
              HasSubstr("4194336 triangles of instances emit"));
  EXPECT_EQ(refused(R"({"type": "mesh", "file": "small.obj", "material": "dark", "instances": "herd.txt"})", GLOWS),
            "accepted");
}

// A mirror would otherwise turn faces inwards, and their normals with them.
TEST_F(FlattenInstances, AMirroredMeshKeepsItsOuterSide) {
  const PlannedScene scene = flat(R"({"type": "mesh", "file": "a.obj", "transform": [{"scale": [-1, 1, 1]}]})");
  const Triangle& t = scene.triangles.at(0);
  const auto corner = [&](int k) { return glm::dvec3(t.p[k].x, t.p[k].y, t.p[k].z); };
  const double outwards = glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z;
  EXPECT_GT(outwards * t.n[0].z, 0);
}

}  // namespace
}  // namespace brume
