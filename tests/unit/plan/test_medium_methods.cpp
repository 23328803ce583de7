// Which method and step each medium gets: of the picture, of its own, or the exact one; and what is refused.
#include <gmock/gmock.h>

#include "base/error.hpp"
#include "plan/planned_scene.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A ramp of voxels and an ellipsoid of even fog with nearest voxels, each with more keys.
PlannedScene flat(const std::string& ramp, const std::string& fog, const std::string& render) {
  const std::string text = R"({"media": [
    {"density": {"type": "linear", "resolution": [8, 8, 8]}, "sigma_a": 1)" +
                           ramp + R"(},
    {"interpolation": "nearest", "density": {"type": "constant", "resolution": [4, 4, 4]}, "sigma_a": 1)" +
                           fog + R"(}], "render": {)" + render + "}}";
  return flatten(scene_read_text(text, "a.json", {}), {});
}

std::vector<int> methods(const PlannedScene& scene) {
  std::vector<int> all;
  for (const MediumWalk& walk : scene.walks) all.push_back(walk.method);
  return all;
}

std::string refusal(const std::string& ramp, const std::string& fog, const std::string& render) {
  try {
    flat(ramp, fog, render);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MediumMethods, ThatOfThePictureHoldsWhereItFits) {
  const PlannedScene scene = flat("", "", R"("method": "dda_midpoint")");
  EXPECT_THAT(methods(scene), ElementsAre(METHOD_DDA_MIDPOINT, METHOD_HOMOGENEOUS));
  EXPECT_THAT(scene.all_notes(),
              ElementsAre("/render/method: 'dda_midpoint' does not fit all media: /media/1 takes homogeneous"));
  const PlannedScene even = flat("", "", R"("method": "homogeneous")");
  EXPECT_THAT(methods(even), ElementsAre(METHOD_DDA_GAUSS2, METHOD_HOMOGENEOUS));
  EXPECT_THAT(even.all_notes(), ElementsAre(HasSubstr("/media/0 takes dda_gauss2")));
}

TEST(MediumMethods, NothingIsToldWhereItFitsAll) {
  EXPECT_THAT(flat("", "", R"("method": "march_midpoint")").all_notes(), ElementsAre());
  EXPECT_THAT(flat("", "", R"("method": "auto")").all_notes(), ElementsAre());
}

TEST(MediumMethods, OneOfItsOwnComesFirst) {
  const PlannedScene scene = flat(R"(, "method": "march_midpoint", "step": 0.25)", R"(, "method": "auto")",
                                  R"("method": "dda_nearest", "step": 0.125)");
  EXPECT_THAT(methods(scene), ElementsAre(METHOD_MARCH_MIDPOINT, METHOD_HOMOGENEOUS));
  EXPECT_THAT(scene.all_notes(), ElementsAre());
  EXPECT_FLOAT_EQ(scene.walks[0].step, 2 * scene.walks[1].step);  // both are 2 long
}

TEST(MediumMethods, ThatFitNothingAreRefused) {
  EXPECT_THAT(
      refusal("", R"(, "method": "dda_gauss2")", ""),
      HasSubstr("a.json: /media/1/method: 'dda_gauss2' does not fit the nearest density 'constant' of /media/1; "
                "these do: auto, dda_nearest"));
  EXPECT_THAT(refusal("", R"(, "method": "magic")", ""),
              HasSubstr("/media/1/method: unknown method 'magic'; known: auto"));
  EXPECT_THAT(refusal("", R"(, "step": 0)", ""), HasSubstr("/media/1/step: "));
  EXPECT_THAT(refusal(R"(, "method": "march_midpoint", "step": 1e-5, "sigma_s": 1)", "",
                      R"("shadow": "trace"}, "lights": [{"type": "directional", "direction": [0, -1, 0]}],
                         "film": {"size": [4096, 4096], "spp": 100)"),
              HasSubstr("a.json: /media/0/step: 1e-05 asks for"));
}

// A glow of its own takes the method of its medium where that fits.
TEST(MediumMethods, AGlowTakesThatOfItsMediumOrIsExact) {
  const std::string glow = R"(, "emission": 1, "emission_density": {"type": "linear", "resolution": [8, 8, 8]})";
  EXPECT_THAT(methods(flat("", glow + R"(, "method": "march_midpoint")", "")),
              ElementsAre(METHOD_DDA_GAUSS2, METHOD_MARCH_MIDPOINT, METHOD_MARCH_MIDPOINT));
  EXPECT_THAT(methods(flat("", glow + R"(, "method": "homogeneous")", "")),
              ElementsAre(METHOD_DDA_GAUSS2, METHOD_DDA_NEAREST, METHOD_HOMOGENEOUS));
}

TEST(MediumMethods, LightGridsAreForWhatScatters) {
  EXPECT_THAT(refusal("", "", R"("shadow": "grid")"),
              HasSubstr("a.json: /render/shadow: 'grid' does not fit /media/0, nor any other medium: sigma_s is 0"));
  EXPECT_EQ(refusal(R"(, "sigma_s": 1)", "", R"("shadow": "grid")"), "no error");
}

}  // namespace
}  // namespace brume
