// Meshes in the flat scene: what stands far from the origin keeps its detail, and what is told is told once.
#include "flat/flat_scene.hpp"
#include "plan/planned_scene.hpp"
#include "scene/scene_reader.hpp"
#include "unit/mesh/obj_fixture.hpp"

namespace brume {
namespace {

using namespace test;
using testing::HasSubstr;

class FlattenMesh : public Obj {
 protected:
  PlannedScene flat(const std::string& shape_keys = "", int copies = 1) const {
    const std::string shape = R"({"type": "mesh", "file": ")" + (folder_ / "a.obj").string() + "\"" + shape_keys + "}";
    std::string shapes = shape;
    for (int i = 1; i < copies; ++i) shapes += ", " + shape;
    return flatten(scene_read_text(R"({"shapes": [)" + shapes + "]}", "a.json", {}), {});
  }
  static double side(const PlannedScene& scene, int k) {
    const Triangle& t = scene.triangles.at(0);
    const glm::dvec3 a(t.p[0].x, t.p[0].y, t.p[0].z), b(t.p[k].x, t.p[k].y, t.p[k].z);
    return glm::distance(a, b) * scene.unit;
  }
};

// Coordinates of a map grid with detail of centimetres: in float they fall to steps of half a metre.
TEST_F(FlattenMesh, MapGridCoordinatesKeepTheirDetail) {
  write(
      "v 0 0 0\nv 5412345.17 3456789.13 120.01\nv 5412345.20 3456789.13 120.01\nv 5412345.17 3456789.17 120.01\nf 2 3 "
      "4\n");
  for (const char* keys : {"", R"(, "transform": [{"translate": [-5412345, -3456789, -120]}])"}) {
    const PlannedScene scene = flat(keys);
    ASSERT_EQ(scene.triangles.size(), 1u) << keys;
    EXPECT_NEAR(side(scene, 1), 0.03, 1e-6) << keys;
    EXPECT_NEAR(side(scene, 2), 0.04, 1e-6) << keys;
  }
}

TEST_F(FlattenMesh, NotesOfAMeshThatIsShownTwiceAreToldOnce) {
  write("no image", "a.png");
  write("newmtl m\nmap_Kd a.png\nnewmtl n\nmap_Kd a.png\nbump b.png\n", "a.mtl");
  write("mtllib a.mtl\n" + std::string(TRIANGLE) + "f 1 2 3\n");
  const PlannedScene scene = flat("", 2);
  EXPECT_THAT(scene.notes,
              testing::UnorderedElementsAre(HasSubstr("line 5: 'bump' is not read"), HasSubstr("a.png: ")));
}

TEST_F(FlattenMesh, CreaseReachesTheNormals) {
  write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
  EXPECT_NEAR(flat().triangles.at(0).n[0].z, std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(flat(R"(, "crease": 45)").triangles.at(0).n[0].z, 1, 1e-6);
}

TEST_F(FlattenMesh, ATriangleHasTextureCoordinates) {
  const std::string shape = R"({"type": "triangle", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]})";
  const PlannedScene scene = flatten(scene_read_text(R"({"shapes": [)" + shape + "]}", "a.json", {}), {});
  ASSERT_EQ(scene.triangles.size(), 1u);
  const float expected[] = {0, 0, 1, 0, 0, 1};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(scene.triangles[0].uv[i], expected[i]) << i;
}

}  // namespace
}  // namespace brume
