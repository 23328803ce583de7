// What the scene reader refuses, with which message: one table per part of a scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/scene_texts.hpp"

namespace brume {
namespace {

using testing::StartsWith;

struct Broken {
  const char* text;
  const char* error;  // after "dir/a.json: "
};

void expect_refused(const std::vector<Broken>& table) {
  for (const Broken& broken : table) {
    const std::string error = scene_error(broken.text);
    EXPECT_THAT(error, StartsWith(std::string("dir/a.json: ") + broken.error)) << broken.text;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(SceneRefusals, RefusesBrokenWholes) {
  expect_refused({
      {"", "is empty"},
      {"[]", "/: expected an object, got []"},
      {R"({"camera": 1})", "/camera: expected an object, got 1"},
      {R"({"camra": {}})", "/: unknown key 'camra' (did you mean 'camera'?); known: ambient, background, camera, film"},
      {R"({"film": {"spp": 1, "spp": 2}})", "line 1, column "},
      {R"({"film": {"exposure": 1e400}})", "line 1, column "},
      {R"({"background": "red"})", "/background: expected a number or 3 numbers, got \"red\""},
      {R"({"background": -1})", "/background: expected a number in [0, 3e+32], got -1"},
      {R"({"ambient": [0, -1, 0]})", "/ambient/1: expected a number >= 0, got -1"},
      {R"({"lights": {}})", "/lights: expected a list, got {}"},
      {R"({"materials": {"a": {"texture": "t_%03d.png"}}})",
       "/materials/a/texture: names the files of a sequence, expected together with brume render --frames, got"},
      {R"({"materials": []})", "/materials: expected an object, got []"},
  });
}

TEST(SceneRefusals, RefusesBrokenCamerasAndFilms) {
  expect_refused({
      {R"({"camera": {"type": "fisheye"}})",
       "/camera/type: unknown camera 'fisheye'; known: perspective, orthographic"},
      {R"({"camera": {"vfov": 0}})", "/camera/vfov: expected a number in (0, 180), got 0"},
      {R"({"camera": {"vfov": 180}})", "/camera/vfov: expected a number in (0, 180), got 180"},
      {R"({"camera": {"height": 2}})", "/camera: unknown key 'height'; known: eye, target, type, up, vfov"},
      {R"({"camera": {"type": "orthographic", "height": 0}})", "/camera/height: expected a number > 0, got 0"},
      {R"({"camera": {"eye": [0, 0]}})", "/camera/eye: expected 3 numbers, got [0,0]"},
      {R"({"camera": {"eye": [0, 0, 0]}})", "/camera: eye and target are the same point"},
      {R"({"camera": {"eye": [0, 3, 0]}})", "/camera: up is zero or along the view"},
      {R"({"camera": {"up": [0, 0, 0]}})", "/camera: up is zero or along the view"},
      {R"({"film": {"size": [512]}})", "/film/size: expected [width, height], got [512]"},
      {R"({"film": {"size": [0, 512]}})", "/film/size/0: expected an integer in [1, 65536], got 0"},
      {R"({"film": {"size": [512, 65537]}})", "/film/size/1: expected an integer in [1, 65536], got 65537"},
      {R"({"film": {"spp": 0}})", "/film/spp: expected an integer in [1, 1048576], got 0"},
      {R"({"film": {"spp": 1048577}})", "/film/spp: expected an integer in [1, 1048576], got 1048577"},
      {R"({"film": {"exposure": 101}})", "/film/exposure: expected a number in [-100, 100], got 101"},
      {R"({"film": {"sise": [1, 1]}})", "/film: unknown key 'sise' (did you mean 'size'?)"},
  });
}

TEST(SceneRefusals, RefusesBrokenLights) {
  expect_refused({
      {R"({"lights": [{}]})", "/lights/0: the key 'type' is missing"},
      {R"({"lights": [{"type": "laser"}]})", "/lights/0/type: unknown light 'laser'; known: point, directional, spot"},
      {R"({"lights": [{"type": "point", "positon": [0, 0, 0]}]})",
       "/lights/0: the key 'position' is missing (it has 'positon')"},
      {R"({"lights": [{"type": "point", "position": [0, 0, 0], "intensity": -1}]})",
       "/lights/0/intensity: expected a number in [0, 1e+100], got -1"},
      {R"({"lights": [{"type": "point", "position": [0, 0, 0], "falloff": "linear"}]})",
       "/lights/0/falloff: unknown falloff 'linear'; known: inverse_square, none"},
      {R"({"lights": [{"type": "directional", "direction": [0, 0, 0]}]})",
       "/lights/0/direction: the direction must not be zero"},
      {R"({"lights": [{"type": "directional", "direction": [0, 1e-300, 0]}]})",
       "/lights/0/direction: the direction must not be zero"},
      {R"({"lights": [{"type": "directional", "direction": [0, 1, 0], "intensity": 1}]})",
       "/lights/0: unknown key 'intensity'"},
      {R"({"lights": [{"type": "spot", "position": [0, 0, 0], "direction": [0, 1, 0], "angle": 90}]})",
       "/lights/0/angle: expected a number in (0, 90), got 90"},
      {R"({"shapes": [{"type": "mesh", "file": "a.obj", "crease": 181}]})",
       "/shapes/0/crease: expected a number in [0, 180], got 181"},
      {R"({"shapes": [{"type": "mesh", "file": "a.obj", "instances": []}]})",
       "/shapes/0/instances: expected a transform or more, or the path of a file"},
      {R"({"shapes": [{"type": "mesh", "file": "a.obj", "instances": [[], {"scale": 2}]}]})",
       "/shapes/0/instances/1: expected a list"},
      {R"({"shapes": [{"type": "mesh", "file": "a.obj", "instances": [[{"scale": [1, 0, 1]}]]}]})",
       "/shapes/0/instances/0/0/scale: a scale of 0 leaves nothing"},
      {R"({"shapes": [{"type": "sphere", "instances": [[]]}]})", "/shapes/0: unknown key 'instances'"},
      {R"({"lights": [{"type": "spot", "position": [0, 0, 0], "direction": [0, 1, 0], "softness": 2}]})",
       "/lights/0/softness: expected a number in [0, 1], got 2"},
  });
}

TEST(SceneRefusals, RefusesBrokenMaterials) {
  expect_refused({
      {R"({"materials": {"m": {"model": "gold"}}})",
       "/materials/m/model: unknown material model 'gold'; known: lambert, phong, blinn_phong"},
      {R"({"materials": {"m": {"diffuse": -0.5}}})", "/materials/m/diffuse: expected a number >= 0, got -0.5"},
      {R"({"materials": {"m": {"shininess": -1}}})",
       "/materials/m/shininess: expected a number in [0, 1000000], got -1"},
      {R"({"materials": {"m": {"ior": 0}}})", "/materials/m/ior: expected a number > 0, got 0"},
      {R"({"materials": {"m": {"fresnel": 1}}})", "/materials/m/fresnel: expected true or false, got 1"},
      {R"({"materials": {"m": {"absorption": -1}}})", "/materials/m/absorption: expected a number >= 0, got -1"},
      {R"({"materials": {"m": {"reflection": 2}}})", "/materials/m/reflection: expected a number in [0, 1], got 2"},
      {R"({"materials": {"m": {"texture": ""}}})", "/materials/m/texture: expected the path of a file, got \"\""},
      {R"({"materials": {"m": {"texture": "a\u0000b"}}})", "/materials/m/texture: expected the path of a file"},
      {R"({"materials": {"m": {"texture": 3}}})", "/materials/m/texture: expected an object, got 3"},
      {R"({"materials": {"m": {"texture": {"type": "wood"}}}})",
       "/materials/m/texture/type: unknown texture 'wood'; known: image, checker"},
      {R"({"materials": {"m": {"texture": {"type": "checker", "scale": 0}}}})",
       "/materials/m/texture/scale: expected a number > 0, got 0"},
      {R"({"materials": {"m": {"texture": {"type": "checker", "colors": [1]}}}})",
       "/materials/m/texture/colors: expected 2 colors, got [1]"},
      {R"({"materials": {"m": {"texture": {"type": "image"}}}})", "/materials/m/texture: the key 'file' is missing"},
      {R"({"materials": {"m": {"color": 1}}})", "/materials/m: unknown key 'color'"},
  });
}

TEST(SceneRefusals, RefusesBrokenShapes) {
  expect_refused({
      {R"({"shapes": [{"type": "isosurface"}]})", "/shapes/0: the key 'density' is missing"},
      {R"({"shapes": [{"type": "isosurface", "density": {"type": "linear"}, "iso": 0}]})",
       "/shapes/0/iso: expected a number > 0, got 0"},
      {R"({"shapes": [{"type": "teapot"}]})",
       "/shapes/0/type: unknown shape 'teapot'; known: sphere, cylinder, plane, quad, box, isosurface, triangle, mesh"},
      {R"({"shapes": [{"type": "sphere", "radius": 0}]})", "/shapes/0/radius: expected a number > 0, got 0"},
      {R"({"shapes": [{"type": "sphere", "corner": [0, 0, 0]}]})", "/shapes/0: unknown key 'corner'"},
      {R"({"shapes": [{"type": "sphere", "material": "gold"}]})",
       "/shapes/0/material: unknown material 'gold'; known: none"},
      {R"({"materials": {"a": {}, "b": {}}, "shapes": [{"type": "sphere", "material": "gold"}]})",
       "/shapes/0/material: unknown material 'gold'; known: a, b"},
      {R"({"shapes": [{"type": "cylinder", "base": [1, 1, 1], "top": [1, 1, 1]}]})",
       "/shapes/0: base and top are the same point"},
      {R"({"shapes": [{"type": "cylinder", "radius": -1}]})", "/shapes/0/radius: expected a number > 0, got -1"},
      {R"({"shapes": [{"type": "plane", "normal": [0, 0, 0]}]})", "/shapes/0/normal: the normal must not be zero"},
      {R"({"shapes": [{"type": "quad", "u": [1, 0, 0], "v": [-2, 0, 0]}]})", "/shapes/0: u and v are parallel or zero"},
      {R"({"shapes": [{"type": "box", "min": [0, 0, 0], "max": [1, 0, 1]}]})",
       "/shapes/0: expected min < max on every axis"},
      {R"({"shapes": [{"type": "triangle"}]})", "/shapes/0: the key 'vertices' is missing"},
      {R"({"shapes": [{"type": "triangle", "vertices": [[0, 0, 0], [1, 0, 0]]}]})",
       "/shapes/0/vertices: expected 3 vertices"},
      {R"({"shapes": [{"type": "triangle", "vertices": [[0, 0, 0], [1, 1, 1], [3, 3, 3]]}]})",
       "/shapes/0/vertices: the vertices lie on a line"},
      {R"({"shapes": [{"type": "mesh"}]})", "/shapes/0: the key 'file' is missing"},
      {R"({"shapes": [{"type": "box", "transform": [{"scale": [1, 0, 1]}]}]})",
       "/shapes/0/transform/0/scale: a scale of 0 leaves nothing"},
      {R"({"shapes": [{"type": "box", "transform": [{"scale": 0}]}]})", "/shapes/0/transform/0/scale: a scale of 0"},
      {R"({"shapes": [{"type": "box", "transform": [{"rotate": [0, 0, 0, 30]}]}]})",
       "/shapes/0/transform/0/rotate: the axis must not be zero"},
      {R"({"shapes": [{"type": "box", "transform": [{"rotate": [0, 1, 0]}]}]})",
       "/shapes/0/transform/0/rotate: expected [x, y, z, degrees], got [0,1,0]"},
      {R"({"shapes": [{"type": "box", "transform": [{"scale": 1, "translate": [0, 0, 0]}]}]})",
       "/shapes/0/transform/0: expected one of"},
      {R"({"shapes": [{"type": "box", "transform": [{"scal": 1}]}]})",
       "/shapes/0/transform/0: unknown key 'scal' (did you mean 'scale'?)"},
  });
}

TEST(SceneRefusals, RefusesBrokenMedia) {
  expect_refused({
      {R"({"media": [{}]})", "/media/0: the key 'density' is missing"},
      {R"({"media": [{"density": {"type": "marble"}}]})",
       "/media/0/density/type: unknown density 'marble'; known: constant, linear, exponential, perlin, sphere, ball, "
       "file"},
      {R"({"media": [{"density": {"type": "linear", "value": 1}}]})", "/media/0/density: unknown key 'value'"},
      {R"({"media": [{"density": {"type": "constant", "value": -1}}]})",
       "/media/0/density/value: expected a number >= 0, got -1"},
      {R"({"media": [{"density": {"type": "perlin", "octaves": 17}}]})",
       "/media/0/density/octaves: expected an integer in [1, 16], got 17"},
      {R"({"media": [{"density": {"type": "perlin", "scale": 0}}]})", "/media/0/density/scale: expected a number > 0"},
      {R"({"media": [{"density": {"type": "perlin", "seed": 2147483648}}]})",
       "/media/0/density/seed: expected an integer in [0, 2147483647], got 2147483648"},
      {R"({"media": [{"density": {"type": "perlin", "resolution": [64, 64]}}]})",
       "/media/0/density/resolution: expected 3 integers, got [64,64]"},
      {R"({"media": [{"density": {"type": "perlin", "resolution": [4097, 1, 1]}}]})",
       "/media/0/density/resolution/0: expected an integer in [1, 4096], got 4097"},
      {R"({"media": [{"density": {"type": "perlin", "resolution": [2048, 1024, 1024]}}]})",
       "/media/0/density/resolution: 2147483648 samples; at most 2147483647 are allowed"},
      {R"({"media": [{"density": {"type": "sphere"}}]})", "/media/0/density: the key 'of' is missing"},
      {R"({"media": [{"density": {"type": "sphere", "of": {"type": "x"}}}]})",
       "/media/0/density/of/type: unknown density"},
      {R"({"media": [{"density": {"type": "file", "file": "a.vdb"}}]})", "/media/0/density: the key 'path' is missing"},
      {R"({"media": [{"density": {"type": "perlin", "threshold": 0}}]})", "/media/0/density: unknown key 'threshold'"},
      {R"({"media": [{"density": {"type": "file", "path": "a.vdb", "remap": []}}]})",
       "/media/0/density/remap: expected [[value, density], ...]"},
      {R"({"media": [{"density": {"type": "file", "path": "a.vdb", "remap": [[0, 1, 2]]}}]})",
       "/media/0/density/remap/0: expected [value, density], got [0,1,2]"},
      {R"({"media": [{"density": {"type": "file", "path": "a.vdb", "remap": [[0, 1], [0, 2]]}}]})",
       "/media/0/density/remap/1: expected a value above that of the pair before, got [0,2]"},
      {R"({"media": [{"density": {"type": "file", "path": "a.vdb", "remap": [[0, -1]]}}]})",
       "/media/0/density/remap/0/1: expected a number >= 0, got -1"},
      {R"({"media": [{"density": {"type": "file", "path": "a.vdb", "scale": -1}}]})",
       "/media/0/density/scale: expected a number >= 0, got -1"},
      {R"({"media": [{"density": {"type": "file", "path": "a.vdb", "level_set": "keep"}}]})",
       "/media/0/density/level_set: unknown level set rule 'keep'; known: refuse, fill"},
      {R"({"media": [{"density": {"type": "file", "path": "a.vdb", "negative": 0}}]})",
       "/media/0/density/negative: expected"},
      {R"({"media": [{"density": {"type": "constant"}, "bounds": [[0, 0, 0]]}]})",
       "/media/0/bounds: expected [[x, y, z]"},
      {R"({"media": [{"density": {"type": "constant"}, "bounds": [[0, 0, 0], [1, -1, 1]]}]})",
       "/media/0/bounds: expected the first corner below the second on every axis"},
      {R"({"media": [{"density": {"type": "constant"}, "sigma_a": "red"}]})",
       "/media/0/sigma_a: expected a number or 3 numbers, got \"red\""},
      {R"({"media": [{"density": {"type": "constant"}, "sigma_s": [1, -1, 1]}]})",
       "/media/0/sigma_s/1: expected a number >= 0"},
      {R"({"media": [{"density": {"type": "constant"}, "interpolation": "cubic"}]})",
       "/media/0/interpolation: unknown interpolation 'cubic'; known: nearest, trilinear"},
      {R"({"media": [{"density": {"type": "constant"}, "phase": {"type": "mie"}}]})",
       "/media/0/phase/type: unknown phase function 'mie'; known: isotropic, henyey_greenstein"},
      {R"({"media": [{"density": {"type": "constant"}, "phase": {"type": "isotropic", "g": 0}}]})",
       "/media/0/phase: unknown key 'g'"},
      {R"({"media": [{"density": {"type": "constant"}, "phase": {"type": "henyey_greenstein", "g": 1}}]})",
       "/media/0/phase/g: expected a number in (-1, 1), got 1"},
      {R"({"media": [{"density": {"type": "constant"}, "phase": {"type": "henyey_greenstein", "g": -0.99999999999}}]})",
       "/media/0/phase/g: expected a number in (-1, 1), got -0.99999999999"},
  });
}

TEST(SceneRefusals, RefusesBrokenLiquids) {
  const auto liquid = [](const std::string& keys) {
    return scene_error(R"({"media": [{"type": "liquid", "density": {"type": "ball"})" + keys + "}]}");
  };
  const auto expect = [&](const std::string& keys, const std::string& error) {
    EXPECT_THAT(liquid(keys), StartsWith("dir/a.json: /media/0" + error)) << keys;
  };
  EXPECT_EQ(liquid(""), "no error");
  expect(R"(, "model": "sph")", "/model: unknown model of a liquid 'sph'; known: local_lighting, surface");
  expect(R"(, "presence": "keep")", "/presence: unknown rule for the presence 'keep'; known: refuse, scale, clamp");
  expect(R"(, "interpolation": "nearest")", "/interpolation: a liquid has its surface between samples");
  expect(R"(, "sigma_s": 1)", "/sigma_s: a liquid does not scatter");
  expect(R"(, "emission": 1)", ": unknown key 'emission'");
  expect(R"(, "phase": {"type": "isotropic"})", ": unknown key 'phase'");
  expect(R"(, "tolerance": 0.1)", ": unknown key 'tolerance'");
  expect(R"(, "iso": 0.5)", ": unknown key 'iso'");
  expect(R"(, "outside": 0.6, "inside": 0.5)", "/inside: expected a presence above that of \"outside\", 0.6, got 0.5");
  expect(R"(, "outside": 0.7)", "/outside: expected a presence below that of \"inside\", 0.6, got 0.7");
  expect(R"(, "inside": 0.2)", "/inside: expected a presence above that of \"outside\", 0.5, got 0.2");
  expect(R"(, "inside": 1.5)", "/inside: expected a number in [0, 1], got 1.5");
  expect(R"(, "light_intensity": -1)", "/light_intensity: expected a number >= 0");
  expect(R"(, "grazing_correction": 1)", "/grazing_correction: expected true or false, got 1");
  expect(R"(, "slices": 0)", "/slices: expected an integer in [1, 100000], got 0");
  expect(R"(, "model": "surface", "iso": 1)", "/iso: expected a number in (0, 1), got 1");
  expect(R"(, "model": "surface", "outside": 0.1)", ": unknown key 'outside'");
  expect(R"(, "model": "surface", "step": 0.1)", ": unknown key 'step'");
  expect(R"(, "model": "surface", "material": "water")", "/material: unknown material 'water'; known: none");
  EXPECT_THAT(scene_error(R"({"media": [{"density": {"type": "ball"}, "inside": 1}]})"),
              StartsWith("dir/a.json: /media/0: unknown key 'inside'"));
  EXPECT_THAT(scene_error(R"({"media": [{"type": "solid", "density": {"type": "ball"}}]})"),
              StartsWith("dir/a.json: /media/0/type: unknown medium 'solid'; known: participating, liquid"));
}

TEST(SceneRefusals, RefusesBrokenRenderSettings) {
  expect_refused({
      {R"({"render": {"method": "x"}})", "/render/method: unknown method 'x'; known: auto, dda_nearest, dda_gauss2,"},
      {R"({"render": {"step": 0}})", "/render/step: expected a number > 0, got 0"},
      {R"({"render": {"cutoff": 2}})", "/render/cutoff: expected a number in [0, 1], got 2"},
      {R"({"render": {"shadow_of_glass": "dark"}})",
       "/render/shadow_of_glass: unknown shadow of glass 'dark'; known: opaque, clear"},
      {R"({"render": {"max_depth": 65}})", "/render/max_depth: expected an integer in [0, 64], got 65"},
      {R"({"render": {"max_depth": -1}})", "/render/max_depth: expected an integer in [0, 64], got -1"},
      {R"({"render": {"seed": -1}})", "/render/seed: expected an integer in [0, 2147483647], got -1"},
      {R"({"render": {"seed": 1.5}})", "/render/seed: expected an integer in [0, 2147483647], got 1.5"},
  });
}

TEST(SceneRefusals, RefusesWhatIsOutOfRangeOrStillToCome) {
  expect_refused({
      {R"({"render": {"in_scattering": "trapezoid"}})",
       "/render/in_scattering: unknown in-scattering rule 'trapezoid'; known: auto, segment, rectangle, gauss2"},
      {R"({"render": {"shadow": "none"}})", "/render/shadow: unknown shadow mode 'none'; known: auto, trace, grid"},
      {R"({"render": {"light_grid": 0}})", "/render/light_grid: expected"},
      {R"({"render": {"roulette": 1.5}})", "/render/roulette: expected"},
      {R"({"render": {"storage": "f64"}})", "/render/storage: unknown storage 'f64'; known: f32, f16, u8"},
      {R"({"render": {"max_error": 0}})", "/render/max_error: expected a number > 0"},
      {R"({"render": {"time_budget": -1}})", "/render/time_budget: expected a number > 0"},
      {R"({"render": {"max_error": 0.1, "time_budget": 1}})", "/render/time_budget: expected without max_error"},
      {R"({"render": {"error_metric": "mse"}})",
       "/render/error_metric: unknown error metric 'mse'; known: rel_rmse, max_abs, display"},
      {R"({"materials": {"m": {"reflection": 1.5}}})", "/materials/m/reflection: expected a number in [0, 1]"},
      {R"({"materials": {"m": {"refraction": -1}}})", "/materials/m/refraction: expected a number in [0, 1]"},
      {R"({"media": [{"density": {"type": "constant"}, "emission": [0, -1, 0]}]})", "/media/0/emission"},
      {R"({"shapes": [{"type": "mesh", "file": "a.obj", "shading": "toon"}]})",
       "/shapes/0/shading: unknown shading 'toon'; known: flat, phong, gouraud"},
  });
  EXPECT_EQ(scene_error(R"({"render": {"in_scattering": "segment", "shadow": "auto", "max_error": null},
                         "materials": {"m": {"reflection": 0.5, "refraction": 1}},
                         "media": [{"density": {"type": "constant"}, "emission": 0},
                                   {"density": {"type": "constant"}, "emission": [0, 0.0, 0]}]})"),
            "no error");
}

}  // namespace
}  // namespace brume
