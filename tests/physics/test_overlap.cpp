// Media on one spot: kernels against the reference for every method, and what another medium costs.
#include <string>

#include "film/film_compare.hpp"
#include "film/film_write.hpp"
#include "physics/closed_form.hpp"
#include "render/kernel_options.hpp"
#include "scene/families.hpp"

namespace brume::test {
namespace {

// Perlin boxes about the origin, each turned by 20 degrees against the one before, and `more` media.
std::string boxes_scene(int count, const std::string& medium, const std::string& render, const std::string& more = "") {
  std::string media;
  for (int i = 0; i < count; ++i)
    media += std::string(i ? "," : "") +
             R"({"density": {"type": "perlin", "resolution": [16, 16, 16], "scale": 4, "seed": 2},
                 "transform": [{"rotate": [0, 1, 0, )" +
             std::to_string(20 * i) + R"(]}], )" + medium + "}";
  return R"({"camera": {"eye": [1.7, 1.25, 3.9], "target": [0, 0, 0], "vfov": 40}, "film": {"size": [12, 12]},
    "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": 3}],
    "media": [)" +
         media + more + R"(], "render": )" + render + "}";
}

PlannedScene flat_of(const std::string& scene, int lanes = 8) {
  return flatten(scene_read_text(scene, "overlap.json", {}), {bvh_width_for(lanes), {}});
}

void expect_as_reference(const std::string& scene, const std::vector<int>& widths, const std::string& where) {
  for (const int lanes : widths) {
    const PlannedScene flat = flat_of(scene, lanes);
    Film expected({flat.frame.camera.width, flat.frame.camera.height}), film = expected;
    reference::render(flat, expected);
    Renderer(pocl(), flat, {lanes, false, 0}).render(film, [](double) { return true; });
    const CheckRow row = film_check(where, lanes, film, expected);
    EXPECT_LE(row.max_error, 1e-4) << where << ", " << lanes << " lanes";
    EXPECT_EQ(row.edges, 0u) << where << ", " << lanes << " lanes";
  }
}

TEST(Overlap, FourTurnedBoxesByEveryMethod) {
  for (const FamilyRow& method : method_family()) {
    if (!(method_fits(method.id) & (FITS_NEAREST | FITS_TRILINEAR))) continue;
    const std::string nearest = method_fits(method.id) & FITS_TRILINEAR ? "" : R"("interpolation": "nearest", )";
    const std::string render = R"({"step": 0.11, "method": ")" + std::string(method.name) + "\"}";
    expect_as_reference(boxes_scene(4, nearest + R"("sigma_a": [0.1, 0.2, 0.3], "sigma_s": 1)", render), {4, 16},
                        std::string(method.name));
  }
}

// Depths to the lights are interpolated where two media and more scatter on one spot, but beside a lamp and where they
// are dense; by each rule the places at which they are taken are others.
TEST(Overlap, LightOfBoxesByEveryRule) {
  const std::string lamp = R"("lights": [{"type": "point", "position": [0.2, 0.1, 0.3], "intensity": 2}, )";
  for (const std::string sigma_s : {"0.1", "1", "40"})
    for (const FamilyRow& rule : in_scattering_family()) {
      const std::string medium = R"("sigma_a": [0.1, 0.2, 0.3], "sigma_s": )" + sigma_s;
      std::string scene = boxes_scene(3, medium, R"({"in_scattering": ")" + std::string(rule.name) + "\"}");
      EXPECT_TRUE(flat_of(scene).frame.light_ladder);
      scene.replace(scene.find(R"("lights": [)"), 11, lamp);
      expect_as_reference(scene, {1, 16}, std::string(rule.name) + ", sigma_s " + sigma_s);
    }
}

// Against the exact integral, and seen from afar.
TEST(Overlap, LightOfBoxesIsNearTheIntegral) {
  for (const double afar : {1.0, 1000.0}) {
    std::string scene = boxes_scene(4, R"("sigma_s": 1)", "{}");
    const std::string eye = "[1.7, 1.25, 3.9]", fov = R"("vfov": 40)";
    scene.replace(scene.find(eye), eye.size(),
                  "[" + number(1.7 * afar) + "," + number(1.25 * afar) + "," + number(3.9 * afar) + "]");
    scene.replace(scene.find(fov), fov.size(), R"("vfov": )" + number(40 / afar));
    const PlannedScene flat = flat_of(scene);
    Film exact({12, 12});
    reference::render(flat, exact, {3, 0});
    PlannedScene own = flat;
    own.frame.light_ladder = 0;
    const auto error = [&](const PlannedScene& planned) {
      return image_compare(film_image(render_film(pocl(), planned, 16)), film_image(exact)).rel_rmse;
    };
    EXPECT_LE(error(own), 2.5e-3) << afar;  // cells are rough, and the other media's depth is taken evenly over each
    EXPECT_LE(error(flat), 1.5 * error(own)) << afar;
  }
}

// A dense medium is cut into parts: others are asked anew inside of its segments.
TEST(Overlap, DenseGlowingBoxesAndAConstantFog) {
  const std::string fog = R"(, {"density": {"type": "constant"}, "bounds": [[-2, -0.4, -2], [2, 0.3, 2]],
                              "sigma_a": 0.3, "sigma_s": 0.7})";
  for (const double sigma : {1e-3, 1.0, 40.0, 1e3})
    expect_as_reference(
        boxes_scene(2, R"("sigma_s": 0, "emission": [1, 0.5, 0.2], "sigma_a": )" + std::to_string(sigma), "{}", fog),
        {1, 16}, "sigma_a " + std::to_string(sigma));
}

// Media of every kind about one spot, as many as asked for: scattering, glowing and absorbing, of different methods and
// sizes, dense ones inside of others, some only partly overlapping, a constant fog among them.
std::string mixed_medium(int i) {
  const std::string perlin = R"("density": {"type": "perlin", "resolution": [8, 8, 8], "scale": 3, "seed": )" +
                             std::to_string(i + 1) + R"(}, "transform": [{"rotate": [0, 1, 0.3, )" +
                             std::to_string(20 * i) + "]}";
  const std::string kinds[] = {
      perlin + R"(], "sigma_a": [0.1, 0.2, 0.3], "sigma_s": 0.4)",
      perlin +
          R"(], "method": "march_midpoint", "step": 0.11, "sigma_s": 0, "sigma_a": 0.3, "emission": [1, 0.5, 0.2])",
      perlin +
          R"(, {"scale": 0.3}, {"translate": [0.1, 0.2, 0]}], "method": "dda_midpoint", "sigma_a": 30, "sigma_s": 70)",
      R"("density": {"type": "constant"}, "bounds": [[-2, -0.4, -2], [2, 0.3, 2]], "sigma_a": 0.03, "sigma_s": 0.1)",
      perlin +
          R"(, {"translate": [0.6, 0, 0.2]}], "interpolation": "nearest", "sigma_a": 0.1, "sigma_s": 0.2,
               "method": "march_midpoint_jitter", "step": 0.07)",
      perlin + R"(, {"translate": [-0.7, 0.1, 0]}], "sigma_a": 0.5, "sigma_s": 0)"};
  return "{" + kinds[i % 6] + "}";
}

std::string mixed_scene(int count, const std::string& render) {
  std::string media;
  for (int i = 0; i < count; ++i) media += (i ? "," : "") + mixed_medium(i);
  return R"({"camera": {"eye": [1.7, 1.25, 3.9], "target": [0, 0, 0], "vfov": 40}, "film": {"size": [8, 8]},
    "lights": [{"type": "directional", "direction": [-0.5, -1, -0.3], "irradiance": 3}],
    "media": [)" +
         media + R"(], "render": )" + render + "}";
}

// Up to 16 media are walked together; the seventeenth is asked by each batch of the others.
TEST(Overlap, MediaOfEveryKindAndNumber) {
  static_assert(MEDIA_TOGETHER == 16);
  for (const int count : {2, 3, 16, 17})
    expect_as_reference(mixed_scene(count, "{}"), {1, 4, 8, 16}, std::to_string(count) + " media");
}

TEST(Overlap, MixedMediaByEveryRuleStorageAndShadow) {
  for (const std::string render :
       {R"({"in_scattering": "gauss2", "storage": "f16"})", R"({"in_scattering": "rectangle", "storage": "u8"})",
        R"({"shadow": "grid", "light_grid": 8, "storage": "u8"})"})
    expect_as_reference(mixed_scene(6, render), {4, 16}, render);
}

// `adaptive` walks beside others where it asks for no runs of light: as a glow and with light grids.
TEST(Overlap, AdaptiveMediaTogether) {
  const std::string adaptive = R"("method": "adaptive", "tolerance": 1e-3)";
  for (const double sigma : {0.1, 40.0})
    expect_as_reference(
        boxes_scene(3, R"("sigma_s": 0, "emission": [1, 0.5, 0.2], "sigma_a": )" + std::to_string(sigma),
                    "{" + adaptive + "}"),
        {1, 16}, "adaptive glow of " + std::to_string(sigma));
  expect_as_reference(boxes_scene(3, R"("sigma_a": [0.1, 0.2, 0.3], "sigma_s": 2)",
                                  "{" + adaptive + R"(, "shadow": "grid", "light_grid": 8})"),
                      {1, 16}, "adaptive with light grids");
}

TEST(Overlap, KernelsAreToldHowManyAreWalked) {
  const auto media = [](const std::string& scene) {
    const PlannedScene flat = flat_of(scene);
    return scene_kernel_options(flat, flat).front().value;
  };
  const std::string smoke = R"("sigma_s": 1)", fog = R"(, {"density": {"type": "constant"}, "sigma_s": 1})";
  EXPECT_EQ(media(boxes_scene(1, smoke, "{}")), 1u);
  EXPECT_EQ(media(boxes_scene(1, smoke, "{}", fog + fog)), 2u);
  EXPECT_EQ(media(boxes_scene(2, smoke, "{}")), 3u);
  EXPECT_EQ(media(boxes_scene(15, smoke, "{}", fog)), 3u);
  EXPECT_EQ(media(boxes_scene(16, smoke, "{}", fog)), 4u);
  const std::string adaptive = R"({"method": "adaptive")";
  EXPECT_EQ(media(boxes_scene(2, smoke, adaptive + "}")), 2u);
  EXPECT_EQ(media(boxes_scene(2, smoke, adaptive + R"(, "shadow": "grid"})")), 3u);
  EXPECT_EQ(media(boxes_scene(2, R"("sigma_s": 0, "emission": 1)", adaptive + "}")), 3u);
}

double lookups_of(const PlannedScene& scene) {
  double lookups = 0;
  const Film film = render_film(pocl(), scene, 16);
  for (const FilmPixel& pixel : film.pixels()) lookups += pixel.lookups;
  return lookups;
}

// Each medium is walked once, whatever the others are, one lookup a segment where the medium alone takes two; asking at
// both ends of every segment took 24 times the lookups of one medium, asking for each batch 11 times.
TEST(Overlap, LookupsGrowAsTheNumberOfMedia) {
  // by gauss2 so thin that no glow is cut
  for (const auto& [sigma_a, render] : {std::pair<std::string, std::string>{"0.05", R"({"in_scattering": "segment"})"},
                                        {"0.05", R"({"method": "adaptive"})"},
                                        {"0.005", "{}"},
                                        {"0.005", R"({"method": "adaptive"})"}}) {
    const std::string glow = R"("sigma_s": 0, "emission": 1, "sigma_a": )" + sigma_a;
    const double one = lookups_of(flat_of(boxes_scene(1, glow, render))),
                 four = lookups_of(flat_of(boxes_scene(4, glow, render))),
                 sixteen = lookups_of(flat_of(boxes_scene(16, glow, render)));
    EXPECT_GT(one, 0) << render;
    EXPECT_LE(four, 2.5 * one) << render;
    EXPECT_LE(sixteen, 4.2 * four) << render;
  }
}

// Shadow rays ask all media, from places that all media share.
TEST(Overlap, LookupsOfLightGrowAsTheNumberOfMedia) {
  const auto lit = [](int count) {
    return lookups_of(flat_of(boxes_scene(count, R"("sigma_s": )" + std::to_string(1.6 / count), "{}")));
  };
  const double one = lit(1);
  for (const int count : {2, 4}) EXPECT_LE(lit(count), count * one) << count;
  // in cells as rough as these some segments still ask for themselves
  for (const int count : {8, 16}) EXPECT_LE(lit(count), 2 * count * one) << count;
}

// Glow is cut where the others are deep beside it, into 8 parts at most.
TEST(Overlap, LookupsOfGlowAreBounded) {
  const auto glow = [](const char* sigma_a) {
    return lookups_of(flat_of(boxes_scene(16, R"("sigma_s": 0, "emission": 1, "sigma_a": )" + std::string(sigma_a),
                                          R"({"in_scattering": "gauss2"})")));
  };
  const double thin = glow("0.0001"), deep = glow("0.2");
  EXPECT_GT(deep, 2 * thin);
  EXPECT_LE(deep, 17 * thin);  // two lookups of each part, where the walk alone takes one of each segment
}

}  // namespace
}  // namespace brume::test
