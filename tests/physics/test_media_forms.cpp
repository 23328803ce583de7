// Closed forms of media: slab, ramp, sphere, single scattering. The derivations open the scenes.
#include <cmath>

#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

constexpr double ISOTROPIC = 1 / (4 * M_PI);

TEST(MediaForms, SlabByEveryMethodThatFits) {
  const ClosedForm form = [](const PlannedScene&, const reference::RayD&) { return std::exp(-1.5); };
  expect_closed_form("slab.json", form);
  for (const char* method : {"dda_gauss2", "dda_midpoint", "march_midpoint", "homogeneous"})
    expect_closed_form("slab.json", form, {std::string("/render/method=") + method});
  for (const char* method : {"dda_nearest", "march_midpoint"})
    expect_closed_form("slab.json", form, {std::string("/render/method=") + method, "/media/0/interpolation=nearest"});
}

TEST(MediaForms, RampAlongObliqueRays) {
  const ClosedForm form = [](const PlannedScene&, const reference::RayD& ray) {
    return std::exp(-0.875 / std::abs(ray.dir.y));
  };
  expect_closed_form("ramp.json", form, {"/render/method=dda_gauss2"});
  expect_closed_form("ramp.json", form,
                     {"/render/method=dda_midpoint"});  // the ramp is linear: the middle is exact too
}

TEST(MediaForms, SphereChord) {
  expect_closed_form("sphere_chord.json", [](const PlannedScene&, const reference::RayD& ray) {
    const double b2 = ray.origin.x * ray.origin.x + ray.origin.y * ray.origin.y;
    return std::exp(-0.5 * 2 * std::sqrt(std::max(0.0, 1 - b2)));
  });
}

TEST(MediaForms, SingleScatteringFromTheFront) {
  const ClosedForm form = [](const PlannedScene&, const reference::RayD&) {
    return 0.75 * ISOTROPIC * 8 * (1 - std::exp(-4.0)) / 2;
  };
  expect_closed_form("scatter_front.json", form, {}, 8);
}

TEST(MediaForms, SingleScatteringFromBehind) {
  const ClosedForm form = [](const PlannedScene&, const reference::RayD&) {
    return 0.75 * ISOTROPIC * 8 * 2 * std::exp(-2.0);
  };
  expect_closed_form("scatter_back.json", form, {}, 8);
}

TEST(MediaForms, ForwardLobeOfHenyeyGreenstein) {
  // From behind all light goes straight on: p(0) = (1-g²)/(4π(1-g)³), in front it turns back: p(π) = (1-g²)/(4π(1+g)³).
  const double g = 0.75, forward = (1 - g * g) / (4 * M_PI * std::pow(1 - g, 3)),
               back = (1 - g * g) / (4 * M_PI * std::pow(1 + g, 3));
  const std::string phase = R"(/media/0/phase={"type":"henyey_greenstein","g":0.75})";
  expect_closed_form(
      "scatter_back.json", [&](auto&&...) { return 0.75 * forward * 8 * 2 * std::exp(-2.0); }, {phase}, 8);
  expect_closed_form(
      "scatter_front.json", [&](auto&&...) { return 0.75 * back * 8 * (1 - std::exp(-4.0)) / 2; }, {phase}, 8);
}

TEST(MediaForms, GlowingSlabByEveryMethodThatFits) {
  const ClosedForm form = [](auto&&...) { return (1 - std::exp(-1.5)) / 0.75; };
  for (const char* method : {"dda_gauss2", "dda_midpoint", "march_regular", "march_midpoint", "march_regular_jitter",
                             "march_midpoint_jitter", "homogeneous"})
    expect_closed_form("glow.json", form, {std::string("/render/method=") + method});
  expect_closed_form("glow.json", form, {"/render/method=dda_nearest", "/media/0/interpolation=nearest"});
  expect_closed_form("glow.json", [](auto&&...) { return 2.0; }, {"/media/0/sigma_a=0"});
  expect_closed_form("glow.json", [](auto&&...) { return (1 - std::exp(-1.5)) / 0.75; },
                     {R"(/media/0/density={"type":"constant","value":0.5,"resolution":[8,8,8]})",
                      "/media/0/sigma_a=1.5", "/media/0/emission=2"});
}

TEST(MediaForms, GlowByADensityOfItsOwn) {
  const double s = 0.75;
  const auto glow = [](const reference::RayD& ray) { return 1 - (ray.origin.y + 1) / 2; };
  const double whole = (1 - std::exp(-2 * s)) / s;
  const ClosedForm form = [&](const PlannedScene&, const reference::RayD& ray) { return glow(ray) * whole; };
  expect_closed_form("glow_own.json", form, {"/render/method=dda_gauss2"});
  expect_closed_form("glow_own.json", form, {"/render/method=march_midpoint", "/render/step=0.0025"});
  const PlannedScene scene = scene_flat("glow_own.json", {"/render/method=dda_gauss2"}, 4);
  const reference::RayD ray = reference::camera_ray(scene.frame.camera, 1, 0, {0.5, 0.5});
  expect_relative(reference::ray_render(reference::Context(scene, {8, 1}), ray).radiance.y, glow(ray) * whole,
                  REFERENCE_LIMIT, "glow_own.json, exact");
}

}  // namespace
}  // namespace brume::test
