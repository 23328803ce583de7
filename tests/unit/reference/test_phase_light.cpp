// Phase functions and lights of the reference against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/light.hpp"
#include "reference/phase.hpp"
#include "reference/quadrature.hpp"
#include "unit/plan/flat_scene_builder.hpp"

namespace brume::reference {
namespace {

// ∫ p cos^k dω = 2π ∫ p c^k dc. With the peak at c = ±1, a = 1 ∓ c = δ(e^s - 1), δ = (1-|g|)², makes the integrand
// smooth in s.
double phase_moment(double g, int power) {
  const double delta = (1 - std::abs(g)) * (1 - std::abs(g)) + 1e-3, reach = std::log1p(2 / delta);
  double sum = 0;
  for (const QuadratureNode& node : gauss_legendre(120)) {
    const double a = delta * std::expm1(node.x * reach), da = delta * std::exp(node.x * reach) * reach;
    const double cosine = g >= 0 ? 1 - a : a - 1;
    sum += node.weight * da * phase_eval(PHASE_HENYEY_GREENSTEIN, g, cosine) * std::pow(cosine, power);
  }
  return 2 * PI * sum;
}

TEST(ReferencePhase, IntegratesToOneWithMeanCosineG) {
  for (const double g : {-0.99, -0.9, -0.5, -0.01, 0.0, 0.01, 0.3, 0.65, 0.9, 0.99}) {
    EXPECT_NEAR(phase_moment(g, 0), 1, 1e-11) << g;
    EXPECT_NEAR(phase_moment(g, 1), g, 1e-11) << g;
  }
}

TEST(ReferencePhase, ValuesBySign) {
  EXPECT_NEAR(phase_eval(PHASE_ISOTROPIC, 0.7, -0.3), 1 / (4 * PI), 1e-16);
  // g = 1/2: forward (3/4)/(4π/8) = 3/(2π), backward (3/4)/(4π·27/8) = 1/(18π)
  EXPECT_NEAR(phase_eval(PHASE_HENYEY_GREENSTEIN, 0.5, 1), 3 / (2 * PI), 1e-15);
  EXPECT_NEAR(phase_eval(PHASE_HENYEY_GREENSTEIN, 0.5, -1), 1 / (18 * PI), 1e-16);
  EXPECT_NEAR(phase_eval(PHASE_HENYEY_GREENSTEIN, -0.5, -1), 3 / (2 * PI), 1e-15);
}

TEST(ReferencePhase, NoCancellationAtThePeak) {
  const double gap = 0x1p-20, g = 1 - gap;  // p(1) = (1+g)/(4π gap²), p(-1) = gap/(4π (1+g)²)
  EXPECT_NEAR(phase_eval(PHASE_HENYEY_GREENSTEIN, g, 1) / ((1 + g) / (4 * PI * gap * gap)), 1, 1e-14);
  EXPECT_NEAR(phase_eval(PHASE_HENYEY_GREENSTEIN, -g, 1) / (gap / (4 * PI * (1 + g) * (1 + g))), 1, 1e-14);
}

TEST(ReferenceLight, PointFallsOffWithTheSquareUnlessToldNot) {
  PlannedScene scene;
  Light& light = test::light_add_point(scene, {1, 2, 3}, 8);
  const LightSample sample = light_at(scene, light, {1, 2, -1}, {});
  EXPECT_EQ(sample.travel, dvec3(0, 0, -1));
  EXPECT_EQ(sample.distance, 4);
  EXPECT_EQ(sample.irradiance, dvec3(0.5));
  light.falloff = FALLOFF_NONE;
  EXPECT_EQ(light_at(scene, light, {1, 2, -1}, {}).irradiance, dvec3(8));
  EXPECT_EQ(light_at(scene, light, {1, 2, 3}, {}).irradiance, dvec3(0));  // at the light itself
}

TEST(ReferenceLight, DirectionalIsMadeUnit) {
  PlannedScene scene;
  test::light_add_directional(scene, {0, -3, 4}, 2);
  const LightSample sample = light_at(scene, scene.lights[0], {100, 5, 7}, {});
  EXPECT_NEAR(glm::distance(sample.travel, dvec3(0, -0.6, 0.8)), 0, 1e-15);
  EXPECT_EQ(sample.irradiance, dvec3(2));
  EXPECT_EQ(sample.distance, INFINITE);
}

TEST(ReferenceLight, SpotFadesBySmoothstepInTheCosine) {
  PlannedScene scene;
  Light& light = test::light_add_point(scene, {0, 0, 0}, 1);
  light.type = LIGHT_SPOT;
  light.falloff = FALLOFF_NONE;
  light.direction = test::packed(0, 0, -1);
  light.outer = 0.5f;
  light.inner = 0.25f;
  const auto share = [&](double cosine) {
    return light_at(scene, light, 7.0 * dvec3(std::sqrt(1 - cosine * cosine), 0, -cosine), {}).irradiance.x;
  };
  EXPECT_EQ(share(0.499), 0);
  EXPECT_EQ(share(-1), 0);
  EXPECT_EQ(share(0.751), 1);
  EXPECT_NEAR(share(0.625), 0.5, 1e-14);
  EXPECT_NEAR(share(0.5625), 0.15625, 1e-14);  // x = 1/4: (1/16)(5/2)
  light.inner = 0.5f;                          // a hard edge
  EXPECT_EQ(share(0.501), 1);
  EXPECT_EQ(share(0.499), 0);
}

}  // namespace
}  // namespace brume::reference
