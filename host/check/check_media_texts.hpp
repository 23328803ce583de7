// Small scenes for `brume check`, each a picture of several things at once. Dense fields only, so that skipping empty
// bricks cannot hide a wrong cell; no horizon, where a plane's distance is worth nothing in single precision.
#pragma once
#include "check/check_parts.hpp"

namespace brume {

constexpr SceneText MEDIA_SCENES[] = {
    {"fog_nearest", R"({
  "camera": {"eye": [0.7, 0.9, 3.5], "target": [0, 0, 0], "vfov": 40},
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": [4, 4, 4]}],
  "media": [{"interpolation": "nearest", "density": {"type": "perlin", "resolution": [21, 17, 26], "scale": 3, "octaves": 3, "seed": 7},
             "sigma_a": 0.5, "sigma_s": 2, "phase": {"type": "henyey_greenstein", "g": -0.65}}]})"},
    {"fog_gauss2", R"({
  "camera": {"eye": [1.8, 0.8, 2.9], "target": [0, 0, 0], "vfov": 42}, "film": {"spp": 2}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "point", "position": [0.4, 0.6, 0.5], "intensity": [2, 1.5, 1]},
             {"type": "directional", "direction": [-0.4, -1, -0.6], "irradiance": [2, 2, 2]}],
  "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}},
  "shapes": [{"type": "sphere", "center": [-0.2, -0.1, 0], "radius": 0.4, "material": "grey"},
             {"type": "plane", "point": [0, -1.02, 0], "normal": [0, 1, 0], "material": "grey"}],
  "media": [{"density": {"type": "perlin", "resolution": [24, 24, 24], "scale": 3, "octaves": 2, "seed": 3},
             "sigma_a": [0.2, 0.5, 1], "sigma_s": [2, 1.5, 1], "phase": {"type": "henyey_greenstein", "g": 0.6}}]})"},
    {"fog_midpoint", R"({
  "camera": {"eye": [0.3, -0.2, 0.6], "target": [0, 0, -1], "vfov": 80},
  "lights": [{"type": "point", "position": [-0.3, 0.5, -0.5], "intensity": [1, 1, 1]}],
  "media": [{"density": {"type": "exponential", "resolution": [9, 40, 9]}, "sigma_a": 0.5, "sigma_s": 1.5}],
  "render": {"method": "dda_midpoint"}})"},
    {"fog_march", R"({
  "camera": {"eye": [2.2, 1.2, 2.4], "target": [0, 0, 0], "vfov": 45},
  "lights": [{"type": "spot", "position": [-1.5, 1.8, 1], "direction": [1.2, -1.5, -0.9], "angle": 25, "softness": 0.4, "intensity": [20, 20, 16]}],
  "media": [{"bounds": [[-1, -0.5, -1], [1, 0.5, 1]], "transform": [{"scale": [1, 1.5, 1]}, {"rotate": [0.2, 1, 0, 30]}],
             "density": {"type": "linear", "resolution": [16, 16, 16]}, "sigma_a": 0.1, "sigma_s": 1}],
  "render": {"method": "march_midpoint", "step": 0.037}})"},
    {"fog_homogeneous", R"({
  "camera": {"eye": [0.5, 1, 3.2], "target": [0, 0, 0], "vfov": 40}, "background": [0.05, 0.05, 0.1],
  "lights": [{"type": "directional", "direction": [1, -1, 0.2], "irradiance": [3, 3, 3]},
             {"type": "point", "position": [0.2, 0.1, 0.3], "intensity": [0.5, 0.4, 0.3]}],
  "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}},
  "shapes": [{"type": "box", "min": [-0.3, -1.2, -0.3], "max": [0.3, -0.2, 0.3], "transform": [{"rotate": [0, 1, 0, 20]}], "material": "grey"}],
  "media": [{"density": {"type": "sphere", "of": {"type": "constant", "value": 0.75}}, "sigma_a": 0.3, "sigma_s": 1}],
  "render": {"method": "homogeneous"}})"},
    {"fog_sphere_ortho", R"({
  "camera": {"type": "orthographic", "eye": [0, 0.5, 4], "target": [0, 0, 0], "height": 2.4}, "film": {"spp": 3},
  "lights": [{"type": "directional", "direction": [0.3, -1, -0.2], "irradiance": [3, 2.5, 2]}],
  "media": [{"transform": [{"rotate": [0, 0, 1, 40]}, {"scale": 0.9}],
             "density": {"type": "sphere", "of": {"type": "perlin", "resolution": [40, 40, 40], "scale": 5, "octaves": 3, "seed": 11}},
             "sigma_a": 0.4, "sigma_s": 4, "phase": {"type": "henyey_greenstein", "g": 0.3}}]})"},
    {"fog_two", R"({
  "camera": {"eye": [1.4, 1, 3], "target": [0, 0, 0], "vfov": 45}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [-1, -1, -0.4], "irradiance": [3, 3, 3]}],
  "media": [{"bounds": [[-1, -0.6, -0.6], [0.3, 0.6, 0.6]], "density": {"type": "perlin", "resolution": [13, 12, 12], "scale": 2, "seed": 5},
             "sigma_a": 0.2, "sigma_s": [2, 1, 0.5]},
            {"bounds": [[-0.2, -0.5, -0.7], [1, 0.7, 0.5]], "density": {"type": "constant"}, "sigma_a": [0.1, 0.3, 0.6], "sigma_s": 0.4}]})"},
    {"fog_on_one_spot", R"({
  "camera": {"eye": [1.7, 1.2, 2.9], "target": [0, 0, 0], "vfov": 40}, "film": {"spp": 1}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": 3},
             {"type": "point", "position": [0.3, 0.4, 0.2], "intensity": 1}],
  "media": [{"density": {"type": "perlin", "resolution": [5, 6, 5], "scale": 2, "seed": 1}, "sigma_a": [0.1, 0.2, 0.4], "sigma_s": 0.7},
            {"density": {"type": "perlin", "resolution": [6, 5, 6], "scale": 2, "seed": 2}, "transform": [{"rotate": [0, 1, 0.3, 35]}],
             "sigma_a": 0.1, "sigma_s": 1}]})"},
    {"fog_grid", R"({
  "camera": {"eye": [1.9, 1.1, 2.6], "target": [0, 0, 0], "vfov": 40}, "background": [0.1, 0.1, 0.2],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": [3, 3, 3]},
             {"type": "point", "position": [0.5, 0.9, 0.4], "intensity": [1, 0.8, 0.6]}],
  "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}},
  "shapes": [{"type": "sphere", "center": [0.1, 0.6, 0.2], "radius": 0.15, "material": "grey"}],
  "media": [{"bounds": [[-1, -0.5, -1], [1, 0.5, 1]], "transform": [{"rotate": [0, 1, 0.2, 25]}], "sigma_a": 0.3, "sigma_s": 3,
             "density": {"type": "perlin", "resolution": [20, 11, 18], "scale": 3, "octaves": 2, "seed": 4}}],
  "render": {"method": "dda_midpoint", "shadow": "grid", "light_grid": 12}})"},
    {"fog_grid_color", R"({
  "camera": {"eye": [1.2, 0.7, 2.9], "target": [0, 0, 0], "vfov": 40},
  "lights": [{"type": "directional", "direction": [0.5, -1, -0.3], "irradiance": [3, 3, 3]}],
  "media": [{"density": {"type": "linear", "resolution": [6, 9, 7]}, "sigma_a": [0.2, 0.5, 1], "sigma_s": [2, 1.5, 1]},
            {"bounds": [[-0.4, -0.2, -0.4], [0.4, 1.1, 0.4]], "density": {"type": "exponential", "resolution": [6, 9, 7]},
             "sigma_a": 0.5, "sigma_s": 0.5}],
  "render": {"method": "march_regular", "step": 0.06, "shadow": "grid", "light_grid": 7}})"},
    {"fog_glow", R"({
  "camera": {"eye": [-1.1, 0.9, 2.9], "target": [0, 0, 0], "vfov": 40}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [0.5, -1, -0.3], "irradiance": [1, 1, 1]}],
  "media": [{"density": {"type": "linear", "resolution": [8, 8, 8]}, "sigma_a": 0.7, "sigma_s": 0.4, "emission": [0.9, 0.4, 0.1],
             "emission_density": {"type": "perlin", "resolution": [14, 14, 14], "scale": 3, "seed": 2}},
            {"bounds": [[0.5, -0.3, -0.4], [1.5, 0.3, 0.4]], "density": {"type": "constant"}, "sigma_a": 0.4, "emission": [0, 0.1, 0.3]}]})"},
    {"fog_rectangle", R"({
  "camera": {"eye": [1.1, 0.9, 2.9], "target": [0, 0, 0], "vfov": 40}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [0.5, -1, -0.3], "irradiance": [1, 1, 1]}],
  "media": [{"density": {"type": "linear", "resolution": [8, 8, 8]}, "sigma_a": [0.7, 0.6, 0.5], "sigma_s": 2}],
  "render": {"method": "march_midpoint", "step": 0.03, "in_scattering": "rectangle"}})"},
    {"fog_f16", R"({
  "camera": {"eye": [1.1, 0.9, 2.9], "target": [0, 0, 0], "vfov": 40}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [0.5, -1, -0.3], "irradiance": [1, 1, 1]}],
  "media": [{"density": {"type": "perlin", "resolution": [19, 18, 17], "scale": 3}, "sigma_a": 0.6, "sigma_s": 2}],
  "render": {"storage": "f16"}})"},
    {"fog_u8", R"({
  "camera": {"eye": [1.1, 0.9, 2.9], "target": [0, 0, 0], "vfov": 40}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [0.5, -1, -0.3], "irradiance": [1, 1, 1]}],
  "media": [{"density": {"type": "perlin", "resolution": [19, 18, 17], "scale": 3}, "sigma_a": 0.6, "sigma_s": 2},
            {"bounds": [[-0.4, -0.2, -0.4], [0.4, 1.1, 0.4]], "density": {"type": "linear", "resolution": [11, 11, 11]}, "sigma_a": 0.6}],
  "render": {"storage": "u8", "method": "dda_midpoint"}})"},
    {"fog_u8_march", R"({
  "camera": {"eye": [1.1, 0.9, 2.9], "target": [0, 0, 0], "vfov": 40}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [1, -0.2, 1], "irradiance": [1, 1, 1]}],
  "media": [{"density": {"type": "sphere", "of": {"type": "perlin", "resolution": [29, 28, 27], "scale": 3}}, "sigma_a": 0.6, "sigma_s": 2}],
  "render": {"storage": "u8", "method": "march_midpoint", "shadow": "grid", "light_grid": 16}})"},
    {"fog_jitter", R"({
  "camera": {"eye": [1.8, 0.8, 2.9], "target": [0, 0, 0], "vfov": 42}, "film": {"spp": 2}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "point", "position": [0.4, 0.6, 0.5], "intensity": [2, 1.5, 1]},
             {"type": "directional", "direction": [-0.4, -1, -0.6], "irradiance": [2, 2, 2]}],
  "materials": {"mirror": {"diffuse": [0.6, 0.6, 0.6], "reflection": 0.4}},
  "shapes": [{"type": "sphere", "center": [-0.2, -0.1, 0], "radius": 0.4, "material": "mirror"}],
  "media": [{"density": {"type": "perlin", "resolution": [20, 20, 20], "scale": 3, "octaves": 2, "seed": 3}, "sigma_a": 0.3, "sigma_s": 2}],
  "render": {"method": "march_regular_jitter", "step": 0.11}})"},
    {"fog_jitter_middle", R"({
  "camera": {"eye": [0.7, 0.9, 3.5], "target": [0, 0, 0], "vfov": 40},
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": [4, 4, 4]}],
  "media": [{"density": {"type": "perlin", "resolution": [21, 17, 26], "scale": 3, "octaves": 3, "seed": 7},
             "sigma_a": 0.5, "sigma_s": [2, 1, 0.5]}],
  "render": {"method": "march_midpoint_jitter", "step": 0.07, "roulette": 0.3}})"},
    {"fog_delta", R"({
  "camera": {"eye": [1.2, 0.8, 3.2], "target": [0, 0, 0], "vfov": 40}, "film": {"spp": 2}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.4, -1, -0.6], "irradiance": [2, 2, 2]}],
  "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}},
  "shapes": [{"type": "sphere", "center": [-0.2, -0.1, 0], "radius": 0.4, "material": "grey"}],
  "media": [{"density": {"type": "perlin", "resolution": [20, 20, 20], "scale": 3, "octaves": 2, "seed": 3}, "sigma_a": [0.3, 0.6, 0.1], "sigma_s": 2}],
  "render": {"method": "delta_tracking"}})"},
    {"fog_ratio", R"({
  "camera": {"eye": [1.2, 0.8, 3.2], "target": [0, 0, 0], "vfov": 40}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "directional", "direction": [-0.4, -1, -0.6], "irradiance": [2, 2, 2]}],
  "media": [{"density": {"type": "sphere", "of": {"type": "perlin", "resolution": [20, 20, 20], "scale": 3, "seed": 3}}, "sigma_a": [0.3, 0.6, 0.1], "sigma_s": 4},
            {"bounds": [[-0.2, -0.5, -0.7], [1, 0.7, 0.5]], "density": {"type": "linear", "resolution": [9, 9, 9]}, "sigma_a": 0, "emission": [0.1, 0.3, 0.6]}],
  "render": {"method": "ratio_tracking", "roulette": 0.2}})"},
    {"fog_residual", R"({
  "camera": {"eye": [0.7, 0.9, 3.5], "target": [0, 0, 0], "vfov": 40}, "background": [0.2, 0.3, 0.5],
  "lights": [{"type": "point", "position": [0.4, 1.6, 0.5], "intensity": [2, 1.5, 1]}],
  "media": [{"density": {"type": "linear", "resolution": [20, 24, 20]}, "sigma_a": 0.3, "sigma_s": 3}],
  "render": {"method": "residual_ratio"}})"},
    {"lights_chosen", R"({
  "camera": {"eye": [1.2, 0.9, 3.4], "target": [0, 0, 0], "vfov": 40}, "background": [0.1, 0.1, 0.2],
  "lights": [{"type": "point", "position": [0.9, 0.8, 0.4], "intensity": [2, 1, 1]},
             {"type": "point", "position": [-0.9, 0.7, 0.8], "intensity": [1, 2, 1]},
             {"type": "point", "position": [0.2, 1.6, -0.6], "intensity": [1, 1, 3]},
             {"type": "spot", "position": [1, 2, 1], "direction": [-0.5, -1, -0.5], "angle": 30, "intensity": [6, 6, 5]},
             {"type": "directional", "direction": [0.3, -1, -0.4], "irradiance": [1, 1, 1]}],
  "materials": {"mirror": {"diffuse": [0.6, 0.5, 0.6], "reflection": 0.4}},
  "shapes": [{"type": "sphere", "center": [-0.3, -0.2, 0], "radius": 0.5, "material": "mirror"},
             {"type": "quad", "corner": [-2, -0.8, -2], "u": [0, 0, 4], "v": [4, 0, 0], "material": "mirror"}],
  "media": [{"density": {"type": "perlin", "resolution": [12, 11, 12], "scale": 3}, "sigma_a": 0.2, "sigma_s": 1.5}],
  "render": {"light_picks": 2, "max_depth": 2}})"},
    {"adaptive_media", R"({
  "camera": {"eye": [1.4, 1, 3], "target": [0, 0, 0], "vfov": 45}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [-1, -1, -0.4], "irradiance": [3, 3, 3]},
             {"type": "spot", "position": [0.3, 1.8, 1], "direction": [-0.3, -1.6, -0.9], "angle": 20, "intensity": [9, 9, 7]}],
  "shapes": [{"type": "sphere", "center": [-0.2, 0.4, 0.4], "radius": 0.25}],
  "media": [{"bounds": [[-1, -0.6, -0.6], [0.3, 0.6, 0.6]], "transform": [{"rotate": [0, 1, 0.3, 20]}],
             "density": {"type": "perlin", "resolution": [33, 32, 30], "scale": 3, "seed": 5}, "sigma_a": 0.2, "sigma_s": [2, 1, 0.5]},
            {"bounds": [[-0.2, -0.5, -0.7], [1, 0.7, 0.5]], "density": {"type": "constant"}, "sigma_a": [0.1, 0.3, 0.6], "sigma_s": 0.4},
            {"bounds": [[-1, -0.9, -0.8], [1, 0, 0.8]], "density": {"type": "exponential", "resolution": [9, 40, 9]}, "sigma_s": 1.5, "method": "march_midpoint"}],
  "render": {"method": "adaptive", "tolerance": 0.003}})"},
    {"adaptive_faint", R"({
  "camera": {"eye": [1.4, 1, 3], "target": [0, 0, 0], "vfov": 45}, "background": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [-1, -1, -0.4], "irradiance": 3}, {"type": "point", "position": [1.2, 0.9, 0.4], "intensity": 2},
             {"type": "point", "position": [-1.3, 0.4, 0.7], "intensity": 0.00024}, {"type": "point", "position": [0.2, -1.4, 0.9], "intensity": 0.00008}],
  "materials": {"ember": {"emission": [0.001, 0.0005, 0.0002]}},
  "shapes": [{"type": "sphere", "center": [-0.2, 0.9, 0.4], "radius": 0.25, "material": "ember"}],
  "media": [{"bounds": [[-1, -0.6, -0.6], [0.3, 0.6, 0.6]], "density": {"type": "perlin", "resolution": [33, 32, 30], "scale": 3, "seed": 5},
             "sigma_a": 0.2, "sigma_s": [2, 1, 0.5]},
            {"bounds": [[-0.2, -0.5, -0.7], [1, 0.7, 0.5]], "density": {"type": "constant"}, "sigma_a": [0.1, 0.3, 0.6], "sigma_s": 0.4}],
  "render": {"method": "adaptive", "tolerance": 0.0002}})"},
    {"adaptive_grid", R"({
  "camera": {"eye": [1.9, 1.1, 2.6], "target": [0, 0, 0], "vfov": 40}, "background": [0.1, 0.1, 0.2],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": 3}, {"type": "point", "position": [0.5, 0.9, 0.4]}],
  "media": [{"transform": [{"scale": [1, 0.5, 1]}, {"rotate": [0, 1, 0.2, 25]}], "sigma_a": 0.3, "sigma_s": 3,
             "density": {"type": "perlin", "resolution": [40, 21, 38], "scale": 3, "octaves": 2, "seed": 4}}],
  "render": {"method": "adaptive", "tolerance": 0.01, "shadow": "grid", "light_grid": 12, "storage": "u8"}})"},
    {"adaptive_chosen", R"({
  "camera": {"eye": [0.7, 0.9, 3.5], "target": [0, 0, 0], "vfov": 40},
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": 4}, {"type": "point", "position": [0.2, 1.6, -0.6]}],
  "media": [{"density": {"type": "sphere", "of": {"type": "perlin", "resolution": [21, 17, 26], "scale": 3, "octaves": 3, "seed": 7}},
             "sigma_a": 0.5, "sigma_s": 9}],
  "render": {"method": "adaptive", "tolerance": 0.0002, "light_picks": 1, "roulette": 0.3}})"},
};

}  // namespace brume
