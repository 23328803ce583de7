// ∫ σs ρ T S dt with several media at once: within an interval every density is one polynomial, so all that is left to
// quadrature is the smooth product.
#include "reference/scatter_exact.hpp"

#include <algorithm>
#include <cmath>

#include "reference/glass.hpp"
#include "reference/liquid.hpp"
#include "reference/lit_steps.hpp"
#include "reference/phase.hpp"

namespace brume::reference {
namespace {

// The part of one medium that an interval lies in.
struct Piece {
  const Medium* medium;
  RayD ray;  // in the medium's cell space
  ivec3 cell;

  double density(const PlannedScene& scene, double t) const {
    const double density = density_in_cell(scene, *medium, cell, ray.at(t));
    const bool counts =
        medium->liquid < 0 || density >= scene.liquids[static_cast<std::size_t>(medium->liquid)].outside;
    return counts ? density : 0;
  }
  // ∫ρ over [a, b]: 2-point Gauss is exact for the cubic of a trilinear cell
  double density_length(const PlannedScene& scene, double a, double b) const {
    const double middle = 0.5 * (a + b), apart = (b - a) / (2 * std::sqrt(3.0));
    return (b - a) / 2 * (density(scene, middle - apart) + density(scene, middle + apart));
  }
};

// Which lights shine on a point, whatever the media leave of them.
std::vector<bool> lit_at(const Context& context, const dvec3& point, const RandomStream& random) {
  std::vector<bool> lit;
  for (const Light& light : context.scene.lights) lit.push_back(light_shines(context, light, point, random));
  return lit;
}

constexpr int LIT_SAMPLES = 256;  // along a ray; a shadow that lies between two of them is not seen
constexpr int LIT_HALVINGS = 32;

// Adds where along [t0, t1] a light begins or ends to shine: edges of shadows and cones, over which no quadrature goes.
void lit_borders(const Context& context, const RayD& ray, const RandomStream& random, double t0, double t1,
                 std::vector<double>& borders) {
  const bool cones = std::any_of(context.scene.lights.begin(), context.scene.lights.end(),
                                 [](const Light& light) { return light.type == LIGHT_SPOT; });
  if (context.scene.shapes.empty() && context.scene.triangles.empty() && !cones) return;
  double before = t0;
  std::vector<bool> lit = lit_at(context, ray.at(t0), random);
  for (int i = 1; i <= LIT_SAMPLES; ++i) {
    const double after = t0 + (t1 - t0) * i / LIT_SAMPLES;
    std::vector<bool> next = lit_at(context, ray.at(after), random);
    if (next != lit) {
      double lo = before, hi = after;
      for (int halving = 0; halving < LIT_HALVINGS; ++halving) {
        const double middle = 0.5 * (lo + hi);
        (lit_at(context, ray.at(middle), random) == lit ? lo : hi) = middle;
      }
      borders.push_back(hi);
    }
    lit = std::move(next);
    before = after;
  }
}

constexpr std::size_t LIGHTS_NEAR = 16;  // lights further off than so many others change little over a cell
constexpr double NEAREST = 0x1p-20;      // of the way: a light that the ray passes closer is not told from one on it

// Adds the place next to each light that is somewhere, and from there on places twice as far off each time: the light
// falls as 1 / (d² + s²) along the ray, which is smooth over no length above its distance.
void light_borders(const Context& context, const RayD& ray, double t0, double t1, std::vector<double>& borders) {
  std::vector<std::pair<double, double>> near;  // distance, t
  for (const Light& light : context.scene.lights) {
    if (light.type == LIGHT_DIRECTIONAL || light.exponent != 0) continue;
    const dvec3 position = vec_promote(light.position);
    const double t = glm::dot(position - ray.origin, ray.dir);
    near.emplace_back(std::max(glm::length(ray.at(t) - position), NEAREST * (t1 - t0)), t);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), LIGHTS_NEAR));
  const auto add = [&](double t) {
    if (t > t0 && t < t1) borders.push_back(t);
  };
  for (const Light& light : context.scene.lights)
    if (light.type == LIGHT_SPOT && light.exponent == 0 && context.scene.lights.size() <= LIGHTS_NEAR)
      for (const double t : spot_cones(light, ray)) add(t);
  for (const auto& [distance, t] : near) {
    add(t);
    for (double s = 0.5 * distance; s < std::max(t1 - t, t - t0); s *= 2) {
      add(t - s);
      add(t + s);
    }
  }
}

std::vector<double> borders_of_all(const Context& context, const RayD& ray, double t_max, const RandomStream& random) {
  std::vector<double> borders;
  for (int i = 0; i < static_cast<int>(context.media.size()); ++i) {
    const Medium& medium = context.media[static_cast<std::size_t>(i)];
    for (const SegmentD& segment : segments(context.scene, i, ray, 0, t_max, method_exact(medium))) {
      borders.push_back(segment.t_begin);
      borders.push_back(segment.t_end);
    }
    for (const LightKink& kink : light_kinks(context, i, ray, t_max)) borders.push_back(kink.t);
  }
  if (borders.empty()) return borders;
  const auto ends = std::minmax_element(borders.begin(), borders.end());
  const double first = *ends.first, last = *ends.second;
  lit_borders(context, ray, random, first, last, borders);
  light_borders(context, ray, first, last, borders);
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  return borders;
}

void pieces_at(const Context& context, const RayD& ray, double t_max, double middle, std::vector<Piece>& pieces) {
  pieces.clear();
  for (const Medium& medium : context.media) {
    const Interval span = medium_interval(medium, ray, 0, t_max);
    if (!(middle > span.t0 && middle < span.t1)) continue;
    const RayD in_cells = ray_to_cells(medium, ray);
    pieces.push_back({&medium, in_cells, cell_at(medium, in_cells.at(middle))});
  }
}

// Σ_media σs ρ S at one t.
dvec3 source_of_all(const Context& context, const RayD& ray, const std::vector<Piece>& pieces, double t,
                    const RandomStream& random, Scattered& result) {
  dvec3 source(0);
  const dvec3 point = ray.at(t);
  for (const Piece& piece : pieces) source += vec_promote(piece.medium->emission) * piece.density(context.scene, t);
  for (std::size_t i = 0; i < context.scene.lights.size(); ++i) {
    const Arrival arrival = light_arrival(context, i, point, point, random, {}, result.lookups);
    const double cosine = glm::dot(arrival.light.travel, -ray.dir);
    for (const Piece& piece : pieces)
      source += vec_promote(piece.medium->sigma_s) * arrival.irradiance *
                (piece.density(context.scene, t) * phase_eval(piece.medium->phase, piece.medium->g, cosine));
  }
  return source;
}

dvec3 pieces_tau(const Context& context, const std::vector<Piece>& pieces, double a, double b) {
  dvec3 tau(0);
  for (const Piece& piece : pieces) tau += sigma_t_of(*piece.medium) * piece.density_length(context.scene, a, b);
  return tau;
}

constexpr double TAU_BLACK_D = 60;  // e^-60 of the light behind is no part of a sum in double

// An interval in parts of at most unit optical depth, so that a few nodes see exp(-τ) as the smooth function it is.
// Channels that are black before count for nothing.
double parts_of(const dvec3& before, const dvec3& tau) {
  double deepest = 0;
  for (int c = 0; c < 3; ++c)
    if (before[c] <= TAU_BLACK_D) deepest = std::max(deepest, tau[c]);
  return std::clamp(std::ceil(deepest), 1.0, 4096.0);
}

// Adds what the pieces scatter and emit over [a, b] and moves result.tau past it.
void interval_scatter(const Context& context, const RayD& ray, const std::vector<Piece>& pieces, double a, double b,
                      const RandomStream& random, Scattered& result) {
  for (const QuadratureNode& node : context.nodes) {
    const double t = a + (b - a) * node.x;
    const dvec3 transmittance = transmittance_of(result.tau + pieces_tau(context, pieces, a, t));
    result.radiance += (node.weight * (b - a)) * transmittance * source_of_all(context, ray, pieces, t, random, result);
  }
  result.tau += pieces_tau(context, pieces, a, b);
}

}  // namespace

Scattered media_scatter_exact(const Context& context, const RayD& ray, double t_max, const RandomStream& random) {
  Scattered result;
  for (int i = 0; i < static_cast<int>(context.media.size()); ++i)
    if (context.media[static_cast<std::size_t>(i)].liquid >= 0) liquid_scatter(context, i, ray, t_max, random, result);
  result.tau = dvec3(0);  // of all media together from here on
  const std::vector<double> borders = borders_of_all(context, ray, t_max, random);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double a = borders[i], b = borders[i + 1];
    pieces_at(context, ray, t_max, 0.5 * (a + b), pieces);
    if (pieces.empty()) continue;
    const double parts = parts_of(result.tau, pieces_tau(context, pieces, a, b));
    for (double part = 0; part < parts; ++part) {
      if (std::min({result.tau.x, result.tau.y, result.tau.z}) > TAU_BLACK_D) return result;
      interval_scatter(context, ray, pieces, a + (b - a) * (part / parts), a + (b - a) * ((part + 1) / parts), random,
                       result);
    }
  }
  return result;
}

}  // namespace brume::reference
