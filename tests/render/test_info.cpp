// brume info of a scene: which parts of the kernels it needs, and which it was spared.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace brume::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

class Info : public Program {
 protected:
  nlohmann::json kernels(const std::string& scene) const {
    write("a.json", scene);
    const Outcome r = run("info a.json --json");
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return nlohmann::json::parse(r.out)["kernels"];
  }
};

TEST_F(Info, SaysWhatKernelsNeedAndWhatIsLeftOut) {
  const nlohmann::json fog = kernels(R"({
    "lights": [{"type": "directional", "direction": [0, -1, 0], "irradiance": 1}],
    "materials": {"mirror": {"reflection": 0.5}},
    "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.4, "material": "mirror"}],
    "media": [{"density": {"type": "constant"}, "sigma_a": [1, 2, 3], "sigma_s": 1}]})");
  const Words needs = fog["needs"], left_out = fog["left_out"];
  for (const char* word : {"media: one", "an optical depth for each channel", "methods: homogeneous",
                           "phase functions: isotropic", "shapes: sphere", "lights: directional", "mirrors and glass"})
    EXPECT_THAT(needs, Contains(word));
  for (const char* word :
       {"media: several", "shapes: cylinder, plane, quad, box, isosurface", "lights: point, spot", "triangles",
        "textures", "light grids", "random collisions", "phase functions: henyey_greenstein"})
    EXPECT_THAT(left_out, Contains(word));
  for (const std::string& word : needs) EXPECT_THAT(left_out, Not(Contains(word)));
  EXPECT_THAT(fog["options"].get<std::string>(), HasSubstr("-DBRUME_MEDIA=1 -DBRUME_COLOR_TAU=1 "));
}

TEST_F(Info, OfAnEmptySceneEverythingIsLeftOut) {
  const nlohmann::json empty = kernels("{}");
  EXPECT_EQ(empty["needs"], nlohmann::json::array());
  EXPECT_THAT(Words(empty["left_out"]), Contains("media"));
  EXPECT_THAT(run("info a.json").out, HasSubstr("\n  left_out:\n    - media\n"));
}

}  // namespace
}  // namespace brume::test
