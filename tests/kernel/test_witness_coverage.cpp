// How often the interval that a picture's witnesses give holds its true error, that of all its pixels.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "film/film_write.hpp"
#include "flat/flatten.hpp"
#include "render/device_scene.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"
#include "witness/witnesses.hpp"

namespace brume {
namespace {

using Overrides = std::vector<std::string>;

constexpr int LANES = 8, WITNESSES = 128;

const char* const SCENES[] = {"smoke",  "fire",    "lighthouse", "cloud", "ground_fog",
                              "colors", "forward", "inside",     "slab",  "voxels"};
const Overrides VIEWS[] = {{"/film/size=[32,24]", "/film/spp=1"}, {"/film/size=[24,32]", "/film/spp=2"}};
const Overrides SETTINGS[] = {
    {"/render/method=\"march_midpoint\"", "/render/step=0.04"},
    {"/render/method=\"march_regular\"", "/render/step=0.01"},
    {"/render/method=\"march_midpoint\"", "/render/step=0.02", "/render/light_grid=16", "/render/shadow=\"grid\""},
    {"/render/method=\"march_midpoint_jitter\"", "/render/step=0.03"},
    {"/render/method=\"ratio_tracking\"", "/render/shadow=\"trace\""}};

// Errors of a picture as all of its pixels and as `few` of them tell it.
struct Told {
  WitnessError all, few;
};

// What the witnesses say that are drawn among all of them.
Witnesses among(const Witnesses& all, const Image& picture, const Frame& frame, unsigned seed) {
  Witnesses few;
  few.draws = witnesses_draw(picture, frame, WITNESSES, seed);
  for (const WitnessDraw& draw : few.draws)
    few.radiance.push_back(all.radiance[std::size_t(draw.y) * std::size_t(picture.width) + std::size_t(draw.x)]);
  return few;
}

class View {
 public:
  View(Context& context, const std::string& name, const Overrides& view) : context_(context), name_(name), view_(view) {
    static_cast<FlatScene&>(scene_) = scene_flatten(described(SETTINGS[0]), loaded_, bvh_width_for(LANES));
    static_cast<RenderPlan&>(scene_) = plan_render(described(SETTINGS[0]), scene_, {});
    const ivec2 size{scene_.frame.camera.width, scene_.frame.camera.height};
    const int pixels = size.x * size.y;
    WitnessOptions options;
    options.least = pixels;
    all_ = witnesses_ask(scene_, witnesses_draw(film_image(Film(size)), scene_.frame, pixels, 1), options);
    device_ = std::make_shared<DeviceScene>(context_, scene_);
  }

  Told tell(const Overrides& setting, unsigned seed) {
    const RenderPlan plan = plan_render(described(setting), scene_, {});
    Renderer renderer(context_, device_, plan, {LANES, true, 0});
    Film film({plan.frame.camera.width, plan.frame.camera.height});
    EXPECT_TRUE(renderer.render(film, [](double) { return true; }));
    const Image picture = film_image(film);
    const Witnesses few = among(all_, picture, plan.frame, seed);
    return {witnesses_compare(all_, plan.frame, picture), witnesses_compare(few, plan.frame, picture)};
  }

 private:
  SceneDesc described(const Overrides& setting) const {
    Overrides all = view_;
    all.insert(all.end(), setting.begin(), setting.end());
    return scene_read(std::string(BRUME_SOURCE_DIR) + "/scenes/" + name_ + ".json", all);
  }

  Context& context_;
  std::string name_;
  Overrides view_;
  LoadedScene loaded_;
  PlannedScene scene_;
  Witnesses all_;
  std::shared_ptr<DeviceScene> device_;
};

TEST(WitnessCoverage, LongIntervalsHoldTheTrueErrorIn90Of100Pictures) {
  Context context(device_choose("portable computing language"));
  int cases = 0, held = 0;
  for (const char* name : SCENES)
    for (const Overrides& overrides : VIEWS) {
      View view(context, name, overrides);
      for (const Overrides& setting : SETTINGS) {
        const Told told = view.tell(setting, 5000u + static_cast<unsigned>(cases));
        const bool holds = told.few.interval[0] <= told.all.rel_rmse && told.all.rel_rmse <= told.few.interval[1];
        std::printf("%-10s %-50s true %.3g told %.3g, %.3g to %.3g%s\n", name, setting[0].c_str(), told.all.rel_rmse,
                    told.few.rel_rmse, told.few.interval[0], told.few.interval[1], holds ? "" : "  MISSED");
        ++cases;
        held += holds;
      }
    }
  std::printf("%d of %d\n", held, cases);
  EXPECT_GE(cases, 100);
  EXPECT_GE(held * 100, 90 * cases);
}

}  // namespace
}  // namespace brume
