// Single scattering by the segment rule: see the header and ARCHITECTURE.md. The exact integral is in
// scatter_exact.cpp.
#include "reference/scatter.hpp"

#include <cmath>

#include "reference/light_grid.hpp"
#include "reference/phase.hpp"
#include "reference/scatter_exact.hpp"
#include "shared/method.h"

namespace brume::reference {
namespace {

dvec3 each_channel(double (*function)(double), const dvec3& v) { return {function(v.x), function(v.y), function(v.z)}; }

// ∫ρT over a segment by the rule of the frame: `integral` is ∫ρ over it, `before` the optical depth up to it.
double gain_of(int rule, double sigma_t, double integral, double before) {
  if (rule == IN_SCATTERING_RECTANGLE) return std::exp(-(before + sigma_t * integral)) * integral;
  if (sigma_t > 1e-20) return std::exp(-before) * -std::expm1(-sigma_t * integral) / sigma_t;
  return std::exp(-before) * integral;
}

// S(m), and into shadow_key the lights that a surface keeps from m.
dvec3 source_at(const Context& context, int index, const RayD& ray, double t, Scattered& result) {
  const Medium& medium = context.scene.media[static_cast<std::size_t>(index)];
  const LightGrid& grid = context.light_grids[static_cast<std::size_t>(index)];
  dvec3 source(0), tau(0);
  if (vec_promote(medium.sigma_s) == dvec3(0)) return source;
  const dvec3 point = ray.at(t);
  for (std::size_t i = 0; i < context.scene.lights.size(); ++i) {
    if (!grid.tau.empty()) {
      tau = light_grid_tau(grid, medium, i, point);
      ++result.lookups;
    }
    const Arrival arrival = light_arrival(context, context.scene.lights[i], point, point, result.lookups,
                                          grid.tau.empty() ? nullptr : &tau);
    if (!arrival.light.shines()) continue;
    if (arrival.blocked) result.shadow_key += static_cast<uint>(i + 1);
    source += arrival.irradiance * phase_eval(medium.phase, medium.g, glm::dot(arrival.light.travel, -ray.dir));
  }
  return source;
}

// τ of all media but one from the origin to t.
dvec3 others_tau(const Context& context, int medium, const RayD& ray, double t, double& lookups) {
  dvec3 tau(0);
  for (int other = 0; other < static_cast<int>(context.scene.media.size()); ++other) {
    if (other == medium) continue;
    const Medium& m = context.scene.media[static_cast<std::size_t>(other)];
    tau += sigma_t_of(m) * optical_depth(context.scene, other, ray, t, context.method(m), &lookups);
  }
  return tau;
}

void medium_scatter(const Context& context, int index, const RayD& ray, double t_max, Scattered& result) {
  const Medium& medium = context.scene.media[static_cast<std::size_t>(index)];
  const int method = context.method(medium);
  const dvec3 sigma_t = sigma_t_of(medium), sigma_s = vec_promote(medium.sigma_s),
              emission = vec_promote(medium.emission);
  const int rule = context.scene.frame.in_scattering;
  dvec3 own_tau(0);
  for (const SegmentD& segment : segments(context.scene, index, ray, 0, t_max, method)) {
    result.lookups += segment_lookups(medium, method);
    const double integral = segment.density_length;
    if (!(integral > 0)) continue;
    const dvec3 before = own_tau + others_tau(context, index, ray, segment.sample, result.lookups);
    const dvec3 gain(gain_of(rule, sigma_t.x, integral, before.x), gain_of(rule, sigma_t.y, integral, before.y),
                     gain_of(rule, sigma_t.z, integral, before.z));
    result.radiance += (sigma_s * source_at(context, index, ray, segment.sample, result) + emission) * gain;
    own_tau += sigma_t * integral;
  }
  result.tau += own_tau;
}

}  // namespace

dvec3 sigma_t_of(const Medium& medium) { return vec_promote(medium.sigma_a) + vec_promote(medium.sigma_s); }

dvec3 transmittance_of(const dvec3& tau) { return each_channel(std::exp, -tau); }

dvec3 media_tau(const Context& context, const RayD& ray, double t_max, double& lookups) {
  return others_tau(context, -1, ray, t_max, lookups);
}

Context::Context(const FlatScene& flat, const Options& options)
    : scene(flat), bounds(flat), nodes(gauss_legendre(options.scatter_order)) {
  for (const Medium& medium : flat.media)
    light_grids.push_back(medium.light_nx > 0 && !exact() ? light_grid_make(*this, medium) : LightGrid{});
}

Arrival light_arrival(const Context& context, const Light& light, const dvec3& point, const dvec3& ray_origin,
                      double& lookups, const dvec3* media) {
  Arrival arrival{light_at(light, point), false, dvec3(0)};
  if (arrival.light.distance == 0) return arrival;
  const RayD shadow{ray_origin, -arrival.light.travel};
  arrival.blocked = occluded(context.scene, context.bounds, shadow, arrival.light.distance);
  if (arrival.blocked || !arrival.light.shines()) return arrival;
  const dvec3 tau = media ? *media : media_tau(context, shadow, arrival.light.distance, lookups);
  arrival.irradiance = arrival.light.irradiance * transmittance_of(tau);
  return arrival;
}

Scattered media_scatter(const Context& context, const RayD& ray, double t_max) {
  if (context.exact()) return media_scatter_exact(context, ray, t_max);
  Scattered result;
  for (int medium = 0; medium < static_cast<int>(context.scene.media.size()); ++medium)
    medium_scatter(context, medium, ray, t_max, result);
  return result;
}

}  // namespace brume::reference
