// What brume notes without failing: on the terminal, in the statistics, and with --strict in the exit code.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "image/image.hpp"
#include "program.hpp"

namespace brume::test {
namespace {

using testing::HasSubstr;
using Strict = Program;

constexpr const char* DAZZLED = R"({"film": {"size": [9, 7], "spp": 2}, "camera": {"eye": [0, 0, 3]},
  "lights": [{"type": "point", "position": [0, 0, 0.001], "intensity": 3e38}],
  "shapes": [{"type": "quad", "corner": [-0.5, -0.5, 0]}]})";

TEST_F(Strict, SamplesThatAreNoNumberAreToldAndCounted) {
  write("a.json", DAZZLED);
  const Outcome r = run("render a.json -o a.exr --stats s.json");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("brume: note: "));
  EXPECT_THAT(r.err,
              HasSubstr(" of 126 samples are no number or brighter than 3e+32 and left out, the first at pixel 3,1"));
  EXPECT_GT(nlohmann::json::parse(text(folder_ / "s.json"))["invalid_samples"], 0);
  for (const float value : image_read(folder_ / "a.exr").values) EXPECT_TRUE(std::isfinite(value));
}

TEST_F(Strict, EndsWith1AfterWriting) {
  write("a.json", DAZZLED);
  write("fine.json", R"({"film": {"size": [9, 7]}})");
  EXPECT_EQ(run("render a.json -o a.exr --strict --quiet").exit_code, 1);
  EXPECT_TRUE(fs::exists(folder_ / "a.exr"));
  EXPECT_EQ(run("render fine.json -o fine.exr --strict").exit_code, 0);
}

TEST_F(Strict, HoldsForEveryNote) {
  write("sliver.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n");  // the first face has no area
  write("a.json", R"({"film": {"size": [9, 7]}, "shapes": [{"type": "mesh", "file": "sliver.obj"}]})");
  const Outcome lax = run("render a.json -o a.exr");
  EXPECT_EQ(lax.exit_code, 0) << lax.err;
  EXPECT_THAT(lax.err, HasSubstr("brume: note: "));
  EXPECT_EQ(run("render a.json -o a.exr --strict").exit_code, 1);
}

TEST_F(Strict, RadiancesThatNoSumHoldsAreRefused) {
  for (const char* key : {R"("background": 3e38)", R"("materials": {"a": {"emission": [0, 1e33, 0]}})"}) {
    write("a.json", "{" + std::string(key) + "}");
    expect_refused("render a.json -o a.exr", 2, ": expected a number in [0, 3e+32], got ");
  }
}

}  // namespace
}  // namespace brume::test
