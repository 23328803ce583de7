// Single scattering by the segment rule: see the header and ARCHITECTURE.md. The exact integral is in
// scatter_exact.cpp.
#include "reference/scatter.hpp"

#include <cmath>

#include "reference/phase.hpp"
#include "reference/scatter_exact.hpp"

namespace brume::reference {
namespace {

dvec3 each_channel(double (*function)(double), const dvec3& v) { return {function(v.x), function(v.y), function(v.z)}; }

dvec3 albedo_of(const Medium& medium) {
  const dvec3 sigma_s = vec_promote(medium.sigma_s), sigma_t = sigma_t_of(medium);
  const auto share = [](double s, double t) { return t > 0 ? s / t : 0; };
  return {share(sigma_s.x, sigma_t.x), share(sigma_s.y, sigma_t.y), share(sigma_s.z, sigma_t.z)};
}

// S(m), and into shadow_key the lights that a surface keeps from m.
dvec3 source_at(const Context& context, const Medium& medium, const RayD& ray, double t, Scattered& result) {
  dvec3 source(0);
  const dvec3 point = ray.at(t);
  for (std::size_t i = 0; i < context.scene.lights.size(); ++i) {
    const Arrival arrival = light_arrival(context, context.scene.lights[i], point, point, result.lookups);
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
  const dvec3 sigma_t = sigma_t_of(medium), albedo = albedo_of(medium);
  dvec3 own_tau(0);
  for (const SegmentD& segment : segments(context.scene, index, ray, 0, t_max, method)) {
    result.lookups += segment_lookups(medium, method);
    const dvec3 tau = sigma_t * segment.density_length;
    if (!(tau.x > 0 || tau.y > 0 || tau.z > 0)) continue;
    const double middle = segment.middle();
    const dvec3 before = own_tau + others_tau(context, index, ray, middle, result.lookups);
    const dvec3 kept = -each_channel(std::expm1, -tau);
    result.radiance +=
        albedo * source_at(context, medium, ray, middle, result) * each_channel(std::exp, -before) * kept;
    own_tau += tau;
  }
  result.tau += own_tau;
}

}  // namespace

dvec3 sigma_t_of(const Medium& medium) { return vec_promote(medium.sigma_a) + vec_promote(medium.sigma_s); }

dvec3 transmittance_of(const dvec3& tau) { return each_channel(std::exp, -tau); }

dvec3 media_tau(const Context& context, const RayD& ray, double t_max, double& lookups) {
  return others_tau(context, -1, ray, t_max, lookups);
}

Arrival light_arrival(const Context& context, const Light& light, const dvec3& point, const dvec3& ray_origin,
                      double& lookups) {
  Arrival arrival{light_at(light, point), false, dvec3(0)};
  if (arrival.light.distance == 0) return arrival;
  const RayD shadow{ray_origin, -arrival.light.travel};
  arrival.blocked = occluded(context.scene, context.bounds, shadow, arrival.light.distance);
  if (arrival.blocked || !arrival.light.shines()) return arrival;
  arrival.irradiance =
      arrival.light.irradiance * transmittance_of(media_tau(context, shadow, arrival.light.distance, lookups));
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
