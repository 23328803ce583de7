// Illumination models of MTL: which become highlights, mirrors and glass, and what is told of the rest.
#include "unit/mesh/obj_fixture.hpp"

namespace brume {
namespace {

using namespace test;
using glm::dvec3;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class MtlIllum : public Obj {
 protected:
  // The material of "newmtl m", these lines.
  MeshMaterial material(const std::string& lines) {
    write("newmtl m\n" + lines, "a.mtl");
    const Mesh mesh = read("mtllib a.mtl\n" + std::string(TRIANGLE) + "usemtl m\nf 1 2 3\n");
    notes_ = mesh.notes;
    return mesh.materials.at(0);
  }
  std::vector<std::string> notes_;
};

const std::string COLORS = "Kd 0.25 0.5 1\nKs 0.5 0.5 0.5\nKa 1 1 1\n";

TEST_F(MtlIllum, NoLightIsTheColorItself) {
  write("", "t.png");
  const MeshMaterial m = material(COLORS + "map_Kd t.png\nillum 0\n");
  EXPECT_EQ(m.emission, dvec3(0.25, 0.5, 1));
  EXPECT_EQ(m.emission_texture.file, folder_ / "t.png");
  for (const dvec3& other : {m.diffuse, m.specular, m.ambient}) EXPECT_EQ(other, dvec3(0));
  EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(MtlIllum, HighlightsAreThoseOfTwoAndMore) {
  EXPECT_EQ(material(COLORS + "illum 1\n").specular, dvec3(0));
  for (const char* illum : {"", "illum 2\n"}) {
    const MeshMaterial m = material(COLORS + illum);
    EXPECT_EQ(m.specular, dvec3(0.5)) << illum;
    EXPECT_EQ(m.reflection, 0) << illum;
    EXPECT_THAT(notes_, IsEmpty()) << illum;
  }
}

TEST_F(MtlIllum, MirrorsHaveTheWeightOfKs) {
  for (const char* illum : {"3", "4", "5"}) {
    const MeshMaterial m = material(COLORS + "illum " + illum + "\n");
    EXPECT_EQ(m.reflection, 0.5) << illum;
    EXPECT_EQ(m.refraction, 0) << illum;
    EXPECT_EQ(m.specular, dvec3(0.5)) << illum;
    EXPECT_EQ(notes_.empty(), illum[0] == '3') << illum;  // glass and Fresnel's law are told
  }
  EXPECT_EQ(material("Kd 0 0 0\nKs 2 2 2\nillum 3\n").reflection, 1);
  EXPECT_THAT(notes_, Contains(HasSubstr("above 1")));
  EXPECT_DOUBLE_EQ(material("Kd 0 0 0\nKs 0.9 0.6 0.3\nillum 3\n").reflection, 0.6);
  EXPECT_THAT(notes_, Contains(HasSubstr("colored Ks")));
}

// (1 - Ks) Tf; without Tf as clear as d says, and clear where nothing is said.
TEST_F(MtlIllum, GlassLetsThroughWhatItDoesNotMirror) {
  struct Case {
    const char* lines;
    double refraction;
  };
  for (const Case& c : {Case{"", 0.5},
                        {"Tf 1 1 1\n", 0.5},
                        {"Tf 0.5\n", 0.25},
                        {"Tf 0 0 0\n", 0},
                        {"d 0.25\n", 0.375},
                        {"Tr 0.75\n", 0.375},
                        {"d 1\n", 0},
                        {"d 1\nTf 1 1 1\n", 0.5}})
    for (const char* illum : {"illum 6\n", "illum 7\n"}) {
      const MeshMaterial m = material(COLORS + "Ni 1.25\n" + c.lines + illum);
      EXPECT_DOUBLE_EQ(m.refraction, c.refraction) << c.lines << illum;
      EXPECT_EQ(m.reflection, 0.5) << c.lines << illum;
      EXPECT_EQ(m.ior, 1.25) << c.lines << illum;
      EXPECT_EQ(c.refraction == 0, !notes_.empty() && notes_.back().find("it is opaque") != std::string::npos)
          << c.lines << illum;
    }
}

TEST_F(MtlIllum, WhatIsShownOtherwiseIsTold) {
  for (const char* lines :
       {"illum 8\n", "illum 9\n", "illum 10\n", "illum 11\n", "illum -1\n", "illum 1.5\n", "illum x\n", "d 0.5\n",
        "Tr 0.5\n", "Kd 255 0 0\n", "Kd 0 0 0\nmap_Kd t.png\n", "Ns -1\n", "Ns 2e6\n"}) {
    write("", "t.png");
    material(COLORS + lines);
    EXPECT_EQ(notes_.size(), 1u) << lines;
    EXPECT_THAT(notes_, Contains(HasSubstr("a.mtl: line "))) << lines;
  }
  material(COLORS + "d 1\nTr 0\nTf 1 1 1\nNi 1.45\nNs 250\nKe 0 0 0\n");
  EXPECT_THAT(notes_, IsEmpty());
}

}  // namespace
}  // namespace brume
