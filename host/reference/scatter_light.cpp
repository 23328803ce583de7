// See scatter_light.hpp. Written from PICTURE.md, one segment after the other.
#include "reference/scatter_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <optional>
#include <vector>

#include "reference/glass.hpp"
#include "reference/light_grid.hpp"
#include "reference/light_ladder.hpp"
#include "reference/phase.hpp"
#include "shared/method.h"

namespace brume::reference {
namespace {

static_assert(IN_SCATTERING_COUNT == 3, "gain_of and source_at know all");

constexpr std::size_t SEGMENT_EDGES = 6;  // of one light that count
constexpr std::size_t SEGMENT_KINKS = 8;
constexpr double EDGES_ASKED = 64;         // places along the ray's way through a medium, at least
constexpr double KINK_INSET = 1.0 / 1024;  // of a segment: kinks closer to its ends do not count

// Mean of exp(-t) over [0, x], also for x < 0.
double mean_exp(double x) { return x == 0 ? 1 : -std::expm1(-x) / x; }

// ∫ exp(-(a + (b - a) u)) du over [0, 1].
double mean_between(double a, double b) { return std::exp(-std::min(a, b)) * mean_exp(std::abs(b - a)); }

// τ of all media from the place t of a ray in a medium to a light, by its light grid if it has one.
dvec3 light_depth(const Context& context, const Segment& at, std::size_t light, const RayD& ray, double t,
                  const RandomStream& random, double& lookups) {
  const dvec3 point = ray.at(t);
  const Medium& medium = context.media[static_cast<std::size_t>(at.medium)];
  const LightDepths& depths = context.light_depths[static_cast<std::size_t>(at.medium)];
  if (depths.tau.empty()) {
    if (at.ladder)
      if (const auto tau = at.ladder->depth(at, light, t, lookups)) return *tau;
    return light_depth_traced(context, light, point, at.places, random, lookups);
  }
  ++lookups;
  return light_grid_tau(depths, light_grid_of(context.scene, medium, light), medium, light, point);
}

// Mean of T to a light, that of shadow ray n, over a segment, weighted with the segment's own ρT.
dvec3 light_transmittance(const Context& context, const Segment& at, std::size_t light, uint n, const RayD& ray,
                          double& lookups) {
  const auto depth = [&](double t, uint stream) {
    return light_depth(context, at, light, ray, t, at.random.child(stream + n), lookups);
  };
  if (!at.dense()) return transmittance_of(depth(at.t, STREAM_LIGHT));
  // from inside both ends, of which one may lie on a face of a medium along which light travels, and on in a straight
  // line
  const double inset = DENSE_POINT, length = at.end - at.begin;
  const dvec3 near = depth(at.begin + inset * length, STREAM_LIGHT),
              far = depth(at.end - inset * length, STREAM_LIGHT_END), slope = (far - near) / (1 - 2 * inset);
  const dvec3 begin = glm::max(near - inset * slope, 0.0), end = at.depth + glm::max(far + inset * slope, 0.0);
  dvec3 mean;
  for (int c = 0; c < 3; ++c) mean[c] = mean_between(begin[c], end[c]) / mean_between(0, at.depth[c]);
  return mean;
}

// E · V · p of a light at t, and into shadow_key whether a surface keeps it from there.
dvec3 arriving_at(const Context& context, const Segment& at, std::size_t light, double t, const RayD& ray,
                  Scattered& result) {
  const Medium& medium = context.media[static_cast<std::size_t>(at.medium)];
  const dvec3 point = ray.at(t), nothing(0);
  const Arrival arrival = light_arrival(context, light, point, point, at.places, {}, result.lookups, &nothing);
  if (!arrival.light.shines()) return nothing;
  if (arrival.blocked) result.shadow_key += static_cast<uint>(light + 1);
  if (arrival.irradiance == nothing) return nothing;
  return arrival.irradiance * phase_eval(medium.phase, medium.g, glm::dot(arrival.light.travel, -ray.dir));
}

// PICTURE, Two points: c(x), by which a sum over two points, at q and 1 - q, of what falls by exp(-x) falls short of
// the integral. Its logarithm, since it grows as exp(qx).
double bend_log(double x, double q) {
  const double y = std::abs(x);
  return q * y + std::log(2 * mean_exp(y) / (1 + std::exp(-y * (1 - 2 * q))));
}

// One channel of shadow ray n: what counts of the light at both points.
std::array<double, 2> points_weights(const Segment& at, int c, double near, double far, bool bends) {
  const double q = at.dense() ? DENSE_POINT : FIRST_POINT, depth = at.depth[c], grows = (far - near) / (1 - 2 * q);
  const double behind = at.second * std::exp(-depth * (1 - 2 * q)), share = behind / (1 - at.second + behind);
  if (at.dense() && bends) {
    const double begin = std::max(near - q * grows, 0.0), end = depth + std::max(far + q * grows, 0.0);
    const double mean = mean_between(begin, end) / mean_between(0, depth);
    return {(1 - share) * mean, share * mean};
  }
  const double limit = std::min(near, far) / q, slope = bends ? std::clamp(grows, -limit, limit) : 0;
  const double lift = bend_log(depth + slope, q) - bend_log(depth, q);
  return {(1 - share) * std::exp(lift - near), share * std::exp(lift - far)};
}

// What shares of a segment a light reaches.
struct LitPart {
  double from, to;
};

// A share at which a segment is cut: where light begins or ends, or has a kink.
struct Cut {
  double share;
  bool edge;
};

// Adds the edges of a segment; whether a light shines where it begins. `lit` tells of both its points, `asked` how many
// places are asked over a length as that of the segment.
bool edges_find(const std::function<bool(double)>& shines, const std::array<bool, 2>& lit, double asked,
                std::vector<Cut>& cuts) {
  const std::array<double, 4> places{DENSE_POINT, FIRST_POINT, 1 - FIRST_POINT, 1 - DENSE_POINT};
  const bool begins = shines(places[0]);
  bool was = begins;
  double before = places[0];
  for (std::size_t i = 1; i < 4; ++i) {
    const double gap = places[i] - places[i - 1], count = std::max(1.0, std::ceil(gap * asked - 1.0 / 1024));
    for (double n = 1; n <= count; ++n) {
      if (cuts.size() == SEGMENT_EDGES) return begins;
      const double at = places[i - 1] + gap * (n / count);
      const bool is = n == count && i < 3 ? lit[i - 1] : shines(at);
      if (is != was) cuts.push_back({edge_between(shines, before, at, was), true});
      before = at;
      was = is;
    }
  }
  return begins;
}

// PICTURE, Edges of shadows: the parts of a segment that are lit, where it is cut; nothing where it is not.
std::optional<std::vector<LitPart>> lit_parts(const Context& context, const Segment& at, std::size_t index,
                                              const RayD& ray, const std::array<bool, 2>& lit, Scattered& result) {
  const Light& light = context.scene.lights[index];
  const bool all = context.scene.frame.light_picks == static_cast<int>(context.scene.lights.size());
  if (at.deep || !all || light.type == LIGHT_SURFACE) return {};
  const double length = at.end - at.begin;
  std::vector<Cut> cuts;
  bool shining = edges_find(
      [&](double share) { return light_shines(context, light, ray.at(at.begin + share * length), at.places); }, lit,
      EDGES_ASKED * length / at.inside, cuts);
  result.shadow_key += static_cast<uint>(cuts.size()) * 0x3C6EF372u * static_cast<uint>(index + 1);
  const std::size_t most = cuts.size() + SEGMENT_KINKS;
  if (at.kinks)
    for (const LightKink& kink : *at.kinks) {
      const double share = (kink.t - at.begin) / length;
      if (kink.light == index && share > KINK_INSET && share < 1 - KINK_INSET && cuts.size() < most)
        cuts.push_back({share, false});
    }
  if (cuts.empty()) return {};
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.share < b.share; });
  cuts.push_back({1, false});
  std::vector<LitPart> parts;
  double from = 0;
  for (const Cut& cut : cuts) {
    if (shining) parts.push_back({from, cut.share});
    shining = shining != cut.edge;
    from = cut.share;
  }
  return parts;
}

// E · V · p · T of shadow ray n over the lit parts of a segment, each by two points of its own under the weight ρT of
// the whole, ρ a straight line.
dvec3 light_of_parts(const Context& context, const Segment& at, std::size_t light, uint n, const RayD& ray,
                     const std::vector<LitPart>& parts, Scattered& result) {
  const auto density = [&](double u) { return std::max(0.0, 1 + (2 * at.second - 1) * std::sqrt(3.0) * (2 * u - 1)); };
  const dvec3 all = ((1 - at.second) * transmittance_of(FIRST_POINT * at.depth) +
                     at.second * transmittance_of((1 - FIRST_POINT) * at.depth));
  dvec3 sum(0);
  for (const LitPart& part : parts)
    for (uint k = 0; k < 2; ++k) {
      const double u = part.from + (k ? 1 - FIRST_POINT : FIRST_POINT) * (part.to - part.from);
      const double t = at.begin + u * (at.end - at.begin);
      const dvec3 arriving = arriving_at(context, at, light, t, ray, result);
      if (arriving == dvec3(0)) continue;
      const dvec3 tau = light_depth(context, at, light, ray, t,
                                    at.random.child((k ? STREAM_LIGHT_END : STREAM_LIGHT) + n), result.lookups);
      sum += (part.to - part.from) / 2 * density(u) * transmittance_of(u * at.depth + tau) / all * arriving;
    }
  return sum;
}

// E · V · p · T of shadow ray n over a segment, from two points.
dvec3 light_of_points(const Context& context, const Segment& at, std::size_t light, uint n, const RayD& ray,
                      Scattered& result) {
  std::array<dvec3, 2> arriving, tau;
  for (uint k = 0; k < 2; ++k) {
    const double q = at.dense() ? DENSE_POINT : FIRST_POINT;
    const double t = at.begin + (at.end - at.begin) * (k ? 1 - q : q);
    arriving[k] = arriving_at(context, at, light, t, ray, result);
    tau[k] = arriving[k] == dvec3(0)
                 ? dvec3(0)
                 : light_depth(context, at, light, ray, t, at.random.child((k ? STREAM_LIGHT_END : STREAM_LIGHT) + n),
                               result.lookups);
  }
  const auto parts = lit_parts(context, at, light, ray, {arriving[0] != dvec3(0), arriving[1] != dvec3(0)}, result);
  if (parts) return light_of_parts(context, at, light, n, ray, *parts, result);
  const bool bends = at.bends && arriving[0] != dvec3(0) && arriving[1] != dvec3(0);
  dvec3 sum;
  for (int c = 0; c < 3; ++c) {
    const auto weights = points_weights(at, c, tau[0][c], tau[1][c], bends);
    sum[c] = weights[0] * arriving[0][c] + weights[1] * arriving[1][c];
  }
  return sum;
}

// S of a segment.
dvec3 source_at(const Context& context, const Segment& at, const RayD& ray, Scattered& result) {
  const Medium& medium = context.media[static_cast<std::size_t>(at.medium)];
  dvec3 source(0);
  if (vec_promote(medium.sigma_s) == dvec3(0)) return source;
  uint n = 0;
  for (const LightPick& pick : light_picks(context.scene, at.walk, at.id)) {
    const uint shadow = n++;
    if (at.two_points) {
      source += pick.weight * light_of_points(context, at, pick.light, shadow, ray, result);
      continue;
    }
    const dvec3 arriving = arriving_at(context, at, pick.light, at.t, ray, result);
    if (arriving == dvec3(0)) continue;
    source += pick.weight * arriving * light_transmittance(context, at, pick.light, shadow, ray, result.lookups);
  }
  return source;
}

}  // namespace

dvec3 light_depth_traced(const Context& context, std::size_t light, const dvec3& point, const RandomStream& places,
                         const RandomStream& random, double& lookups) {
  const LightSample sample = light_at(context.scene, context.scene.lights[light], point, places);
  return media_tau(context, {point, -sample.travel}, sample.distance, random, lookups);
}

double edge_between(const std::function<bool(double)>& lit, double near, double far, bool first) {
  constexpr int HALVINGS = 12;
  for (int halving = 0; halving < HALVINGS; ++halving) {
    const double middle = (near + far) / 2;
    (lit(middle) == first ? near : far) = middle;
  }
  return (near + far) / 2;
}

double gain_of(int rule, double integral, double before, double depth) {
  if (rule == IN_SCATTERING_RECTANGLE) return std::exp(-(before + depth)) * integral;
  return std::exp(-before) * mean_exp(depth) * integral;
}

dvec3 sent_from(const Context& context, const Segment& at, const RayD& ray, Scattered& result) {
  const Medium& medium = context.media[static_cast<std::size_t>(at.medium)];
  return vec_promote(medium.sigma_s) * source_at(context, at, ray, result) + vec_promote(medium.emission);
}

}  // namespace brume::reference
