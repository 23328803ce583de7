// Material libraries as other programs write them: what arrives, and what is told with file and line.
#include <glm/geometric.hpp>

#include "unit/mesh/obj_fixture.hpp"

namespace brume {
namespace {

using namespace test;
using glm::dvec3;
using testing::Contains;
using testing::HasSubstr;

class Mtl : public Obj {
 protected:
  Mesh with(const std::string& mtl, const std::string& use = "m") const {
    write(mtl, "a.mtl");
    return read("mtllib a.mtl\n" + std::string(TRIANGLE) + "usemtl " + use + "\nf 1 2 3\n");
  }
};

TEST_F(Mtl, ByteOrderMarksBlanksAndComments) {
  const Mesh mesh = with("\xEF\xBB\xBFnewmtl  dark blue \t# old\nKd 0.25 0.5 1 # sky\n", "dark blue  ");
  EXPECT_EQ(mesh.triangles[0].material, 0);
  EXPECT_EQ(mesh.materials.at(0).diffuse, dvec3(0.25, 0.5, 1));
  EXPECT_TRUE(mesh.notes.empty());
}

TEST_F(Mtl, NothingLeaksIntoTheNextMaterial) {
  const Mesh mesh = with("newmtl a\nKd 1 0 0\nKs 1 1 1\nillum 3\nnewmtl m\n");
  EXPECT_EQ(mesh.materials.at(1).diffuse, dvec3(0.5));
  EXPECT_EQ(mesh.materials.at(1).specular, dvec3(0));
  EXPECT_EQ(mesh.materials.at(0).reflection, 1);
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("line 5: material 'm' has no Kd")));
}

TEST_F(Mtl, WhatIsNotUnderstoodIsToldOnceAKind) {
  const Mesh mesh = with("newmtl m\nKd 0,2 0,4 0\nKs nan 0 0\nmap_Ks x.png\nmap_Ks y.png\nfoo\nd 0.5\n", "n");
  for (const char* part : {"line 2: '0,2' behind Kd is not a number; it is not read (2 such lines)",
                           "line 4: 'map_Ks' is not read (2 such lines)", "line 6: 'foo'", "shown opaque",
                           "no library has the material 'n'"})
    EXPECT_THAT(mesh.notes, Contains(HasSubstr(part))) << part;
}

TEST_F(Mtl, OptionsOfMapsAndNamesInOtherCase) {
  write("", "wood.png");
  const Mesh mesh = with("newmtl m\nmap_Kd -o 0.5 0 0 -s 2 3 -clamp on C:\\textures\\Wood.PNG\n");
  const MeshTexture& t = mesh.materials.at(0).texture;
  EXPECT_EQ(t.file, folder_ / "wood.png");
  EXPECT_EQ(t.offset, glm::dvec2(0.5, 0));
  EXPECT_EQ(t.scale, glm::dvec2(2, 3));
  EXPECT_EQ(t.wrap, MeshWrap::ONCE);
  EXPECT_EQ(mesh.materials[0].diffuse, dvec3(1));
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("is taken for it")));
}

TEST_F(Mtl, NumbersBeyondFloatAreRefused) {
  write("newmtl m\nKd 1e39 0 0\n", "a.mtl");
  const fs::path obj = write("mtllib a.mtl\n" + std::string(TRIANGLE) + "usemtl m\nf 1 2 3\n");
  EXPECT_THROW(mesh_read_obj(obj), InputError);
}

TEST_F(Mtl, GroupsCreasesAndDoubles) {
  const std::string fold = "v 5000000.01 0 0\nv 5000001.01 0 0\nv 5000000.01 1 0\nv 5000000.01 0 1\n";
  Mesh flat = read(fold + "s off\nf 1 2 3\nf 1 3 4\n"), sharp = read(fold + "f 1 2 3\nf 1 3 4\n"), soft = sharp;
  EXPECT_EQ(flat.positions[1].x, 5000001.01);
  mesh_complete_normals(flat);
  mesh_complete_normals(sharp, 89);
  mesh_complete_normals(soft, 91);
  for (const Mesh* mesh : {&flat, &sharp}) EXPECT_NEAR(mesh->normals.at(mesh->triangles[0].normal[0]).z, 1, 1e-12);
  EXPECT_NEAR(soft.normals.at(soft.triangles[0].normal[0]).z, std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace brume
