// Depths of media and light at a point: see the header and PICTURE.md. What media scatter is in
// scatter_segments.cpp, the exact integral in scatter_exact.cpp.
#include "reference/scatter.hpp"

#include <algorithm>
#include <cmath>

#include "reference/glass.hpp"
#include "reference/light_grid.hpp"
#include "reference/liquid.hpp"
#include "reference/scatter_exact.hpp"
#include "reference/scatter_segments.hpp"
#include "reference/tracking.hpp"
#include "shared/method.h"

namespace brume::reference {
namespace {

dvec3 each_channel(double (*function)(double), const dvec3& v) { return {function(v.x), function(v.y), function(v.z)}; }

std::vector<Medium> media_of(const PlannedScene& flat) {
  std::vector<Medium> media;
  for (std::size_t i = 0; i < flat.media.size(); ++i) media.push_back(flat.medium(i));
  return media;
}

// Transmittance of one medium by tracking.
dvec3 tracked_transmittance(const Context& context, int index, const RayD& ray, double t_max,
                            const RandomStream& random, double& lookups) {
  const Medium& medium = context.media[static_cast<std::size_t>(index)];
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

}  // namespace

dvec3 sigma_t_of(const Medium& medium) { return vec_promote(medium.sigma_a) + vec_promote(medium.sigma_s); }

dvec3 transmittance_of(const dvec3& tau) { return each_channel(std::exp, -tau); }

bool is_black(const dvec3& transmittance) {
  return std::max({transmittance.x, transmittance.y, transmittance.z}) <= std::exp(-24.0);
}

dvec3 tau_of(const dvec3& transmittance) { return -each_channel(std::log, transmittance); }

dvec3 media_tau_beside(const Context& context, int medium, const RayD& ray, double t, const RandomStream& random,
                       double& lookups) {
  dvec3 tau(0);
  for (int other = 0; other < static_cast<int>(context.media.size()); ++other) {
    if (other == medium) continue;
    const Medium& m = context.media[static_cast<std::size_t>(other)];
    const RandomStream walk = random.child(static_cast<uint>(other));
    const int method = context.method(m);
    tau += method_tracks(method)
               ? tau_of(tracked_transmittance(context, other, ray, t, walk, lookups))
               : sigma_t_of(m) * optical_depth(context.scene, other, ray, t, method, &lookups, walk, true);
  }
  return tau;
}

dvec3 media_tau(const Context& context, const RayD& ray, double t_max, const RandomStream& random, double& lookups) {
  return media_tau_beside(context, -1, ray, t_max, random, lookups);
}

Context::Context(const PlannedScene& flat, const Options& options)
    : scene(flat), media(media_of(flat)), bounds(flat), nodes(gauss_legendre(options.scatter_order)) {
  for (Medium& medium : media)
    if (exact() && medium.liquid >= 0) medium = presence_fine(medium);
  for (const Medium& medium : media)
    light_depths.push_back(medium.light_grids >= 0 && !exact() ? light_grids_make(*this, medium) : LightDepths{});
}

Arrival light_arrival(const Context& context, std::size_t index, const dvec3& point, const dvec3& ray_origin,
                      const RandomStream& places, const RandomStream& random, double& lookups, const dvec3* media) {
  const Light& light = context.scene.lights[index];
  Arrival arrival{light_at(context.scene, light, point, places), false, dvec3(0)};
  if (arrival.light.distance == 0) return arrival;
  const RayD shadow{ray_origin, -arrival.light.travel};
  const dvec3 passes = light_passes(context.scene, context.bounds, shadow, arrival.light.reach,
                                    glm::dot(ray_origin - point, shadow.dir));
  arrival.blocked = passes == dvec3(0);
  if (arrival.blocked || !arrival.light.shines()) return arrival;
  const dvec3 tau = media ? *media : media_tau(context, shadow, arrival.light.distance, random, lookups);
  arrival.irradiance = passes * arrival.light.irradiance * transmittance_of(tau);
  return arrival;
}

bool light_shines(const Context& context, const Light& light, const dvec3& point, const RandomStream& places) {
  const LightSample sample = light_at(context.scene, light, point, places);
  return sample.shines() &&
         light_passes(context.scene, context.bounds, {point, -sample.travel}, sample.reach) != dvec3(0);
}

Scattered media_scatter(const Context& context, const RayD& ray, double t_max, const RandomStream& random) {
  if (context.exact()) return media_scatter_exact(context, ray, t_max, random);
  Scattered result;
  for (int medium = 0; medium < static_cast<int>(context.media.size()); ++medium) {
    medium_scatter(context, medium, ray, t_max, random, result);
  }
  return result;
}

}  // namespace brume::reference
