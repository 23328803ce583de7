// How the errors of methods fall as their knobs are turned, as charts fit it: fog that thins out smoothly, lit from one
// side, against the picture of steps so fine that its own error is not seen. So thin that no step is a dense segment,
// which are cut and would fall in jumps; and it fills the picture.
#include "chart/analysis.hpp"
#include "chart/chart_scene.hpp"
#include "closed_form.hpp"
#include "film/film_compare.hpp"

namespace brume::test {
namespace {

const char* const FOG = R"({"film": {"size": [24, 18]}, "camera": {"eye": [1.5, 1.2, 3], "vfov": 18},
  "lights": [{"type": "directional", "direction": [1, -1, -0.5], "irradiance": 5}],
  "media": [{"density": {"type": "exponential", "resolution": [64, 64, 64]}, "sigma_a": 0.05, "sigma_s": 0.15}]})";

Image rendered(ChartScene& scene, const SceneDesc& set) {
  const auto picture = scene.render_once(set, [](double) { return true; });
  EXPECT_TRUE(picture.has_value());
  return picture->image;
}

std::vector<ChartOrder> fitted(ChartScene& scene, const std::vector<Knobs>& list) {
  std::map<int, Image> exact;  // by samples per pixel
  std::vector<ChartPoint> points;
  for (const Knobs& knobs : list) {
    if (!exact.count(knobs.spp))
      exact[knobs.spp] = rendered(scene, exact_desc_fine(scene.desc(), knobs.spp, scene.limits()));
    ChartPoint point;
    point.knobs = knobs;
    point.rel_rmse = image_compare(rendered(scene, knobs_apply(scene.desc(), knobs)), exact[knobs.spp]).rel_rmse;
    points.push_back(point);
  }
  return orders_fit(points, 1e-6);
}

TEST(Orders, AreThoseThatTheoryExpects) {
  const SceneDesc desc = scene_read_text(FOG, "orders.json", {});
  LoadedScene loaded;
  constexpr int LANES = 8;
  ChartScene scene(desc, loaded, pocl(), {LANES, false, {}});
  std::vector<Knobs> list;
  for (const int method : methods_fitting(desc, {})) {
    const auto expected = order_expected(method);
    if (!expected) continue;
    for (const double step : {1.0 / 8, 1.0 / 16, 1.0 / 32})
      if (method_has_step(method)) list.push_back({method, step});
    for (const int spp : {1, 4, 16})
      if (method_tracks(method)) list.push_back({method, 0, 0, STORAGE_F32, IN_SCATTERING_SEGMENT, spp});
  }
  const std::vector<ChartOrder> orders = fitted(scene, list);
  EXPECT_EQ(orders.size(), 7u);
  for (const ChartOrder& order : orders) {
    // Drawn places and collisions make an error of a few hundred pixels that is random itself, by some per cent.
    const double band = order.expected == 1.5 ? 0.3 : order.expected < 0 ? 0.06 : 0.15;
    EXPECT_NEAR(order.fitted, order.expected, band) << order.method << " by " << order.knob;
  }
}

// Of a cloud: the fog is so smooth that one piece a brick errs by less than most tolerances.
TEST(Orders, AdaptiveFollowsItsTolerance) {
  const SceneDesc desc = scene_read_text(
      R"({"film": {"size": [24, 18]}, "camera": {"eye": [1.5, 1.2, 3], "vfov": 36},
      "lights": [{"type": "directional", "direction": [1, -1, -0.5], "irradiance": 5}],
      "media": [{"density": {"type": "perlin", "resolution": [64, 64, 64], "scale": 8, "octaves": 3},
                 "sigma_a": 0.5, "sigma_s": 1.5}]})",
      "cloud.json", {});
  LoadedScene loaded;
  ChartScene scene(desc, loaded, pocl(), {8, false, {}});
  std::vector<Knobs> list;
  for (const double tolerance : {1e-1, 1e-2, 1e-3})
    list.push_back({METHOD_ADAPTIVE, 0, 0, STORAGE_F32, IN_SCATTERING_SEGMENT, 1, tolerance});
  const std::vector<ChartOrder> orders = fitted(scene, list);
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].knob, "tolerance");
  // Bricks go over to more pieces one by one, and then to cells: no straight line.
  EXPECT_NEAR(orders[0].fitted, orders[0].expected, 0.25);
}

}  // namespace
}  // namespace brume::test
