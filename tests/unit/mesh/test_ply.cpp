// PLY files: the three formats hold the same mesh; what is cut, or promises more than it holds.
#include <chrono>

#include "unit/mesh/foreign_fixture.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;

class Ply : public Foreign {};

TEST_F(Ply, ThreeFormatsAreOneMesh) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const Mesh mesh = read_file("a.ply", ply_text(format));
    ASSERT_EQ(mesh.positions.size(), 5u) << format;  // shared by the faces, whose normals they smooth
    ASSERT_EQ(mesh.triangles.size(), 4u) << format;  // the square is two
    EXPECT_TRUE(mesh.materials.empty());
    EXPECT_TRUE(mesh.notes.empty());
    double area = 0, highest = 0;
    for (const MeshTriangle& t : mesh.triangles) {
      const auto at = [&](int k) { return mesh.positions[std::size_t(t.position[std::size_t(k)])]; };
      const glm::dvec3 a = at(1) - at(0), b = at(2) - at(0);
      const glm::dvec3 c{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
      area += std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z) / 2;
      for (int k = 0; k < 3; ++k) highest = std::max(highest, at(k).z);
      EXPECT_EQ(t.normal[0], -1);
      EXPECT_EQ(t.group, GROUP_ALL);
    }
    EXPECT_NEAR(area, 1 + 2 * std::sqrt(4.25) / 2, 1e-12) << format;
    EXPECT_EQ(highest, 2) << format;
  }
}

TEST_F(Ply, CutFilesAreRefused) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string text = ply_text(format);
    const std::size_t begin = text.find("end_header\n") + 11;
    const std::size_t step = std::string(format) == "ascii" ? text.size() - begin - 20 : 1;
    for (std::size_t size = begin; size < text.size() - 10; size += step)
      EXPECT_THAT(refusal_of("a.ply", text.substr(0, size)), HasSubstr("but the file ends before")) << format << size;
    EXPECT_THAT(refusal_of("a.ply", text.substr(0, begin - 5)), HasSubstr("header does not end")) << format;
  }
}

TEST_F(Ply, PromisesAreHeldAgainstTheSizeAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const char* count : {"4000000000", "18446744073709551615", "-1", "6000"})
      EXPECT_THAT(refusal_of("a.ply", ply_text(format, count)), HasSubstr("but the file ends before")) << count;
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2);
}

TEST_F(Ply, WhatIsNoMeshIsRefused) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = ply_text("ascii");
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal_of("a.ply", ""), HasSubstr("is no PLY file"));
  EXPECT_THAT(refusal_of("a.ply", "solid"), HasSubstr("is no PLY file"));
  EXPECT_THAT(refusal_of("a.ply", changed("1 2 4\n", "1 2 5\n")), HasSubstr("names vertex 5 of 5"));
  EXPECT_THAT(refusal_of("a.ply", changed("1 2 4\n", "1 -2 4\n")), HasSubstr("names vertex"));
  EXPECT_THAT(refusal_of("a.ply", changed("0.500000", "nan")), HasSubstr("vertex 4 is no number up to 1e38"));
  EXPECT_THAT(refusal_of("a.ply", changed("property float x", "property quad x")), HasSubstr("of type 'quad'"));
  EXPECT_THAT(refusal_of("a.ply", changed("element vertex 5", "element vertex")), HasSubstr("without a number"));
  EXPECT_THAT(refusal_of("none.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n"),
              testing::Not("accepted"));
}

}  // namespace
}  // namespace brume::test
