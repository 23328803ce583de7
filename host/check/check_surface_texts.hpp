// Scenes of surfaces for `brume check`. Those of "surfaces" are taken one by one as well (row_scenes.cpp).
#pragma once
#include "check/check_parts.hpp"

namespace brume {

constexpr SceneText SURFACE_SCENES[] = {
    {"surfaces", R"({
  "camera": {"eye": [0.4, 2.4, 3.8], "target": [0, -0.05, 0], "vfov": 38}, "film": {"spp": 4}, "background": [0.1, 0.15, 0.2],
  "ambient": [0.1, 0.1, 0.1],
  "lights": [
    {"type": "point", "position": [1.5, 2.5, 1.5], "intensity": [6, 5, 4]},
    {"type": "directional", "direction": [-1, -1.5, -0.5], "irradiance": [1, 1, 1.2]},
    {"type": "spot", "position": [-1.5, 2.5, 1], "direction": [0.5, -1, -0.3], "angle": 30, "softness": 0.3, "intensity": [8, 8, 8]},
    {"type": "point", "position": [-2, 1, 2], "intensity": [0.3, 0.2, 0.2], "falloff": "none"}],
  "materials": {
    "image": {"model": "blinn_phong", "diffuse": [0.8, 0.7, 0.6], "specular": [0.3, 0.3, 0.3], "shininess": 40, "ambient": [0.5, 0.5, 0.5]},
    "checker": {"diffuse": [1, 1, 1], "texture": {"type": "checker", "colors": [[0.8, 0.8, 0.8], [0.2, 0.3, 0.2]], "scale": 2}},
    "shiny": {"model": "phong", "diffuse": [0.3, 0.3, 0.5], "specular": [0.4, 0.4, 0.4], "shininess": 20, "emission": [0.2, 0.1, 0], "light": false}},
  "shapes": [
    {"type": "sphere", "center": [-0.2, 0.1, 0.1], "radius": 0.55, "material": "image"},
    {"type": "cylinder", "base": [0.8, -0.45, 0.2], "top": [0.95, 0.4, 0], "radius": 0.25, "material": "shiny"},
    {"type": "plane", "point": [0, -0.5, 0], "normal": [0, 1, 0.05], "material": "checker"},
    {"type": "quad", "corner": [-1.5, -0.4, -1], "u": [3, 0, 0.2], "v": [0, 1.8, -0.1], "material": "image"},
    {"type": "box", "min": [-0.3, -0.3, -0.2], "max": [0.3, 0.3, 0.2],
     "transform": [{"rotate": [0, 1, 0.3, 35]}, {"translate": [-1, -0.1, 0.7]}], "material": "shiny"},
    {"type": "isosurface", "density": {"type": "perlin", "resolution": [18, 25, 20], "scale": 3, "octaves": 2, "seed": 7}, "iso": 0.52,
     "bounds": [[-0.5, -0.3, -0.4], [0.5, 0.3, 0.4]], "material": "shiny",
     "transform": [{"rotate": [0, 0, 1, 30]}, {"scale": [1, 0.7, 1.1]}, {"rotate": [1, 0.3, 0, 20]}, {"translate": [0.5, 1.1, -0.3]}]}]})"},
    {"shapes", R"({
  "camera": {"eye": [0.5, 1.6, 4.2], "target": [0, 0.1, 0], "vfov": 38}, "background": [0.2, 0.3, 0.4],
  "lights": [{"type": "directional", "direction": [-0.4, -1, -0.5], "irradiance": [2, 2, 1.8]}],
  "materials": {"mirror": {"diffuse": 0.3, "reflection": 0.4}, "checker": {"texture": {"type": "checker", "scale": 2}}},
  "shapes": [
    {"type": "plane", "point": [0, -0.7, 0], "material": "checker"},
    {"type": "sphere", "center": [-1.1, -0.2, 0], "radius": 0.4, "material": "mirror"},
    {"type": "sphere", "center": [1.1, 0.1, -0.4], "radius": 0.45},
    {"type": "sphere", "center": [0.2, 0.1, -1], "radius": 0.5, "material": "checker"},
    {"type": "cylinder", "base": [-0.4, -0.6, 0.6], "top": [-0.2, 0.1, 0.5], "radius": 0.2},
    {"type": "cylinder", "base": [0.5, -0.7, 0.8], "top": [0.6, -0.3, 0.8], "radius": 0.25, "material": "mirror"},
    {"type": "quad", "corner": [-1.6, -0.6, -1.5], "u": [3.2, 0, 0.2], "v": [0, 1.8, -0.1], "material": "mirror"},
    {"type": "box", "min": [-0.3, -0.2, -0.2], "max": [0.3, 0.2, 0.2],
     "transform": [{"rotate": [0, 1, 0.3, 35]}, {"translate": [-0.6, 0.8, -0.3]}]},
    {"type": "box", "min": [1.2, -0.6, 0.2], "max": [1.5, -0.2, 0.6], "material": "checker"},
    {"type": "box", "min": [-1.5, 0.7, -0.6], "max": [-1.2, 1, -0.2], "material": "mirror"},
    {"type": "cylinder", "base": [-0.9, 0.3, -0.9], "top": [-0.6, 0.4, -0.9], "radius": 0.1},
    {"type": "quad", "corner": [-1.4, -0.6, 0.6], "u": [0.5, 0, 0.3], "v": [0, 0.3, 0], "material": "checker"},
    {"type": "sphere", "center": [1.2, 0.8, -0.5], "radius": 0.1}, {"type": "sphere", "center": [0.9, 0.7, 0.2], "radius": 0.07},
    {"type": "sphere", "center": [0.7, 0.3, 0.5], "radius": 0.06}, {"type": "sphere", "center": [-0.1, 0.5, 0.6], "radius": 0.09},
    {"type": "sphere", "center": [-1.3, 0.4, 0.3], "radius": 0.12, "material": "mirror"},
    {"type": "isosurface", "density": {"type": "perlin", "resolution": [12, 13, 12], "scale": 2, "octaves": 1, "seed": 7}, "iso": 0.52,
     "bounds": [[0, 0.7, -0.4], [0.8, 1.2, 0.4]]}],
  "render": {"max_depth": 2}})"},
    {"mesh", R"({
  "camera": {"type": "orthographic", "eye": [1, 1.6, 3], "target": [0, 0, 0], "height": 2.6}, "film": {"spp": 2},
  "lights": [{"type": "directional", "direction": [-1, -2, -1], "irradiance": [2, 2, 2]},
             {"type": "point", "position": [0, 1.2, 0.2], "intensity": [1, 0.8, 0.6]}],
  "materials": {"torus": {"model": "blinn_phong", "diffuse": [0.6, 0.5, 0.3], "specular": [0.5, 0.5, 0.5], "shininess": 30}},
  "shapes": []})"},
    {"mirrors", R"({
  "camera": {"eye": [0.6, 1.2, 3.4], "target": [0, 0, 0], "vfov": 40}, "film": {"spp": 2}, "background": [0.3, 0.4, 0.6],
  "ambient": [0.1, 0.1, 0.1],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.4], "irradiance": [2, 2, 2]},
             {"type": "point", "position": [1, 1.4, 1.5], "intensity": [2, 1.8, 1.5]}],
  "materials": {"mirror": {"model": "blinn_phong", "diffuse": 0.05, "specular": 0.5, "shininess": 60, "reflection": 0.8},
                "glass": {"model": "phong", "diffuse": 0.02, "specular": 0.4, "shininess": 80, "reflection": 0.1, "refraction": 0.85, "ior": 1.4},
                "floor": {"diffuse": 1, "ambient": 1, "texture": {"type": "checker", "colors": [[0.8, 0.8, 0.8], [0.2, 0.3, 0.2]], "scale": 1.5}}},
  "shapes": [{"type": "plane", "point": [0, -0.8, 0], "normal": [0, 1, 0], "material": "floor"},
             {"type": "quad", "corner": [-3, -0.8, -2.5], "u": [6, 0, 0], "v": [0, 3, 0], "material": "floor"},
             {"type": "box", "min": [-0.5, -0.5, -0.3], "max": [0.3, 0.3, 0.3],
              "transform": [{"rotate": [0, 1, 0, 35]}, {"translate": [-0.7, -0.2, -0.3]}], "material": "mirror"},
             {"type": "sphere", "center": [0.6, -0.1, 0.3], "radius": 0.5, "material": "glass"}],
  "media": [{"bounds": [[-1.5, -0.8, -1.2], [1.5, 0.6, 1.2]], "density": {"type": "exponential", "resolution": [10, 12, 10]},
             "sigma_a": [0.1, 0.15, 0.2], "sigma_s": 0.3, "phase": {"type": "henyey_greenstein", "g": 0.5}}],
  "render": {"method": "dda_gauss2", "max_depth": 4}})"},
    {"mirrors_deep", R"({
  "camera": {"eye": [0.3, 0.4, 3], "target": [0, 0, 0], "vfov": 30}, "background": [0.3, 0.4, 0.6],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.4], "irradiance": [2, 2, 2]}],
  "materials": {"half": {"diffuse": 0.1, "reflection": 0.5, "refraction": 0.5, "ior": 1.4},
                "glass": {"diffuse": 0.1, "reflection": 0.3, "refraction": 0.6, "ior": 1.5}},
  "shapes": [{"type": "sphere", "center": [-0.52, 0, 0], "radius": 0.5, "material": "half"},
             {"type": "sphere", "center": [0.52, 0, 0], "radius": 0.5, "material": "glass"}],
  "render": {"max_depth": 30}})"},
    {"area_lights", R"({
  "camera": {"eye": [0.6, 1.5, 3.6], "target": [0, 0, 0], "vfov": 42}, "background": [0.05, 0.05, 0.1],
  "materials": {
    "grey": {"model": "blinn_phong", "diffuse": [0.6, 0.6, 0.6], "specular": [0.3, 0.3, 0.3], "shininess": 20},
    "warm": {"diffuse": 0.2, "emission": [6, 4, 2]}, "cold": {"diffuse": 0, "emission": [1, 2, 3]}},
  "shapes": [
    {"type": "sphere", "center": [-0.8, 0.5, 0.3], "radius": 0.25, "material": "warm"},
    {"type": "quad", "corner": [0.3, 1.4, -0.3], "u": [0.8, 0, 0.2], "v": [0, 0.1, 0.7], "material": "cold"},
    {"type": "cylinder", "base": [0.9, -0.6, 0.4], "top": [1.1, 0.3, 0.3], "radius": 0.15, "material": "cold"},
    {"type": "box", "min": [-0.2, -0.1, -0.2], "max": [0.2, 0.3, 0.2], "transform": [{"rotate": [0, 1, 0.3, 35]}, {"translate": [0, -0.5, 1]}],
     "material": "warm"},
    {"type": "triangle", "vertices": [[-1.2, 0.1, -0.9], [-0.4, 0, -1], [-0.9, 0.9, -0.8]], "material": "warm"},
    {"type": "sphere", "center": [0.1, 0, 0], "radius": 0.35, "material": "grey"},
    {"type": "quad", "corner": [-2, -0.8, -2], "u": [0, 0, 4], "v": [4, 0, 0], "material": "grey"}],
  "media": [{"density": {"type": "perlin", "resolution": [12, 11, 12], "scale": 3}, "sigma_a": 0.2, "sigma_s": 1.5}],
  "render": {"light_samples": 2}})"},
    {"area_centroid", R"({
  "camera": {"eye": [0.6, 1.5, 3.6], "target": [0, 0, 0], "vfov": 42}, "background": [0.05, 0.05, 0.1],
  "lights": [{"type": "directional", "direction": [0.3, -1, -0.4], "irradiance": 0.2}],
  "materials": {"warm": {"diffuse": 0.2, "emission": [6, 4, 2]}, "glow": {"emission": 2, "light": false}},
  "shapes": [
    {"type": "sphere", "center": [-0.8, 0.5, 0.3], "radius": 0.25, "material": "warm"},
    {"type": "triangle", "vertices": [[0.4, 1.2, -0.9], [1.2, 1.2, -0.9], [0.9, 1.3, 0.2]], "material": "warm"},
    {"type": "sphere", "center": [0.1, 0, 0], "radius": 0.35, "material": "glow"},
    {"type": "quad", "corner": [-2, -0.8, -2], "u": [0, 0, 4], "v": [4, 0, 0]}],
  "media": [{"bounds": [[-1, -0.7, -1], [1, 0.9, 1]], "density": {"type": "constant", "value": 0.6}, "sigma_a": 0.2, "sigma_s": 0.5}],
  "render": {"light_points": "centroid"}})"},
    {"occlusion", R"({
  "camera": {"eye": [0.6, 1.5, 3.6], "target": [0, 0, 0], "vfov": 42}, "film": {"spp": 2}, "background": [0.1, 0.2, 0.3],
  "materials": {"checker": {"texture": {"type": "checker", "scale": 3}, "reflection": 0.5}},
  "shapes": [
    {"type": "sphere", "center": [-0.4, 0, 0.3], "radius": 0.5, "material": "checker"},
    {"type": "cylinder", "base": [0.9, -0.6, 0.4], "top": [1.1, 0.3, 0.3], "radius": 0.15},
    {"type": "triangle", "vertices": [[-1.2, 0.1, -0.9], [0.9, 0, -1], [-0.9, 0.9, -0.8]]},
    {"type": "quad", "corner": [-2, -0.8, -2], "u": [0, 0, 4], "v": [4, 0, 0], "material": "checker"}],
  "render": {"integrator": "ambient_occlusion", "directions": 24, "distance": 1.2}})"},
    {"empty", R"({"background": [0.25, 0.5, 0.75], "film": {"spp": 5}})"},
};

}  // namespace brume
