// Scenes for `brume check` with meshes that are held once and stand in several places: stretched, sheared and mirrored,
// lit, seen through and shining.
#include "check/check_parts.hpp"

namespace brume {

const std::vector<SceneText>& instance_scenes() {
  static const std::vector<SceneText> scenes{{"instances", R"({
  "camera": {"eye": [0.5, 1.6, 3.4], "target": [0, 0, 0], "vfov": 50}, "background": [0.3, 0.4, 0.6],
  "ambient": [0.1, 0.1, 0.1],
  "lights": [{"type": "point", "position": [1, 1.4, 1.5], "intensity": [3, 2.8, 2.5]}],
  "materials": {"checker": {"model": "blinn_phong", "diffuse": 1, "specular": 0.3, "shininess": 30, "ambient": 1, "texture": {"type": "checker", "colors": [[0.8, 0.7, 0.5], [0.2, 0.3, 0.4]], "scale": 2}},
                "mirror": {"model": "phong", "diffuse": 0.1, "specular": 0.4, "shininess": 20, "reflection": 0.7},
                "glass": {"diffuse": 0.05, "refraction": 0.9, "ior": 1.3, "fresnel": true, "absorption": [0.5, 2, 3]},
                "floor": {"diffuse": 0.6}},
  "shapes": [{"type": "plane", "point": [0, -0.7, 0], "normal": [0, 1, 0.02], "material": "floor"},
             {"type": "mesh", "file": "torus.obj", "material": "checker", "transform": [{"scale": 0.5}],
              "instances": [[{"scale": [1, 2.5, 0.6]}, {"rotate": [1, 0.2, 0.1, 70]}, {"translate": [-0.7, 0.1, -0.3]}],
                            [{"rotate": [1, 0, 0.3, 50]}, {"scale": [-0.8, 1.3, 0.9]}, {"translate": [0.1, -0.2, 0.5]}],
                            [{"rotate": [0, 0, 1, 80]}, {"scale": 0.7}, {"translate": [-0.1, 0.5, -0.6]}]]},
             {"type": "mesh", "file": "torus.obj", "material": "mirror",
              "transform": [{"scale": [0.45, -0.45, 0.5]}, {"rotate": [1, 0, 0.2, 65]}, {"translate": [0.9, 0, -0.2]}]},
             {"type": "mesh", "file": "torus.obj", "material": "glass",
              "transform": [{"scale": [-0.5, 0.6, 0.5]}, {"rotate": [0.2, 0, 1, 25]}, {"translate": [0, 0.1, 0.9]}]},
             {"type": "mesh", "file": "torus.obj", "shading": "flat",
              "transform": [{"scale": [0.3, 0.3, -0.3]}, {"rotate": [1, 0, 0, 90]}, {"translate": [-0.9, 0.6, 0.4]}]},
             {"type": "sphere", "center": [0.1, -0.2, 0.5], "radius": 0.2, "material": "checker"}],
  "render": {"max_depth": 2, "cutoff": 0.003, "shadow_of_glass": "clear"}})"},
                                             {"instance_lights", R"({
  "camera": {"eye": [0.5, 1.6, 3.4], "target": [0, 0, 0], "vfov": 40}, "background": [0.05, 0.05, 0.1],
  "lights": [{"type": "directional", "direction": [-0.5, -1, -0.4], "irradiance": [0.5, 0.5, 0.5]}],
  "materials": {"grey": {"model": "phong", "diffuse": 0.5, "specular": 0.3, "shininess": 10},
                "glow": {"diffuse": 0.4, "emission": [3, 2, 1]}},
  "shapes": [{"type": "quad", "corner": [-2, -0.7, -2], "u": [0, 0, 4], "v": [4, 0, 0], "material": "grey"},
             {"type": "mesh", "file": "rod.obj", "material": "glow",
              "instances": [[{"scale": [0.6, 1.2, 0.4]}, {"translate": [-0.7, 0, 0.2]}],
                            [{"scale": [-0.5, 0.8, 0.4]}, {"rotate": [1, 0, 0, 70]}, {"translate": [0.4, 0.7, -0.3]}]]},
             {"type": "mesh", "file": "rod.obj", "instances": [[{"scale": 0.4}, {"translate": [0.8, 0, 0.9]}]]},
             {"type": "mesh", "file": "torus.obj", "material": "grey", "shading": "phong", "transform": [{"scale": [0.25, 0.2, 0.3]}],
              "instances": [[{"rotate": [1, 0, 0, 40]}], [{"scale": [0.7, -0.7, 0.5]}, {"translate": [-0.2, 0.1, 1]}]]}],
  "media": [{"bounds": [[-0.3, -0.65, -1.2], [0.2, -0.3, 1.2]], "density": {"type": "perlin", "resolution": [12, 11, 12], "scale": 3}, "sigma_a": 0.2, "sigma_s": 0.5}],
  "render": {"light_samples": 1}})"}};
  return scenes;
}

}  // namespace brume
