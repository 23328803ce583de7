// Pictures that are refined: only where finer settings make a difference, and closer after it.
#include <gtest/gtest.h>

#include <cmath>

#include "flat/flatten.hpp"
#include "pilot/refine.hpp"
#include "plan/planned_scene.hpp"
#include "render/device_scene.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

constexpr int LANES = 4;

// A small dense ball in a corner of a wide picture: most of it is empty.
SceneDesc described(double step) {
  SceneDesc desc = scene_read_text(R"({"film": {"size": [90, 66]}, "background": 0.3,
    "camera": {"type": "orthographic", "eye": [1, 0.6, 4], "target": [1, 0.6, 0], "height": 4},
    "lights": [{"type": "directional", "direction": [-0.3, -1, -0.4], "irradiance": 3}],
    "media": [{"density": {"type": "perlin", "resolution": [24, 24, 24], "scale": 3}, "bounds": [[-1, -1, -1], [1, 1, 1]],
      "sigma_a": 1, "sigma_s": 4}],
    "render": {"method": "march_midpoint"}})",
                                   "refine.json", {});
  desc.render.step = step;
  return desc;
}

struct Refined {
  double share, before, after;  // rel_rmse against the finer picture
};

Refined refined(double max_error) {
  Context context(device_choose("portable computing language"));
  LoadedScene loaded;
  SceneDesc coarse = described(0.2);
  coarse.render.max_error = max_error;
  const FlatScene flat = scene_flatten(coarse, loaded, bvh_width_for(LANES));
  const auto device = std::make_shared<DeviceScene>(context, flat);
  const auto render = [&](const SceneDesc& desc) {
    Film film(desc.film.size);
    Renderer(context, device, plan_render(desc, flat, {}), {LANES, false, 0}).render(film, [](double) { return true; });
    return film;
  };
  Film film = render(coarse);
  const SceneDesc finer = *settings_finer(coarse);
  const Film all_finer = render(finer);
  const auto off = [&] {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
      const double is = film.pixels()[i].radiance.y, should = all_finer.pixels()[i].radiance.y;
      squares += (is - should) * (is - should);
      sum += std::abs(should);
    }
    const double n = double(film.pixels().size());
    return std::sqrt(squares / n) / (sum / n);
  };
  Refined result{0, off(), 0};
  const RenderPlan plan = plan_render(finer, flat, {});
  Renderer by_finer(context, device, plan, {LANES, false, 0});
  result.share = picture_refine(by_finer, plan.frame, coarse.render, film);
  result.after = off();
  for (const FilmPixel& pixel : film.pixels()) EXPECT_EQ(pixel.samples, 1);
  return result;
}

TEST(Refine, OnlyWhereItMatters) {
  const Refined result = refined(0.002);
  EXPECT_GT(result.before, 0.002);
  EXPECT_LT(result.after, 0.001);
  EXPECT_GT(result.share, 0.1);
  EXPECT_LT(result.share, 0.5);  // the ball fills a quarter
}

TEST(Refine, NearlyNothingWhereAllIsGoodEnough) {
  const Refined result = refined(10);
  EXPECT_NEAR(result.share, 1.0 / 16, 0.06);  // probes, and slivers at the border
}

TEST(Refine, FinerUntilThereIsNothingFiner) {
  SceneDesc desc = described(0.2);
  desc.render.shadow = SHADOW_GRID;
  desc.render.light_grid = 64;
  desc.render.in_scattering = IN_SCATTERING_SEGMENT;
  const SceneDesc finer = *settings_finer(desc);
  EXPECT_EQ(finer.render.step, 0.1);
  EXPECT_EQ(finer.render.light_grid, 128);
  EXPECT_EQ(finer.render.in_scattering, IN_SCATTERING_GAUSS2);
  desc = described(1e-4);
  desc.render.in_scattering = IN_SCATTERING_GAUSS2;
  EXPECT_FALSE(settings_finer(desc));
  desc.render.method = METHOD_DDA_GAUSS2;
  desc.render.step = 0.1;
  EXPECT_FALSE(settings_finer(desc));
}

TEST(Refine, ClosestOnceNothingFinerHelps) {
  SceneDesc desc = described(1e-4);
  desc.render.method = METHOD_MARCH_MIDPOINT;
  desc.render.in_scattering = IN_SCATTERING_GAUSS2;
  const SceneDesc closest = *settings_closest(desc);
  EXPECT_EQ(closest.render.method, METHOD_AUTO);
  EXPECT_EQ(closest.render.in_scattering, IN_SCATTERING_GAUSS2);
  EXPECT_EQ(closest.render.shadow, SHADOW_TRACE);
  EXPECT_FALSE(settings_closest(closest));
  desc = closest;
  desc.render.shadow = SHADOW_GRID;
  EXPECT_TRUE(settings_closest(desc));
}

}  // namespace
}  // namespace brume
