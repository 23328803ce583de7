// What the OBJ reader refuses, with which file, line and cause; and what only looks as if it were to be refused.
#include "unit/mesh/obj_fixture.hpp"

namespace brume {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(Obj, RefusesWhatIsNoMesh) {
  EXPECT_THAT(refusal(""), HasSubstr("no triangle"));
  EXPECT_THAT(refusal(TRIANGLE), HasSubstr("no triangle"));
  EXPECT_THAT(refusal(std::string("v 0\0 0", 6)), HasSubstr("not a plain text file"));
  for (const fs::path& file : {folder_ / "none.obj", folder_}) {
    try {
      mesh_read_obj(file);
      FAIL() << "accepted " << file;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(file.string() + ": "));
      EXPECT_THAT(error.what(), HasSubstr(file == folder_ ? "is a folder" : "cannot be opened"));
    }
  }
}

TEST_F(Obj, RefusesIndicesOutOfRange) {
  const std::string start = std::string(TRIANGLE) + "v 1 1 0\nv 2 2 0\nvt 0 0\nvt 1 0\nvn 0 0 1\nf 1 2 3\n";
  for (const char* face : {"1 2 6", "1 2 -6", "1 2 2147483647", "6 2 3 4", "1 2 4 -6", "1 2 4 3 6", "-7 1 2 4 3"})
    EXPECT_THAT(refusal(start + "f " + face + "\n"), AllOf(HasSubstr("vertex"), HasSubstr("5"))) << face;
  for (const char* face : {"1/1 2/2 3/3", "1/1 2/2 3/-3", "1/1 2/2 3/-4", "1/1 2/2 4/3 3/1"})
    EXPECT_THAT(refusal(start + "f " + face + "\n"), AllOf(HasSubstr("texture coordinate"), HasSubstr("2"))) << face;
  for (const char* face : {"1//1 2//1 3//2", "1//1 2//1 3//-2", "1//1 2//1 4//1 3//9"})
    EXPECT_THAT(refusal(start + "f " + face + "\n"), AllOf(HasSubstr("normal"), HasSubstr("1"))) << face;
  for (const char* face :
       {"0 1 2", "1/0 2/1 3/1", "1//0 2//1 3//1", "1 2 3x", "1 2 x", "1 2 3 1e5", "1 2 3.5", "1/ 2/ 3/"})
    EXPECT_THAT(refusal(start + "f " + face + "\n"), HasSubstr("line 10")) << face;
}

// An index may name a vertex that stands further down.
TEST_F(Obj, FacesMayStandBeforeTheirVertices) {
  EXPECT_EQ(read(std::string("f 1 2 3\n") + TRIANGLE).triangles.size(), 1u);
}

TEST_F(Obj, RefusesWhatIsNoNumber) {
  const std::string face = "f 1 2 3\n";
  for (const char* v : {"nan 0 0", "0 -nan 0", "0 0 inf", "0 0 -inf", "0 0 Infinity", "x 0 0", "0 0x10 0", "0 1-2 0",
                        "0 . 0", "0 e 0", "0 1e 0", "0 --1 0", "0 1.2.3 0"})
    EXPECT_THAT(refusal(std::string(TRIANGLE) + "v " + v + "\n" + face),
                AllOf(HasSubstr("line 4"), HasSubstr("number")))
        << v;
  EXPECT_THAT(refusal(std::string(TRIANGLE) + "v 0 1e300 0\n" + face), HasSubstr("vertex 4 is not finite"));
  EXPECT_THAT(refusal(std::string(TRIANGLE) + "vn nan 0 0\n" + face), AllOf(HasSubstr("line 4"), HasSubstr("'nan'")));
  EXPECT_THAT(refusal(std::string(TRIANGLE) + "vt 0 nan\n" + face), AllOf(HasSubstr("line 4"), HasSubstr("'nan'")));
}

TEST_F(Obj, RefusesTooFewNumbers) {
  for (const char* line : {"v", "v 1", "v 1 2", "vn 1 0", "vt"})
    EXPECT_THAT(refusal(std::string(TRIANGLE) + line + "\nf 1 2 3\n"), AllOf(HasSubstr("line 4"), HasSubstr("number")))
        << line;
  EXPECT_EQ(read(std::string(TRIANGLE) + "vt 0.5\nvt 1 1 0\nv 1 1 0 1.0\nv 1 2 0 0.5 0.5 0.5\nf 1 2 3\n").uvs.size(),
            2u);
}

TEST_F(Obj, LinesAreCountedAsTheFileHasThem) {
  EXPECT_THAT(refusal("v 0 \\\n0 0\nv 1 0 0\r\nv 0 1 0\rv x 0 0\nf 1 2 3\n"), HasSubstr("line 5: 'x'"));
}

TEST_F(Obj, CommentsMayStandBehindVerticesAndFaces) {
  EXPECT_EQ(read("v 0 0 0 # a\nv 1 0 0#b\nv 0 1 0\nvn 0 0 1 # nan\nf 1 2 3 # last\n").triangles.size(), 1u);
}

}  // namespace
}  // namespace brume
