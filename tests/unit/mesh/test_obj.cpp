// The OBJ reader against what the format says: which corner gets which position, normal and texture coordinate, which
// colours of the MTL arrive, and what mesh_complete_normals adds. Polygons: test_obj_polygons.cpp; refusals:
// test_obj_refused.cpp.
#include <glm/geometric.hpp>

#include "unit/mesh/obj_fixture.hpp"

namespace brume {
namespace {

using namespace test;
using glm::dvec2;
using glm::dvec3;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

dvec3 corner(const Mesh& mesh, std::size_t triangle, int k) {
  return mesh.positions.at(mesh.triangles.at(triangle).position[k]);
}

void expect_near(const dvec3& a, const dvec3& b, double tolerance = 1e-6) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " " << b.z;
}

TEST_F(Obj, OneTriangleWithNothingElse) {
  const Mesh mesh = read("# a comment\nv 1 2 3\nv 4 2 3.5\nv 1 -2e1 3\nf 1 2 3\n");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  expect_near(corner(mesh, 0, 0), {1, 2, 3});
  expect_near(corner(mesh, 0, 1), {4, 2, 3.5});
  expect_near(corner(mesh, 0, 2), {1, -20, 3});
  EXPECT_THAT(mesh.triangles[0].normal, ElementsAre(-1, -1, -1));
  EXPECT_THAT(mesh.triangles[0].uv, ElementsAre(-1, -1, -1));
  EXPECT_EQ(mesh.triangles[0].material, -1);
  EXPECT_THAT(mesh.notes, IsEmpty());
}

// Positions, texture coordinates and normals are numbered apart: v/vt/vn.
TEST_F(Obj, CornersTakeTheirTextureCoordinateAndNormal) {
  const Mesh mesh = read(std::string(TRIANGLE) +
                         "vt 0.25 0.5\nvt 0.75 1\nvt 2 -1\nvt 0 0\n"
                         "vn 0 0 2\nvn 3 4 0\n"
                         "f 1/3/2 2/1/1 3/2/2\n");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  const MeshTriangle& t = mesh.triangles[0];
  const dvec2 uvs[] = {{2, -1}, {0.25, 0.5}, {0.75, 1}};
  const dvec3 normals[] = {{0.6, 0.8, 0}, {0, 0, 1}, {0.6, 0.8, 0}};  // made unit
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(glm::distance(mesh.uvs.at(t.uv[k]), uvs[k]), 1e-6) << k;
    expect_near(mesh.normals.at(t.normal[k]), normals[k]);
  }
}

TEST_F(Obj, TextureCoordinateOrNormalAlone) {
  const std::string start = std::string(TRIANGLE) + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
  const Mesh uv = read(start + "f 1/1 2/2 3/3\n"), normal = read(start + "f 1//1 2//1 3//1\n");
  EXPECT_THAT(uv.triangles.at(0).uv, ElementsAre(0, 1, 2));
  EXPECT_THAT(uv.triangles.at(0).normal, ElementsAre(-1, -1, -1));
  EXPECT_THAT(normal.triangles.at(0).uv, ElementsAre(-1, -1, -1));
  EXPECT_THAT(normal.triangles.at(0).normal, ElementsAre(0, 0, 0));
}

TEST_F(Obj, ANormalOfLengthZeroIsNone) {
  const Mesh mesh = read(std::string(TRIANGLE) + "vn 0 0 0\nvn 0 0 1\nf 1//1 2//2 3//2\n");
  EXPECT_EQ(mesh.triangles.at(0).normal[0], -1);
  EXPECT_NE(mesh.triangles.at(0).normal[1], -1);
}

// -1 is the last one so far, whatever follows later in the file.
TEST_F(Obj, NegativeIndicesCountBackFromTheirLine) {
  const Mesh mesh = read(
      "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 0.5 0\nvn 1 0 0\nvn 0 0 1\n"
      "f -3/-1/-1 -2/-2/-2 -1/-1/-1\n"
      "v 0 0 5\nv 1 0 5\nv 0 1 5\nvt 7 7\nvn 0 1 0\n"
      "f -3/-1/-1 -2/-1/-1 -1/-3/-3\n");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  expect_near(corner(mesh, 0, 0), {0, 0, 0});
  expect_near(corner(mesh, 0, 2), {0, 1, 0});
  expect_near(corner(mesh, 1, 0), {0, 0, 5});
  expect_near(corner(mesh, 1, 2), {0, 1, 5});
  EXPECT_THAT(mesh.triangles[0].uv, ElementsAre(1, 0, 1));
  EXPECT_THAT(mesh.triangles[0].normal, ElementsAre(1, 0, 1));
  EXPECT_THAT(mesh.triangles[1].uv, ElementsAre(2, 2, 0));
  EXPECT_THAT(mesh.triangles[1].normal, ElementsAre(2, 2, 0));
}

TEST_F(Obj, LinesMayBeContinuedAndEndInCrLf) {
  const Mesh mesh = read("v 0 0 0\r\nv 1 0 \\\r\n 0\r\nv 0 1 0\r\nf 1 \\\r\n2 3\r\n");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  expect_near(corner(mesh, 0, 1), {1, 0, 0});
}

// "\\" ends names of folders in comments, and the next line is a line of its own.
TEST_F(Obj, CommentsAreNotContinued) {
  const Mesh mesh = read("# of C:\\meshes\\\nv 0 0 0\nv 1 0 0 # C:\\\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(mesh.positions.size(), 3u);
  expect_near(corner(mesh, 0, 2), {0, 1, 0});
}

// Many files begin with a vertex at the origin, far from all that is seen.
TEST_F(Obj, VerticesThatNoTriangleHasAreLeftOut) {
  const Mesh mesh = read("v 0 0 0\nv 5e6 1 0\nv 5000001 1 0\nv 5e6 2 0\nv 7 7 7\nf 2 3 4\nf 1 1 2\n");
  ASSERT_EQ(mesh.positions.size(), 3u);
  expect_near(corner(mesh, 0, 1), {5000001, 1, 0});
}

TEST_F(Obj, NormalsAreUnitHoweverLong) {
  const Mesh mesh = read(std::string(TRIANGLE) + "vn 0 0 1e-170\nvn 3e-300 4e-300 0\nvn 0 1e37 0\nf 1//1 2//2 3//3\n");
  const dvec3 normals[] = {{0, 0, 1}, {0.6, 0.8, 0}, {0, 1, 0}};
  for (int k = 0; k < 3; ++k) expect_near(mesh.normals.at(mesh.triangles.at(0).normal[k]), normals[k]);
}

TEST_F(Obj, NumbersThatAreNotReadAreTold) {
  const std::string face = "f 1 2 3\n";
  EXPECT_THAT(read("v 0 0 0 1\nv 1 0 0 1.0\nv 0 1 0\nvt 0 0 0\n" + face).notes, IsEmpty());
  EXPECT_THAT(
      read("v 0 0 0 2\nv 1 0 0\nv 0 1 0 2\n" + face).notes,
      ElementsAre(HasSubstr("line 1: a vertex has more than three numbers; the rest is not read (2 such lines)")));
  EXPECT_THAT(read("v 0 0 0 1 1\nv 1 0 0\nv 0 1 0\n" + face).notes, ElementsAre(HasSubstr("more than three")));
  EXPECT_THAT(read("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\n" + face).notes, ElementsAre(HasSubstr("colors of vertices")));
  EXPECT_THAT(read(std::string(TRIANGLE) + "vn 0 0 1 5\nvt 0 0 1\n" + face).notes,
              ElementsAre(HasSubstr("line 4: a normal has"), HasSubstr("line 5: the third texture coordinate")));
}

TEST_F(Obj, FacesOfFewerThanThreeCornersAreTold) {
  EXPECT_THAT(read(std::string(TRIANGLE) + "f 1 2 3\nf 1 2\nf\nl 1 2\n").notes,
              ElementsAre(HasSubstr("line 5: a face has fewer than three corners; it is left out (2 such lines)"),
                          HasSubstr("line 7: 'l' is not read")));
}

TEST_F(Obj, CornersOfPolygonsKeepTheirAttributes) {
  const Mesh mesh = read(
      "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 2 0\nvt 3 1\nvt 2 2\nvt 0 2\n"
      "f 1/1 2/2 3/3 4/4 5/5\n");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (const MeshTriangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.uvs.at(t.uv[k]).x, mesh.positions.at(t.position[k]).x);
      EXPECT_EQ(mesh.uvs.at(t.uv[k]).y, mesh.positions.at(t.position[k]).y);
    }
}

TEST_F(Obj, TrianglesWithoutAreaAreLeftOutAndTold) {
  const Mesh mesh = read(std::string(TRIANGLE) + "v 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_THAT(mesh.notes, ElementsAre(AllOf(HasSubstr("a.obj"), HasSubstr("line 6: 2 triangles without area"))));
}

TEST_F(Obj, MaterialsAreThoseOfTheMtl) {
  fs::create_directories(folder_ / "maps");
  write("", "maps/wood.png");
  write(
      "newmtl red\nKa 0.1 0.2 0.3\nKd 0.9 0.25 0.125\nKs 0.5 0.4 0.3\nKe 2 3 4\nNs 32\nmap_Kd maps\\wood.png\n"
      "newmtl plain\nKd 0 0.5 1\n",
      "a.mtl");
  const Mesh mesh = read(std::string("mtllib a.mtl\n") + TRIANGLE +
                         "v 1 1 0\nf 1 2 3\nusemtl plain\nf 1 2 4\nusemtl red\nf 1 2 4 3\nf 2 4 3\n");
  ASSERT_EQ(mesh.materials.size(), 2u);
  const MeshMaterial &red = mesh.materials[0], &plain = mesh.materials[1];
  EXPECT_EQ(red.name, "red");
  expect_near(red.ambient, {0.1, 0.2, 0.3});
  expect_near(red.diffuse, {0.9, 0.25, 0.125});
  expect_near(red.specular, {0.5, 0.4, 0.3});
  expect_near(red.emission, {2, 3, 4});
  EXPECT_EQ(red.shininess, 32);
  EXPECT_EQ(red.texture.file, folder_ / "maps/wood.png");
  EXPECT_EQ(plain.name, "plain");
  expect_near(plain.diffuse, {0, 0.5, 1});
  expect_near(plain.emission, {0, 0, 0});
  EXPECT_TRUE(plain.texture.file.empty());
  std::vector<int> used;
  for (const MeshTriangle& t : mesh.triangles) used.push_back(t.material);
  EXPECT_THAT(used, ElementsAre(-1, 1, 0, 0, 0));
  EXPECT_THAT(mesh.notes, IsEmpty());
}

TEST_F(Obj, PolygonsHaveTheMaterialOfTheirFace) {
  write("newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n", "a.mtl");
  const Mesh mesh = read(
      "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\n"
      "usemtl b\nf 1 2 3 4 5\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3 4\n");
  std::vector<int> used;
  for (const MeshTriangle& t : mesh.triangles) used.push_back(t.material);
  EXPECT_THAT(used, ElementsAre(1, 1, 1, 0, 1, 1));
}

TEST_F(Obj, AMissingMtlIsToldAndTheMeshStays) {
  const Mesh mesh = read(std::string("mtllib none.mtl\n") + TRIANGLE + "usemtl red\nf 1 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0].material, -1);
  EXPECT_THAT(mesh.notes, ElementsAre(AllOf(HasSubstr("none.mtl"), HasSubstr("cannot be opened"))));
}

// A square folded along its diagonal: the shared corners have the mean of both sides, weighted by angle, the others
// their own.
TEST_F(Obj, MissingNormalsAreAngleWeightedMeans) {
  Mesh mesh = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n");
  mesh_complete_normals(mesh);
  const dvec3 z(0, 0, 1), x(1, 0, 0);
  for (const MeshTriangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const dvec3 n = mesh.normals.at(t.normal[k]);
      const int p = t.position[k];
      expect_near(n, p == 1 ? z : p == 3 ? x : glm::normalize(x + z));  // equal angles on both sides
    }
  // Two right angles on one side of corner 1 against one on the other.
  Mesh more = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nf 1 2 3\nf 1 3 5\nf 1 3 4\n");
  mesh_complete_normals(more);
  expect_near(more.normals.at(more.triangles[0].normal[0]), glm::normalize(2.0 * z + x));
}

TEST_F(Obj, EdgesSharperThanTheCreaseAreNotJoined) {
  const std::string fold = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n";  // a right angle at the edge 1 3
  const dvec3 x(1, 0, 0), z(0, 0, 1);
  for (const auto& [crease, joined] : {std::pair{0.0, false}, {89.9, false}, {90.0, true}, {180.0, true}}) {
    Mesh mesh = read(fold);
    mesh_complete_normals(mesh, crease);
    expect_near(mesh.normals.at(mesh.triangles[0].normal[0]), joined ? glm::normalize(x + z) : z);
    expect_near(mesh.normals.at(mesh.triangles[1].normal[0]), joined ? glm::normalize(x + z) : x);
    expect_near(mesh.normals.at(mesh.triangles[0].normal[1]), z);
  }
}

TEST_F(Obj, NormalsAreJoinedWithinASmoothingGroup) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const dvec3 x(1, 0, 0), z(0, 0, 1);
  const auto shared = [&](const std::string& first, const std::string& second) {
    Mesh mesh = read(start + first + "f 1 2 3\n" + second + "f 1 3 4\n");
    mesh_complete_normals(mesh);
    return mesh.normals.at(mesh.triangles[0].normal[0]);
  };
  for (const auto& [first, second] : {std::pair{"s 1\n", ""}, {"s 2\n", "s 2\n"}, {"s on\n", "s 1\n"}, {"", ""}})
    expect_near(shared(first, second), glm::normalize(x + z));
  for (const auto& [first, second] :
       {std::pair{"s 1\n", "s 2\n"}, {"s off\n", ""}, {"s 0\n", ""}, {"s 1\n", "s off\n"}})
    expect_near(shared(first, second), z);
}

TEST_F(Obj, NormalsOfTheFileStay) {
  Mesh mesh = read(std::string(TRIANGLE) + "vn 1 0 0\nf 1//1 2 3\n");
  mesh_complete_normals(mesh);
  expect_near(mesh.normals.at(mesh.triangles[0].normal[0]), {1, 0, 0});
  expect_near(mesh.normals.at(mesh.triangles[0].normal[1]), {0, 0, 1});
}

}  // namespace
}  // namespace brume
