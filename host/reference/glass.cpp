// See the header and PICTURE, Glass.
#include "reference/glass.hpp"

#include <algorithm>
#include <cmath>

#include "shared/ray.h"

namespace brume::reference {
namespace {

constexpr int SURFACES = 64;  // that are followed

bool refracts(const PlannedScene& scene, const SurfaceD& surface) {
  return scene.materials[static_cast<std::size_t>(surface.material)].refraction > 0;
}

// Everything that a straight way meets, in order: where, and what. Empty at the end of `found` no more than SURFACES.
struct Met {
  double t;
  SurfaceD surface;
};
std::vector<Met> met_along(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray, double t_max,
                           double gap = 0) {
  std::vector<Met> met;
  RayD from = ray;
  for (double t = gap; met.size() < SURFACES;) {
    const HitD hit = nearest_hit(scene, bounds, from, t_max - t);
    if (hit.primitive == PRIMITIVE_NONE) break;
    t += hit.t;
    met.push_back({t, surface_at(scene, from, hit)});
    from.origin = surface_leave(met.back().surface, ray.dir);
    t += glm::dot(from.origin - met.back().surface.point, ray.dir);
  }
  return met;
}

double interface_passes(const Material& material, const SurfaceD& surface, const dvec3& dir) {
  const double cosine = std::abs(glm::dot(surface.normal, dir)), ior = material.ior;
  return material.refraction * (material.fresnel ? 1 - fresnel(cosine, 1 / ior) : 1);
}

}  // namespace

void Inside::enter(int material) {
  materials_.push_back(material);
  if (materials_.size() > INSIDE_MAX) materials_.erase(materials_.begin());
}

bool Inside::cross(const SurfaceD& surface) {
  if (!surface.leaving) {
    enter(surface.material);
    return true;
  }
  const auto last = std::find(materials_.rbegin(), materials_.rend(), surface.material);
  if (last == materials_.rend()) return false;
  materials_.erase(std::next(last).base());
  return true;
}

dvec3 absorbed(const PlannedScene& scene, int material, double length) {
  dvec3 left(1);
  if (material < 0) return left;
  const dvec3 absorption = vec_promote(scene.materials[static_cast<std::size_t>(material)].absorption);
  for (int c = 0; c < 3; ++c)
    if (absorption[c] > 0) left[c] = std::exp(-absorption[c] * length);
  return left;
}

// Amplitudes by the sine law [BornWolf99, 1.5.2].
double fresnel(double cosine, double eta) {
  const double sine_through = eta * std::sqrt(std::max(0.0, 1 - cosine * cosine));
  if (sine_through > 1) return 1;
  const double through = std::sqrt(1 - sine_through * sine_through);
  if (cosine == 0 && through == 0) return 0;  // eta = 1: there is no interface
  const double across = (eta * cosine - through) / (eta * cosine + through),
               along = (cosine - eta * through) / (cosine + eta * through);
  return (across * across + along * along) / 2;
}

Inside inside_of(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray) {
  Inside entered;
  std::vector<int> begun;  // the innermost first
  for (const Met& met : met_along(scene, bounds, ray, INFINITE)) {
    if (begun.size() == INSIDE_MAX) break;
    if (refracts(scene, met.surface) && !entered.cross(met.surface)) begun.push_back(met.surface.material);
  }
  Inside inside;
  for (auto material = begun.rbegin(); material != begun.rend(); ++material) inside.enter(*material);
  return inside;
}

dvec3 light_passes(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray, double distance,
                   double gap) {
  if (!scene.frame.clear_shadows) return dvec3(occluded(scene, bounds, ray, distance) ? 0 : 1);
  const std::vector<Met> all = met_along(scene, bounds, ray, distance, gap);
  if (all.size() == SURFACES) return dvec3(0);
  Inside inside = inside_of(scene, bounds, ray);
  dvec3 left(1);
  double at = 0;
  for (const Met& met : all) {
    if (!refracts(scene, met.surface)) return dvec3(0);
    left *= absorbed(scene, inside.innermost(), met.t - at);
    left *= interface_passes(scene.materials[static_cast<std::size_t>(met.surface.material)], met.surface, ray.dir);
    inside.cross(met.surface);
    at = met.t;
  }
  return left * absorbed(scene, inside.innermost(), distance - at);
}

}  // namespace brume::reference
