// Phase functions of the kernels: ∫p = 1 and mean cosine = g, by quadrature over the sphere.
#include <cmath>

#include "check/check.hpp"
#include "check/check_parts.hpp"
#include "physics/closed_form.hpp"
#include "reference/quadrature.hpp"
#include "scene/families.hpp"

namespace brume::test {
namespace {

struct Moments {
  double norm, cosine;
};

// θ = π x^3 (or mirrored): nodes crowd where the lobe is. 2π ∫ p(θ) sinθ dθ with Gauss-Legendre on 64 pieces.
Moments phase_moments(int phase, double g, int lanes) {
  const PlannedScene scene = check_scene("surfaces", 8, bvh_width_for(lanes));
  std::vector<float> in;
  std::vector<double> weights, cosines;
  const auto nodes = reference::gauss_legendre(8);
  constexpr int PIECES = 64;
  for (int piece = 0; piece < PIECES; ++piece)
    for (const auto& node : nodes) {
      const double x = (piece + node.x) / PIECES;
      const double away = M_PI * x * x * x;
      const double theta = g < 0 ? M_PI - away : away;
      for (const float v : {bits_as_float(phase), static_cast<float>(g), 0.0f, 0.0f, 1.0f,
                            static_cast<float>(std::sin(theta)), 0.0f, static_cast<float>(std::cos(theta))})
        in.push_back(v);
      weights.push_back(2 * M_PI * std::sin(theta) * 3 * M_PI * x * x * node.weight / PIECES);
      cosines.push_back(std::cos(theta));
    }
  const std::vector<float> p = Probe(pocl(), scene, lanes).run("probe_phase", in, 8, 1);
  Moments m{0, 0};
  for (std::size_t i = 0; i < p.size(); ++i) {
    m.norm += weights[i] * p[i];
    m.cosine += weights[i] * p[i] * cosines[i];
  }
  return m;
}

TEST(Phase, IntegratesToOneWithMeanCosineG) {
  for (const int lanes : {1, 4, 8, 16}) {
    const Moments isotropic = phase_moments(PHASE_ISOTROPIC, 0, lanes);
    EXPECT_NEAR(isotropic.norm, 1, KERNEL_LIMIT);
    EXPECT_NEAR(isotropic.cosine, 0, KERNEL_LIMIT);
    for (const double g : {-0.99, -0.9, -0.65, -0.25, 0.0, 0.25, 0.65, 0.9, 0.99}) {
      const Moments m = phase_moments(PHASE_HENYEY_GREENSTEIN, g, lanes);
      EXPECT_NEAR(m.norm, 1, KERNEL_LIMIT) << "g = " << g;
      EXPECT_NEAR(m.cosine, static_cast<float>(g), KERNEL_LIMIT) << "g = " << g;
    }
  }
}

TEST(Phase, EveryRowIntegratesToOne) {
  for (const FamilyRow& row : phase_family())
    EXPECT_NEAR(phase_moments(row.id, phase_takes_g(row.id) ? 0.5 : 0, 8).norm, 1, KERNEL_LIMIT) << row.name;
}

}  // namespace
}  // namespace brume::test
