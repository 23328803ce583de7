// Several plans of one scene: what they share, and that each is the picture that it would be alone.
#include <gtest/gtest.h>

#include "check/check_images.hpp"
#include "flat/flatten.hpp"
#include "plan/planned_scene.hpp"
#include "render/device_scene.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"

namespace brume {
namespace {

constexpr int LANES = 4;

SceneDesc described(const std::string& render) {
  return scene_read_text(R"({"film": {"size": [24, 16]}, "camera": {"eye": [1, 1, 4]},
    "lights": [{"type": "directional", "direction": [-0.3, -1, -0.4], "irradiance": [3, 2, 1]}],
    "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.4}],
    "media": [{"density": {"type": "perlin", "resolution": [40, 40, 40], "scale": 3}, "sigma_a": 0.2, "sigma_s": 0.8}],
    "render": {)" + render + "}}",
                         "plans.json", {});
}

double items_of(const Renderer& renderer, const std::string& name) {
  for (const PassStats& pass : renderer.stats().passes)
    if (pass.name == name) return pass.items;
  return 0;
}

Film rendered(Renderer&& renderer, const RenderPlan& plan) {
  Film film({plan.frame.camera.width, plan.frame.camera.height});
  EXPECT_TRUE(renderer.render(film, [](double) { return true; }));
  return film;
}

TEST(Plans, ShareASceneAndAreThePicturesThatTheyAreAlone) {
  Context context(device_choose("portable computing language"));
  LoadedScene loaded;
  const FlatScene flat = scene_flatten(described(""), loaded, bvh_width_for(LANES));
  const auto device = std::make_shared<DeviceScene>(context, flat);
  const char* plans[] = {R"("method": "dda_gauss2")",
                         R"("method": "dda_gauss2", "seed": 5)",
                         R"("method": "march_midpoint", "step": 0.1, "shadow": "grid", "light_grid": 8)",
                         R"("method": "ratio_tracking")",
                         R"("method": "dda_midpoint", "storage": "f16")",
                         R"("method": "dda_midpoint", "storage": "u8")",
                         R"("method": "residual_ratio", "storage": "f16")"};
  for (const char* render : plans) {
    const SceneDesc desc = described(render);
    const RenderPlan plan = plan_render(desc, flat, {});
    const Film shared = rendered(Renderer(context, device, plan, {LANES, false, 0}), plan);
    const Film alone = render_film(context, flatten(desc, {bvh_width_for(LANES), {}}), LANES);
    for (std::size_t i = 0; i < alone.pixels().size(); ++i) {
      ASSERT_EQ(shared.pixels()[i].radiance.y, alone.pixels()[i].radiance.y) << render;
      ASSERT_EQ(shared.pixels()[i].lookups, alone.pixels()[i].lookups) << render;
    }
  }
}

// What is shared is neither uploaded nor built again.
TEST(Plans, TakeOnlyWhatIsTheirOwn) {
  Context context(device_choose("portable computing language"));
  LoadedScene loaded;
  const FlatScene flat = scene_flatten(described(""), loaded, bvh_width_for(LANES));
  const auto device = std::make_shared<DeviceScene>(context, flat);
  const RenderPlan one = plan_render(described(""), flat, {}), two = plan_render(described(R"("seed": 3)"), flat, {});
  const Renderer first(context, device, one, {LANES, false, 0});
  const std::size_t bytes = context.allocated_bytes(), programs = context.programs().size();
  ASSERT_GT(flat.voxels.size() * sizeof(float), 400000u);
  const Renderer second(context, device, two, {LANES, false, 0});
  EXPECT_LT(context.allocated_bytes() - bytes, 400000u);
  EXPECT_EQ(context.programs().size(), programs);
  EXPECT_EQ(loaded.costs().size(), 1u);
}

// Gradients of liquids are those of the scene, in each storage: the first plan computes them for all.
TEST(Plans, ComputeGradientsOnce) {
  Context context(device_choose("portable computing language"));
  const auto water = [](const std::string& render) {
    return scene_read_text(R"({"film": {"size": [24, 16]}, "camera": {"eye": [1, 1, 4]},
      "lights": [{"type": "directional", "direction": [-0.3, -1, -0.4], "irradiance": 9}],
      "media": [{"type": "liquid", "density": {"type": "ball"}, "sigma_a": 1}], "render": {)" +
                               render + "}}",
                           "water.json", {});
  };
  LoadedScene loaded;
  const FlatScene flat = scene_flatten(water(""), loaded, bvh_width_for(LANES));
  const auto device = std::make_shared<DeviceScene>(context, flat);
  for (const char* storage : {"f32", "f16", "u8"})
    for (const char* step : {"0.05", "0.02"}) {
      const SceneDesc desc = water(std::string(R"("storage": ")") + storage + R"(", "step": )" + step);
      const RenderPlan plan = plan_render(desc, flat, {});
      Renderer renderer(context, device, plan, {LANES, false, 0});
      Film shared({24, 16});
      EXPECT_TRUE(renderer.render(shared, [](double) { return true; }));
      EXPECT_EQ(items_of(renderer, "presence_gradients") > 0, step == std::string("0.05")) << storage;
      const Film alone = render_film(context, flatten(desc, {bvh_width_for(LANES), {}}), LANES);
      for (std::size_t i = 0; i < alone.pixels().size(); ++i)
        ASSERT_EQ(shared.pixels()[i].radiance.y, alone.pixels()[i].radiance.y) << storage << " " << step;
    }
}

// What a light grid holds depends on the plan alone: a second render, and one that goes on, find it filled.
TEST(Plans, FillTheirLightGridsOnce) {
  Context context(device_choose("portable computing language"));
  const PlannedScene scene =
      flatten(described(R"("shadow": "grid", "light_grid": 16)"), {bvh_width_for(LANES), {}, false});
  Renderer renderer(context, scene, {LANES, false, 0});
  const auto points = [&] { return items_of(renderer, "light_grid"); };
  double all = 0;
  for (const LightGrid& grid : scene.light_grids)
    all += double(grid.columns_u) * grid.columns_v * (grid.column_step > 0 ? 1 : grid.nk);
  Film stopped({24, 16}), first({24, 16}), second({24, 16});
  EXPECT_FALSE(renderer.render(stopped, [](double) { return false; }));
  EXPECT_GT(points(), 0);
  EXPECT_LT(points(), all);
  EXPECT_TRUE(renderer.render(first, [](double) { return true; }));
  EXPECT_EQ(points(), all);
  EXPECT_TRUE(renderer.render(second, [](double) { return true; }));
  EXPECT_EQ(points(), all);
  const Film alone = render_film(context, scene, LANES);
  for (std::size_t i = 0; i < alone.pixels().size(); ++i) {
    ASSERT_EQ(first.pixels()[i].radiance.y, alone.pixels()[i].radiance.y);
    ASSERT_EQ(second.pixels()[i].radiance.y, alone.pixels()[i].radiance.y);
  }
}

}  // namespace
}  // namespace brume
