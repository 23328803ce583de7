// A scene text with every key in it, and the reading of texts; shared by the tests of reader and writer.
#pragma once
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/scene_reader.hpp"

namespace brume {

// Every key of the language, away from its default where it can be.
inline const char* const SCENE_FULL = R"({
  "camera": {"type": "orthographic", "eye": [1, 2, 3], "target": [0.5, 0, 0], "up": [0, 0, 1], "height": 3.5},
  "film": {"size": [320, 200], "spp": 9, "exposure": -1.5, "transfer": "srgb"},
  "background": [0.1, 0.2, 0.3], "ambient": [0.4, 0.5, 0.6],
  "lights": [
    {"type": "point", "position": [1, 2, 3], "intensity": [4, 5, 6], "falloff": "none"},
    {"type": "directional", "direction": [1, -1, 0], "irradiance": [7, 8, 9]},
    {"type": "spot", "position": [3, 2, 1], "direction": [0, -1, 0.5], "intensity": [1, 2, 3],
     "falloff": "inverse_square", "angle": 20, "softness": 0.25}],
  "materials": {
    "a [1, 2]": {"model": "phong", "ambient": [0.1, 0.2, 0.3], "diffuse": [0.4, 0.5, 0.6], "specular": [0.7, 0.8, 0.9],
      "shininess": 12, "reflection": 0, "refraction": 0, "ior": 1.25, "fresnel": true, "absorption": [0.5, 0.25, 2], "emission": [1, 2, 3], "light": false, "texture": "maps/wood [1, 2].png"},
    "b": {"model": "blinn_phong", "ambient": [0, 0, 0], "diffuse": [1, 1, 1], "specular": [0, 0, 0], "shininess": 50,
      "reflection": 0, "refraction": 0, "ior": 1.5, "fresnel": false, "absorption": [0, 0, 0], "emission": [0, 0, 0],
      "texture": {"type": "checker", "colors": [[1, 0, 0], [0, 1, 0]], "scale": 8}},
    "tile": {"model": "lambert", "ambient": [0, 0, 0], "diffuse": [1, 1, 1], "specular": [0, 0, 0], "shininess": 50,
      "reflection": 0, "refraction": 0, "ior": 1.5, "fresnel": false, "absorption": [0, 0, 0], "emission": [0, 0, 0],
      "texture": {"type": "image", "file": "maps/tile.png", "wrap": "mirror"}}},
  "shapes": [
    {"type": "sphere", "center": [1, 2, 3], "radius": 0.5, "material": "b"},
    {"type": "cylinder", "base": [1, 0, 0], "top": [1, 3, 0], "radius": 0.25},
    {"type": "plane", "point": [0, -1, 0], "normal": [0, 1, 0.5], "material": "a [1, 2]"},
    {"type": "quad", "corner": [1, 1, 1], "u": [2, 0, 0], "v": [0, 0, 3]},
    {"type": "box", "min": [0, 1, 2], "max": [3, 4, 5], "transform": [{"rotate": [0, 1, 0, 30]}, {"scale": [1, 2, -3]}]},
    {"type": "triangle", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]},
    {"type": "mesh", "file": "../models/bunny.obj", "shading": "flat", "crease": 60.5, "transform": [{"translate": [0, 1.5, 0]}]},
    {"type": "mesh", "file": "../models/cow.obj", "shading": "phong", "transform": [], "instances": [[{"scale": [1, 2, 1]}], []]},
    {"type": "mesh", "file": "../models/cow.obj", "shading": "gouraud", "transform": [], "instances": "../models/herd.txt"},
    {"type": "isosurface", "density": {"type": "linear", "resolution": [4, 4, 4]}, "iso": 0.25,
     "bounds": [[-1, -2, -3], [1, 2, 3]], "transform": [{"scale": [2, 2, 2]}], "material": "b"}],
  "media": [
    {"type": "participating", "bounds": [[-1, -2, -3], [1, 2, 3]], "transform": [{"scale": [2, 2, 2]}], "interpolation": "nearest",
     "density": {"type": "sphere", "of": {"type": "perlin", "resolution": [8, 16, 32], "scale": 2.5, "octaves": 3, "seed": 5}},
     "sigma_a": [1, 2, 3], "sigma_s": [4, 5, 6], "emission": [0, 0, 0], "phase": {"type": "henyey_greenstein", "g": -0.5},
     "emission_density": {"type": "linear", "resolution": [4, 4, 4]}, "method": "march_regular", "step": 0.25,
     "tolerance": 0.125},
    {"type": "participating", "interpolation": "trilinear", "density": {"type": "file", "path": "/data/smoke.vdb", "grid": "density", "level_set": "fill",
       "threshold": 0.25, "remap": [[-1, 0], [0.5, 2], [3, 0]], "scale": 2.5, "negative": "refuse"},
     "sigma_a": [0.1, 0.1, 0.1], "sigma_s": [0, 0, 0], "emission": [0, 0, 0], "phase": {"type": "isotropic"}},
    {"type": "participating", "interpolation": "trilinear", "density": {"type": "constant", "resolution": [4, 4, 4], "value": 0.5},
     "sigma_a": [1, 1, 1], "sigma_s": [0, 0, 0], "emission": [0, 0, 0], "phase": {"type": "isotropic"}},
    {"type": "participating", "interpolation": "trilinear", "density": {"type": "linear", "resolution": [4, 4, 4]},
     "sigma_a": [1, 1, 1], "sigma_s": [0, 0, 0], "emission": [0, 0, 0], "phase": {"type": "isotropic"}},
    {"type": "participating", "interpolation": "trilinear", "density": {"type": "exponential", "resolution": [4, 4, 4]},
     "sigma_a": [1, 1, 1], "sigma_s": [0, 0, 0], "emission": [0, 0, 0], "phase": {"type": "isotropic"}},
    {"type": "liquid", "model": "local_lighting", "interpolation": "trilinear", "presence": "scale",
     "density": {"type": "ball", "resolution": [4, 4, 4], "radius": 0.5, "ramp": 1.5}, "sigma_a": [3, 2, 1],
     "outside": 0.25, "inside": 0.75, "light_intensity": 0.5, "albedo": [0.1, 0.2, 0.3], "specular": [0.4, 0.5, 0.6],
     "shininess": 12, "ambient": [0.7, 0.8, 0.9], "grazing_correction": false, "slices": 100, "method": "auto",
     "step": 0.0625},
    {"type": "liquid", "model": "surface", "interpolation": "trilinear", "presence": "clamp", "iso": 0.75, "material": "b",
     "density": {"type": "constant", "resolution": [4, 4, 4], "value": 1}, "sigma_a": [3, 2, 1]}],
  "render": {"integrator": "whitted", "directions": 32, "distance": 2.5, "rotate": false, "method": "march_midpoint", "step": 0.125, "tolerance": 0.25, "in_scattering": "segment", "shadow": "trace", "light_grid": 32,
    "storage": "u8", "level": 2,
    "light_picks": 16, "light_samples": 4, "light_points": "centroid", "bvh": "midpoint", "roulette": 0.25, "max_depth": 3, "cutoff": 0.25, "shadow_of_glass": "clear", "seed": 7, "max_error": 0.01,
    "error_metric": "display"}
})";

inline SceneDesc scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return scene_read_text(text, "dir/a.json", overrides);
}

// The message of the InputError, or "no error".
inline std::string scene_error(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    scene_of(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace brume
