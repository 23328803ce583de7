// Kernels that know one thing of a scene, or two, and nothing else of it: every option builds at every value, and what
// it leaves out is missed by no picture. That all of them together are right is what the other tests say.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "check/check_images.hpp"
#include "check/check_parts.hpp"
#include "cl/program.hpp"
#include "render/device_scene.hpp"
#include "render/kernel_options.hpp"
#include "render/passes.hpp"

namespace brume {
namespace {

constexpr int LANES = 4, SIZE = 16;

Context& context() {
  static Context one(device_choose("portable computing language"));
  return one;
}

// One thing that kernels are told.
struct Told {
  std::string name;
  unsigned value;
  std::string text() const { return option_text(name.c_str(), value); }
};
using Tolds = std::vector<Told>;

std::string text_of(const Tolds& tolds) {
  std::string text;
  for (const Told& told : tolds) text += told.text();
  return text;
}

// Every value of the options of a scene: each number, and of bits none and each alone.
Tolds scene_values() {
  Tolds all;
  const PlannedScene scene = check_scene("empty", SIZE, bvh_width_for(LANES));
  for (const KernelOption& option : scene_kernel_options(scene, scene)) {
    const bool is_bits = std::string(option.name).find("_USED") != std::string::npos;
    all.push_back({option.name, 0});
    for (unsigned value = 1; value <= option.generic; value = is_bits ? 2 * value : value + 1)
      all.push_back({option.name, value});
  }
  return all;
}

Tolds device_values() {
  return {{"LANES", 1},    {"LANES", 4},   {"LANES", 8},   {"LANES", 16},  {"BVH_WIDTH", 4}, {"FAST_FMA", 0},
          {"FAST_FMA", 1}, {"OUTLINE", 0}, {"OUTLINE", 1}, {"STORAGE", 0}, {"STORAGE", 1},   {"STORAGE", 2}};
}

void expect_builds(const Tolds& tolds) {
  static const std::string source = [] {
    std::string text;
    for (const char* pass : {"presence_gradients", "light_grid", "primary_rays", "traverse_dda", "shadow_transmittance",
                             "shade", "secondary_rays", "accumulate"})
      text += std::string("#include \"passes/") + pass + ".cl\"\n";
    return kernel_source_text(text, "all passes");
  }();
  EXPECT_NO_THROW(program_build(context(), source, text_of(tolds))) << text_of(tolds);
}

TEST(KernelOptions, LongEveryValueBuildsAloneAndInRandomPairs) {
  Tolds all = scene_values();
  const Tolds device = device_values();
  all.insert(all.end(), device.begin(), device.end());
  EXPECT_GT(all.size(), 50u);
  for (const Told& told : all) expect_builds({told});
  std::mt19937 random(3);
  for (int i = 0; i < 16; ++i) {
    const Told &a = all[random() % all.size()], &b = all[random() % all.size()];
    if (a.name != b.name) expect_builds({a, b});
  }
}

// A scene rendered by kernels that are told some of what is known of it.
class Pictures {
 public:
  explicit Pictures(const std::string& name)
      : name_(name),
        scene_(check_scene(name, SIZE, bvh_width_for(LANES))),
        device_(std::make_shared<DeviceScene>(context(), scene_)),
        generic_({0, 0}) {}

  // Options that leave something out of the kernels of this scene.
  Tolds narrowed() const {
    Tolds all;
    for (const KernelOption& option : scene_kernel_options(scene_, scene_))
      if (option.value != option.generic) all.push_back({option.name, option.value});
    return all;
  }

  void expect_same(const Tolds& tolds) {
    if (generic_.pixels().empty()) generic_ = picture({});
    const CheckRow row = film_check(name_, LANES, picture(tolds), generic_);
    EXPECT_TRUE(row.passed()) << name_ << text_of(tolds) << ": " << row.max_error << ", " << row.edges << " edges";
  }

 private:
  Film picture(const Tolds& tolds) const {
    const bool grey = std::any_of(tolds.begin(), tolds.end(), [](const Told& t) { return t.name == "COLOR_TAU"; });
    const WorkList work = work_all(scene_.frame);
    const auto rays = static_cast<std::size_t>(SIZE) * SIZE * static_cast<std::size_t>(scene_.frame.camera.spp);
    Passes passes(context(), device_, scene_,
                  kernel_options(scene_, scene_, context().device(), LANES, true) + text_of(tolds), grey ? 1 : 3, rays);
    passes.fill_light_grids([](double) { return true; });
    Film film({SIZE, SIZE});
    WorkQueue queue(work, film.pixels().size());
    for (std::size_t take = rays; !queue.next(take).empty();) {
      const std::vector<Work>& batch = queue.next(take);
      const auto fill = [&](FilmPixel* pixels) {
        for (const Work& entry : batch) *pixels++ = film.pixels()[entry.pixel];
      };
      const auto keep = [&](const FilmPixel* pixels) {
        for (const Work& entry : batch) film.pixels()[entry.pixel] = *pixels++;
      };
      if (passes.run(batch, fill, keep))
        queue.done();
      else
        take /= 2;  // too many rays were sent on
    }
    return film;
  }

  std::string name_;
  PlannedScene scene_;
  std::shared_ptr<DeviceScene> device_;
  Film generic_;
};

// Each option alone on a scene that it leaves something out of, pairs on random ones.
TEST(KernelOptions, LongWhatIsLeftOutAloneAndInRandomPairsIsMissedByNoPicture) {
  std::vector<std::unique_ptr<Pictures>> scenes;
  for (const std::string& name : check_scene_names()) scenes.push_back(std::make_unique<Pictures>(name));
  std::mt19937 random(4);
  const PlannedScene any = check_scene("empty", SIZE, bvh_width_for(LANES));
  for (const KernelOption& option : scene_kernel_options(any, any)) {
    std::shuffle(scenes.begin(), scenes.end(), random);
    int walked = 0;
    for (const auto& scene : scenes)
      for (const Told& told : scene->narrowed())
        if (told.name == option.name && walked < 1) scene->expect_same({told}), ++walked;
    EXPECT_EQ(walked, 1) << option.name;
  }
  for (int pair = 0; pair < 12; ++pair) {
    Pictures& scene = *scenes[random() % scenes.size()];
    Tolds tolds = scene.narrowed();
    std::shuffle(tolds.begin(), tolds.end(), random);
    ASSERT_GE(tolds.size(), 2u);
    tolds.resize(2);
    scene.expect_same(tolds);
  }
}

}  // namespace
}  // namespace brume
