// Scenes for `brume check` with liquids, alone and among other media. Steps of about a voxel: the kernels find places
// within them by what bricks hold, the reference by what every border holds.
#include <iterator>

#include "check/check_parts.hpp"

namespace brume {

namespace {

constexpr SceneText SCENES[] = {
    {"liquid", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 36}, "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.2, 0.3],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]},
             {"type": "point", "position": [1.4, 1.2, 1.1], "intensity": [3, 4, 5]}],
  "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}},
  "shapes": [{"type": "sphere", "center": [0.3, 0.2, 0], "radius": 0.3, "material": "grey"}],
  "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [23, 20, 21], "radius": 0.8}, "sigma_a": [2, 1, 0.5],
             "albedo": [0.9, 0.8, 0.7], "specular": 0.5, "shininess": 30, "ambient": 1}],
  "render": {"step": 0.03}})"},
    // large enough for bricks of one value, turned, seen from inside
    {"liquid_inside", R"({
  "camera": {"eye": [0.1, 0.3, 0.2], "target": [-1, 0, -1], "vfov": 90}, "background": [0.2, 0.3, 0.5], "film": {"spp": 2},
  "lights": [{"type": "spot", "position": [-1.2, 1.4, -1], "direction": [1, -1, 0.7], "angle": 40, "intensity": 9}],
  "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [50, 60, 40], "radius": 0.9}, "sigma_a": [2, 1, 0.5],
             "transform": [{"scale": [1, 1.3, 0.8]}, {"rotate": [1, 2, 0, 30]}], "outside": 0.3, "inside": 0.9}],
  "render": {"step": 0.02}})"},
    {"liquid_f16", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 36}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]}],
  "media": [{"type": "liquid", "density": {"type": "perlin", "resolution": [23, 20, 21], "scale": 2, "seed": 3}, "sigma_a": 1,
             "outside": 0.45, "inside": 0.55, "specular": 1, "shininess": 20}],
  "render": {"step": 0.02, "storage": "f16"}})"},
    // primes above the number of steps: no border lies on the face of a brick, over which bytes make p jump
    {"liquid_u8", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 36}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]}],
  "media": [{"type": "liquid", "density": {"type": "perlin", "resolution": [61, 59, 67], "scale": 2, "seed": 3}, "sigma_a": 1,
             "outside": 0.45, "inside": 0.55, "specular": 1, "shininess": 20}],
  "render": {"step": 0.03, "storage": "u8"}})"},
    // on planes across a view that is wide enough for rays along them after a mirror
    {"liquid_slices", R"({
  "camera": {"eye": [1.2, 0.9, 2], "vfov": 70}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]}],
  "materials": {"mirror": {"diffuse": 0.1, "reflection": 0.8}},
  "shapes": [{"type": "sphere", "center": [0.2, -0.1, 0.3], "radius": 0.5, "material": "mirror"}],
  "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [23, 20, 21], "radius": 0.8}, "sigma_a": [2, 1, 0.5],
             "slices": 37}]})"},
    {"liquid_rim", R"({
  "camera": {"type": "orthographic", "eye": [1.5, 1.2, 3], "height": 2.5}, "background": [0.2, 0.3, 0.5], "ambient": 0.3,
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]}],
  "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [23, 20, 21], "radius": 0.8}, "sigma_a": [2, 1, 0.5],
             "grazing_correction": false, "ambient": [0.2, 0.3, 0.4]}],
  "render": {"step": 0.03}})"},
    // light at the faces of the box, behind which there is nothing
    {"liquid_box", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 40}, "background": [0.2, 0.3, 0.5], "film": {"spp": 2},
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]},
             {"type": "point", "position": [-0.3, 0.2, 0.1], "intensity": [1, 2, 1]}],
  "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}},
  "shapes": [{"type": "sphere", "center": [0.3, 0.2, 0], "radius": 0.3, "material": "grey"}],
  "media": [{"type": "liquid", "density": {"type": "linear", "resolution": [7, 9, 8]}, "sigma_a": [0.5, 1, 2],
             "bounds": [[-1, -0.6, -1], [1, 0.6, 1]], "transform": [{"rotate": [0, 1, 0.2, 25]}], "specular": 0.7}],
  "render": {"step": 0.04}})"},
    {"liquid_fog", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 40}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]}],
  "media": [{"density": {"type": "perlin", "resolution": [13, 12, 12], "scale": 2, "seed": 5}, "sigma_a": 0.2, "sigma_s": [2, 1, 0.5]},
            {"type": "liquid", "density": {"type": "ball", "resolution": [23, 20, 21], "radius": 0.7}, "sigma_a": [2, 1, 0.5]},
            {"bounds": [[-0.2, -0.5, -0.7], [1, 0.7, 0.5]], "density": {"type": "constant"}, "sigma_a": [0.1, 0.3, 0.6], "sigma_s": 0.4}],
  "render": {"step": 0.03}})"},
    // so many that they are walked side by side
    {"liquid_among", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 40}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]}],
  "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [23, 20, 21], "radius": 0.5}, "sigma_a": [2, 1, 0.5]},
            {"density": {"type": "perlin", "resolution": [13, 12, 12], "scale": 2, "seed": 5}, "sigma_a": 0.2, "sigma_s": [2, 1, 0.5]},
            {"density": {"type": "linear", "resolution": [9, 9, 9]}, "sigma_a": 0.3, "emission": [0.1, 0.2, 0.3]},
            {"type": "liquid", "density": {"type": "ball", "resolution": [40, 40, 40], "radius": 0.9, "ramp": 5}, "sigma_a": [0.1, 0.2, 0.3],
             "bounds": [[-0.2, -0.5, -0.7], [1, 0.7, 0.5]]}],
  "render": {"step": 0.03}})"},
    {"liquid_adaptive", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 40}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]}],
  "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [23, 20, 21], "radius": 0.6}, "sigma_a": [2, 1, 0.5]},
            {"density": {"type": "perlin", "resolution": [13, 12, 12], "scale": 2, "seed": 5}, "sigma_a": 0.2, "sigma_s": [2, 1, 0.5]}],
  "render": {"step": 0.03, "method": "adaptive", "tolerance": 0.000001}})"},
    {"liquid_tracked", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 40}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]}],
  "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [23, 20, 21], "radius": 0.7}, "sigma_a": [2, 1, 0.5]},
            {"density": {"type": "perlin", "resolution": [13, 12, 12], "scale": 2, "seed": 5}, "sigma_a": 0.2, "sigma_s": [2, 1, 0.5]}],
  "render": {"step": 0.03, "method": "ratio_tracking", "roulette": 0.2}})"},
    {"liquid_lights", R"({
  "camera": {"eye": [1.5, 1.2, 3], "vfov": 40}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.6], "irradiance": [6, 5, 4]},
             {"type": "point", "position": [1.4, 1.2, 1.1], "intensity": [3, 4, 5], "falloff": "none"},
             {"type": "spot", "position": [-1.2, 1.4, 1], "direction": [1, -1, -0.7], "angle": 40, "intensity": 9},
             {"type": "point", "position": [0.2, -1.3, 0.5], "intensity": [3, 1, 0]}],
  "media": [{"type": "liquid", "density": {"type": "ball", "resolution": [23, 20, 21], "radius": 0.7}, "sigma_a": [2, 1, 0.5],
             "specular": [1, 0.5, 0.2]}],
  "render": {"step": 0.03, "light_picks": 2}})"}};

}  // namespace

const std::vector<SceneText>& liquid_scenes() {
  static const std::vector<SceneText> scenes(std::begin(SCENES), std::end(SCENES));
  return scenes;
}

}  // namespace brume
