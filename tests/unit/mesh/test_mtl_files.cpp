// Which files an OBJ and its MTL mean, as they lie on another disk than the one they were written on.
#include "unit/mesh/obj_fixture.hpp"

namespace brume {
namespace {

using namespace test;
using glm::dvec3;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MtlFiles : public Obj {
 protected:
  void SetUp() override {
    Obj::SetUp();
    for (const char* folder : {"art", "art/textures"}) fs::create_directories(folder_ / folder);
  }
  Mesh with(const std::string& mtllib, const std::string& use = "m") const {
    return read("mtllib " + mtllib + "\n" + TRIANGLE + "usemtl " + use + "\nf 1 2 3\n");
  }
  fs::path texture(const std::string& map) const {
    write("newmtl m\nmap_Kd " + map + "\n", "a.mtl");
    const Mesh mesh = with("a.mtl");
    const fs::path file = mesh.materials.at(0).texture.file;
    return file.empty() ? file : file.lexically_relative(folder_);
  }
};

const char* const RED = "newmtl m\nKd 1 0 0\n";
const char* const OTHER = "newmtl other\nKd 0 0 1\n";

TEST_F(MtlFiles, OneLineMayNameSeveralLibraries) {
  write(OTHER, "a.mtl");
  write(RED, "my b.mtl");
  write(RED, "two");
  for (const char* line :
       {"a.mtl my b.mtl", "my b.mtl a.mtl", "a.mtl two", "two a.mtl my b.mtl", " a.mtl  my b.mtl # all"}) {
    const Mesh mesh = with(line);
    EXPECT_EQ(mesh.materials.at(mesh.triangles.at(0).material).diffuse, dvec3(1, 0, 0)) << line;
    EXPECT_GE(mesh.materials.size(), 2u) << line;
  }
  write(OTHER, "one");
  EXPECT_EQ(with("one two").materials.size(), 2u);
  write(OTHER, "one two");  // the name of one file comes first
  EXPECT_EQ(with("one two").materials.size(), 1u);
}

TEST_F(MtlFiles, EachOfSeveralIsLookedForByItself) {
  write(OTHER, "a.mtl");
  write(RED, "b.mtl");
  const Mesh mesh = with("C:\\x\\a.mtl C:\\y\\b.mtl");
  EXPECT_EQ(mesh.materials.size(), 2u);
  EXPECT_THAT(mesh.notes, ElementsAre(AllOf(HasSubstr("a.obj: line 1: 'C:\\x\\a.mtl' is not there; "),
                                            HasSubstr("is taken for it (2 such lines)"))));
}

TEST_F(MtlFiles, AMissingLibraryIsToldWithItsLineAndTheOthersStay) {
  write(RED, "b.mtl");
  const Mesh mesh = with("none.mtl b.mtl");
  EXPECT_EQ(mesh.triangles[0].material, 0);
  EXPECT_THAT(mesh.notes, ElementsAre(AllOf(HasSubstr("a.obj: line 1: "), HasSubstr("none.mtl: cannot be opened"))));
}

TEST_F(MtlFiles, NamesOfMaterialsInAnotherCaseAreTakenAndTold) {
  write("newmtl Red\nKd 1 0 0\nnewmtl RED\nKd 0 1 0\n", "a.mtl");
  EXPECT_THAT(with("a.mtl", "RED").notes, IsEmpty());
  const Mesh mesh = with("a.mtl", "red");
  EXPECT_EQ(mesh.triangles[0].material, 0);
  EXPECT_THAT(mesh.notes, ElementsAre(AllOf(HasSubstr("line 5: "), HasSubstr("'Red' is taken for it"))));
}

TEST_F(MtlFiles, ImagesAreFoundByTheEndOfTheirNameInAnyCase) {
  write("", "t.png");
  write("", "my wood #1.png");
  write("", "art/textures/wood.png");
  EXPECT_EQ(texture("t.png"), "t.png");
  EXPECT_EQ(texture("\"t.png\" # quoted"), "t.png");
  EXPECT_EQ(texture("t.png #tight"), "t.png");
  EXPECT_EQ(texture("my wood #1.png  "), "my wood #1.png");
  EXPECT_EQ(texture("art\\textures\\wood.png"), "art/textures/wood.png");
  EXPECT_EQ(texture("..\\old\\Art/Textures/WOOD.png"), "art/textures/wood.png");
  EXPECT_EQ(texture("C:\\old\\art\\textures\\wood.png"), "art/textures/wood.png");
  EXPECT_EQ(texture("C:T.PNG"), "t.png");
  EXPECT_EQ(texture("/home/artist/T.png"), "t.png");
  for (const char* none : {"C:\\old\\wood.png", "art", "none.png", "t.pn", "C:", "x/"})
    EXPECT_EQ(texture(none), "") << none;
}

// An MTL in a folder of its own names images as seen from there, or from the OBJ.
TEST_F(MtlFiles, ImagesLieBesideTheMtlOrTheObj) {
  write("", "t.png");
  write("newmtl m\nmap_Kd t.png\n", "art/a.mtl");
  EXPECT_EQ(with("art/a.mtl").materials.at(0).texture.file, folder_ / "t.png");
  write("", "art/t.png");
  EXPECT_EQ(with("art\\a.mtl").materials.at(0).texture.file, folder_ / "art/t.png");
}

TEST_F(MtlFiles, AMissingImageIsToldAndTheMaterialIsAsWithoutIt) {
  write("newmtl m\nmap_Kd none.png\nnewmtl n\nmap_Kd other.png\n", "a.mtl");
  const Mesh mesh = with("a.mtl");
  EXPECT_TRUE(mesh.materials.at(0).texture.file.empty());
  EXPECT_EQ(mesh.materials[0].diffuse, dvec3(0.5));
  EXPECT_THAT(mesh.notes,
              Contains(HasSubstr("a.mtl: line 2: 'none.png' is not there; the material goes without it (2")));
}

TEST_F(MtlFiles, WhatIsWrongWithOptionsOfMapsDoesNotHideTheImage) {
  write("", "t.png");
  for (const char* map : {"-o 0,5 0 0 t.png", "-foo t.png", "-foo 3 t.png", "-clamp yes t.png", "-mm 1 t.png"}) {
    write(std::string("newmtl m\nmap_Kd ") + map + "\n", "a.mtl");
    const Mesh mesh = with("a.mtl");
    EXPECT_EQ(mesh.materials.at(0).texture.file, folder_ / "t.png") << map;
    EXPECT_THAT(mesh.notes, Contains(HasSubstr("a.mtl: line 2: "))) << map;
  }
}

}  // namespace
}  // namespace brume
