// Single scattering by the segment rule: see the header and ARCHITECTURE.md. The exact integral is in
// scatter_exact.cpp.
#include "reference/scatter.hpp"

#include <algorithm>
#include <cmath>

#include "reference/light_grid.hpp"
#include "reference/phase.hpp"
#include "reference/scatter_exact.hpp"
#include "reference/tracking.hpp"
#include "shared/method.h"

namespace brume::reference {
namespace {

// As in the kernels: what is left is less than e^-24 in every channel.
bool is_black(const dvec3& transmittance) {
  return std::max({transmittance.x, transmittance.y, transmittance.z}) <= std::exp(-24.0);
}

dvec3 each_channel(double (*function)(double), const dvec3& v) { return {function(v.x), function(v.y), function(v.z)}; }

// ∫ρT over a segment by the rule of the frame: `integral` is ∫ρ over it, `before` the optical depth up to it.
double gain_of(int rule, double sigma_t, double integral, double before) {
  if (rule == IN_SCATTERING_RECTANGLE) return std::exp(-(before + sigma_t * integral)) * integral;
  if (sigma_t > 1e-20) return std::exp(-before) * -std::expm1(-sigma_t * integral) / sigma_t;
  return std::exp(-before) * integral;
}

// A point along a view ray through a medium at which light is asked for.
struct Segment {
  int medium;
  double t;
  RandomStream random;
};

// S(m), and into shadow_key the lights that a surface keeps from m.
dvec3 source_at(const Context& context, const Segment& at, const RayD& ray, Scattered& result) {
  const Medium& medium = context.scene.media[static_cast<std::size_t>(at.medium)];
  const LightDepths& depths = context.light_depths[static_cast<std::size_t>(at.medium)];
  dvec3 source(0), tau(0);
  if (vec_promote(medium.sigma_s) == dvec3(0)) return source;
  const dvec3 point = ray.at(at.t);
  for (std::size_t i = 0; i < context.scene.lights.size(); ++i) {
    if (!depths.tau.empty()) {
      tau = light_grid_tau(depths, light_grid_of(context.scene, medium, i), medium, i, point);
      ++result.lookups;
    }
    const Arrival arrival =
        light_arrival(context, i, point, point, at.random, result.lookups, depths.tau.empty() ? nullptr : &tau);
    if (!arrival.light.shines()) continue;
    if (arrival.blocked) result.shadow_key += static_cast<uint>(i + 1);
    source += arrival.irradiance * phase_eval(medium.phase, medium.g, glm::dot(arrival.light.travel, -ray.dir));
  }
  return source;
}

// Transmittance of one medium by tracking.
dvec3 tracked_transmittance(const Context& context, int index, const RayD& ray, double t_max,
                            const RandomStream& random, double& lookups) {
  const Medium& medium = context.scene.media[static_cast<std::size_t>(index)];
  const dvec3 sigma_t = sigma_t_of(medium);
  dvec3 transmittance(1);
  if (sigma_t == dvec3(0)) return transmittance;
  collisions_visit(context.scene, medium, ray, medium_interval(medium, ray, 0, t_max), random, medium.method, true,
                   [&](const CollisionD& collision) {
                     collide(collision, sigma_t, random, medium.method, transmittance);
                     lookups += collision.spacing > 0;
                     return roulette(context.scene.frame.roulette, random, collision.id, transmittance) &&
                            !is_black(transmittance);
                   });
  return transmittance;
}

// τ of all media but one from the origin to t.
dvec3 others_tau(const Context& context, int medium, const RayD& ray, double t, const RandomStream& random,
                 double& lookups) {
  dvec3 tau(0);
  for (int other = 0; other < static_cast<int>(context.scene.media.size()); ++other) {
    if (other == medium) continue;
    const Medium& m = context.scene.media[static_cast<std::size_t>(other)];
    const RandomStream walk = random.child(static_cast<uint>(other));
    const int method = context.method(m);
    tau += method_tracks(method) ? tau_of(tracked_transmittance(context, other, ray, t, walk, lookups))
                                 : sigma_t_of(m) * optical_depth(context.scene, other, ray, t, method, &lookups, walk);
  }
  return tau;
}

// What a medium sends to the origin of the ray from one place: σs S + emission.
dvec3 sent_from(const Context& context, const Segment& at, const RayD& ray, Scattered& result) {
  const Medium& medium = context.scene.media[static_cast<std::size_t>(at.medium)];
  return vec_promote(medium.sigma_s) * source_at(context, at, ray, result) + vec_promote(medium.emission);
}

void medium_scatter(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& walk,
                    Scattered& result) {
  const Medium& medium = context.scene.media[static_cast<std::size_t>(index)];
  const int method = context.method(medium);
  const dvec3 sigma_t = sigma_t_of(medium);
  const int rule = context.scene.frame.in_scattering;
  dvec3 own_tau(0);
  for (const SegmentD& segment : segments(context.scene, index, ray, 0, t_max, method, walk)) {
    result.lookups += segment_lookups(medium, method);
    const double integral = segment.density_length;
    if (!(integral > 0)) continue;
    const Segment at{index, segment.sample, walk.child(segment.id)};
    const dvec3 before =
        own_tau + others_tau(context, index, ray, segment.sample, at.random.child(STREAM_OTHERS), result.lookups);
    const dvec3 gain(gain_of(rule, sigma_t.x, integral, before.x), gain_of(rule, sigma_t.y, integral, before.y),
                     gain_of(rule, sigma_t.z, integral, before.z));
    result.radiance += sent_from(context, at, ray, result) * gain;
    own_tau += sigma_t * integral;
    if (!(context.scene.frame.roulette > 0)) continue;
    dvec3 transmittance = transmittance_of(own_tau);
    const bool goes_on = roulette(context.scene.frame.roulette, walk, segment.id, transmittance);
    own_tau = tau_of(transmittance);
    if (!goes_on) break;
  }
  result.tau += own_tau;
}

// The same by collisions: each is worth ∫ρ in the mean.
void medium_track(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& walk,
                  Scattered& result) {
  const Medium& medium = context.scene.media[static_cast<std::size_t>(index)];
  const dvec3 sigma_t = sigma_t_of(medium);
  dvec3 transmittance(1);
  const auto visit = [&](const CollisionD& collision) {
    const CollisionWorth worth = collide(collision, sigma_t, walk, medium.method, transmittance);
    result.lookups += collision.spacing > 0;
    if (worth.weight > 0) {
      const Segment at{index, collision.t, walk.child(collision.id)};
      const dvec3 others = others_tau(context, index, ray, collision.t, at.random.child(STREAM_OTHERS), result.lookups);
      result.radiance += sent_from(context, at, ray, result) * worth.before * transmittance_of(others) * worth.weight;
    }
    return roulette(context.scene.frame.roulette, walk, collision.id, transmittance) && !is_black(transmittance);
  };
  collisions_visit(context.scene, medium, ray, medium_interval(medium, ray, 0, t_max), walk, medium.method, false,
                   visit);
  result.tau += tau_of(transmittance);
}

}  // namespace

dvec3 sigma_t_of(const Medium& medium) { return vec_promote(medium.sigma_a) + vec_promote(medium.sigma_s); }

dvec3 transmittance_of(const dvec3& tau) { return each_channel(std::exp, -tau); }

dvec3 tau_of(const dvec3& transmittance) { return -each_channel(std::log, transmittance); }

dvec3 media_tau(const Context& context, const RayD& ray, double t_max, const RandomStream& random, double& lookups) {
  return others_tau(context, -1, ray, t_max, random, lookups);
}

Context::Context(const FlatScene& flat, const Options& options)
    : scene(flat), bounds(flat), nodes(gauss_legendre(options.scatter_order)) {
  for (const Medium& medium : flat.media)
    light_depths.push_back(medium.light_grids > 0 && !exact() ? light_grids_make(*this, medium) : LightDepths{});
}

Arrival light_arrival(const Context& context, std::size_t index, const dvec3& point, const dvec3& ray_origin,
                      const RandomStream& random, double& lookups, const dvec3* media) {
  const Light& light = context.scene.lights[index];
  Arrival arrival{light_at(light, point), false, dvec3(0)};
  if (arrival.light.distance == 0) return arrival;
  const RayD shadow{ray_origin, -arrival.light.travel};
  arrival.blocked = occluded(context.scene, context.bounds, shadow, arrival.light.distance);
  if (arrival.blocked || !arrival.light.shines()) return arrival;
  const dvec3 tau = media ? *media
                          : media_tau(context, shadow, arrival.light.distance,
                                      random.child(STREAM_LIGHT + static_cast<uint>(index)), lookups);
  arrival.irradiance = arrival.light.irradiance * transmittance_of(tau);
  return arrival;
}

Scattered media_scatter(const Context& context, const RayD& ray, double t_max, const RandomStream& random) {
  if (context.exact()) return media_scatter_exact(context, ray, t_max);
  Scattered result;
  for (int medium = 0; medium < static_cast<int>(context.scene.media.size()); ++medium) {
    const bool tracks = method_tracks(context.scene.media[static_cast<std::size_t>(medium)].method);
    (tracks ? medium_track : medium_scatter)(context, medium, ray, t_max, random.child(static_cast<uint>(medium)),
                                             result);
  }
  return result;
}

}  // namespace brume::reference
