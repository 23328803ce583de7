// Scenes for `brume check` with shapes that absorb, refract and let light through: glass, and water from outside, from
// within and in bytes.
#include "check/check_parts.hpp"

namespace brume {

const std::vector<SceneText>& glass_scenes() {
  static const std::vector<SceneText> scenes{{"glass", R"({
  "camera": {"eye": [0.6, 1, 3.4], "target": [0, 0, 0], "vfov": 36}, "background": [0.3, 0.4, 0.6],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.4], "irradiance": [2, 2, 2]},
             {"type": "point", "position": [0.5, 0, 0.35], "intensity": [0.3, 0.2, 0.2]},
             {"type": "point", "position": [-1, 1.4, 1.5], "intensity": [2, 1.8, 1.5]}],
  "materials": {"green": {"model": "phong", "diffuse": 0.02, "specular": 0.4, "shininess": 80, "refraction": 1, "ior": 1.4, "fresnel": true, "absorption": [1.5, 0.3, 0.9]},
                "red": {"diffuse": 0, "refraction": 0.9, "ior": 1.2, "absorption": [0.1, 2, 3]},
                "air": {"diffuse": 0, "refraction": 0.8, "reflection": 0.2, "ior": 0.8, "fresnel": true},
                "floor": {"diffuse": 1, "texture": {"type": "checker", "colors": [[0.8, 0.8, 0.8], [0.2, 0.3, 0.2]], "scale": 0.7}}},
  "shapes": [{"type": "plane", "point": [0, -0.8, 0], "normal": [0, 1, 0], "material": "floor"},
             {"type": "quad", "corner": [-3, -0.8, -2.5], "u": [6, 0, 0], "v": [0, 3, 0], "material": "floor"},
             {"type": "box", "min": [-0.5, -0.5, -0.3], "max": [0.3, 0.3, 0.3],
              "transform": [{"rotate": [0, 1, 0, 35]}, {"translate": [-0.7, -0.2, -0.3]}], "material": "red"},
             {"type": "sphere", "center": [-0.75, -0.3, -0.3], "radius": 0.2, "material": "floor"},
             {"type": "sphere", "center": [0.6, -0.1, 0.3], "radius": 0.5, "material": "green"},
             {"type": "sphere", "center": [0.7, -0.2, 0.3], "radius": 0.2, "material": "air"}],
  "media": [{"bounds": [[-1.5, -0.8, -1.2], [1.5, 0.6, 1.2]], "density": {"type": "exponential", "resolution": [10, 12, 10]},
             "sigma_a": 0.1, "sigma_s": 0.3, "phase": {"type": "henyey_greenstein", "g": 0.5}}],
  "render": {"max_depth": 5, "cutoff": 0.003, "shadow_of_glass": "clear"}})"},
                                             {"under_water", R"({
  "camera": {"eye": [0.1, -0.1, 0.7], "target": [0, -0.3, 0], "vfov": 70}, "background": [0.5, 0.6, 0.8],
  "lights": [{"type": "directional", "direction": [-0.3, -1, -0.4], "irradiance": [3, 3, 3]},
             {"type": "point", "position": [0.3, -0.4, 0.1], "intensity": [0.2, 0.2, 0.1]}],
  "materials": {"water": {"diffuse": 0, "refraction": 1, "ior": 1.33, "fresnel": true, "absorption": [0.8, 0.3, 0.2]},
                "floor": {"diffuse": 1, "texture": {"type": "checker", "colors": [[0.8, 0.8, 0.8], [0.3, 0.3, 0.4]], "scale": 3}}},
  "shapes": [{"type": "isosurface", "density": {"type": "linear", "resolution": [5, 9, 7]}, "material": "water"},
             {"type": "plane", "point": [0, -0.8, 0], "normal": [0, 1, 0.05], "material": "floor"},
             {"type": "sphere", "center": [-0.4, 0, -0.4], "radius": 0.25, "material": "floor"}],
  "render": {"shadow_of_glass": "clear", "max_depth": 4}})"},
                                             {"water_u8", R"({
  "camera": {"eye": [1.6, 1.3, 2.6], "target": [0, -0.1, 0], "vfov": 40}, "background": [0.5, 0.6, 0.8],
  "lights": [{"type": "directional", "direction": [-0.6, -1, -0.1], "irradiance": [3, 3, 3]}],
  "materials": {"water": {"diffuse": 0, "refraction": 1, "ior": 1.33, "fresnel": true, "absorption": [0.8, 0.3, 0.2]},
                "floor": {"diffuse": 1, "texture": {"type": "checker", "scale": 1}}},
  "shapes": [{"type": "isosurface", "density": {"type": "perlin", "resolution": [12, 19, 17], "scale": 1.5, "octaves": 1, "seed": 3}, "iso": 0.48,
              "transform": [{"scale": [1, 0.8, 1.2]}, {"rotate": [0, 1, 0.1, 20]}], "material": "water"},
             {"type": "isosurface", "density": {"type": "sphere", "of": {"type": "constant", "resolution": [9, 9, 9]}},
              "bounds": [[0.6, 0.6, 0.4], [1.1, 1.1, 0.9]]},
             {"type": "plane", "point": [0, -1.1, 0], "normal": [0, 1, 0], "material": "floor"}],
  "media": [{"bounds": [[-1, -0.6, -0.6], [0.3, 0.6, 0.6]], "density": {"type": "perlin", "resolution": [12, 19, 17], "scale": 2, "octaves": 1, "seed": 3},
             "sigma_a": 0.2, "sigma_s": [0.5, 0.4, 0.3]}],
  "render": {"storage": "u8", "max_depth": 2}})"}};
  return scenes;
}

}  // namespace brume
