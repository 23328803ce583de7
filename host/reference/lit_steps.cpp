// See lit_steps.hpp.
#include "reference/lit_steps.hpp"

#include <algorithm>
#include <cmath>

namespace brume::reference {
namespace {

constexpr std::size_t KINKS_MAX = 64;

struct Kinks {
  double t0, t1;  // of the medium that is walked
  std::vector<double> t{};
  bool full() const { return t.size() >= KINKS_MAX; }
  void add(double at) {
    if (at > t0 && at < t1 && !full()) t.push_back(at);
  }
};

bool is_far(const Light& light) { return light.exponent != 0; }
bool is_near_spot(const Light& light) { return light.type == LIGHT_SPOT && !is_far(light); }

// Where the way from the ray to the light leaves a box through one of its edges: the plane of light and edge.
void edge_kinks(const Medium& medium, const Light& light, const RayD& world, Kinks& kinks) {
  const RayD ray = ray_to_cells(medium, world);
  const bool is_point = light.type != LIGHT_DIRECTIONAL;
  const dvec3 lo = vec_promote(medium.lo), hi = vec_promote(medium.hi);
  const dvec3 to = is_point
                       ? affine_point(medium.cell_from_world, vec_promote(light.position) * std::exp2(light.exponent))
                       : affine_direction(medium.cell_from_world, -vec_promote(light.direction));
  for (int a = 0; a < 3; ++a)
    for (int e = 0; e < 4; ++e) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      const double edge_b = e & 1 ? hi[b] : lo[b], edge_c = e & 2 ? hi[c] : lo[c];
      const double to_b = is_point ? edge_b - to[b] : to[b], to_c = is_point ? edge_c - to[c] : to[c];
      const double t =
          ((ray.origin[c] - edge_c) * to_b - (ray.origin[b] - edge_b) * to_c) / (ray.dir[b] * to_c - ray.dir[c] * to_b);
      if (!(t > kinks.t0 && t < kinks.t1)) continue;
      const dvec3 at = ray.at(t), way = is_point ? to - at : to;
      const double u = std::abs(way[b]) > std::abs(way[c]) ? (edge_b - at[b]) / way[b] : (edge_c - at[c]) / way[c];
      const double met = at[a] + u * way[a];
      if (u > 0 && (!is_point || u < 1) && met >= lo[a] && met <= hi[a]) kinks.add(t);
    }
}

Kinks kinks_find(const Context& context, int index, const RayD& ray, double t_max, const Interval& span) {
  Kinks kinks{span.t0, span.t1};
  for (int other = 0; other < static_cast<int>(context.media.size()); ++other) {
    if (other == index) continue;
    const Interval beside = medium_interval(context.media[static_cast<std::size_t>(other)], ray, 0, t_max);
    if (beside.empty()) continue;
    kinks.add(beside.t0);
    kinks.add(beside.t1);
  }
  for (const LightKink& kink : light_kinks(context, index, ray, t_max)) kinks.add(kink.t);
  return kinks;
}

// How far t is from a light: also along the ray to the planes beside the faces through which its light comes, behind
// which the depth to it bends.
double light_apart(const Medium& medium, const Light& light, const RayD& world, double t) {
  const dvec3 position = vec_promote(light.position);
  double apart = glm::length(world.at(t) - position);
  if (medium.region != REGION_BOX) return apart;
  const RayD ray = ray_to_cells(medium, world);
  const dvec3 in_cells = affine_point(medium.cell_from_world, position);
  const dvec3 lo = vec_promote(medium.lo), hi = vec_promote(medium.hi);
  for (int a = 0; a < 3; ++a)
    if (in_cells[a] < lo[a] || in_cells[a] > hi[a])
      apart = std::min(apart, std::abs((in_cells[a] - ray.at(t)[a]) / ray.dir[a]));
  return apart;
}

// How long the segment that begins at t may be, if nothing happens before `end`.
double step_at(const Context& context, const Medium& medium, const RayD& ray, const Kinks& kinks, double t,
               double end) {
  const dvec3 middle = ray.at(t + std::min(end - t, double(medium.step)) / 2);
  bool lit = kinks.full();  // a cone may have been left out
  double longest = medium.step;
  for (const Light& light : context.scene.lights) {
    if (is_near_spot(light) && !light_at(context.scene, light, middle, {}).shines()) continue;
    lit = true;
    if (light.type != LIGHT_DIRECTIONAL && !is_far(light))
      longest = std::min(longest, medium.light_grade * light_apart(medium, light, ray, t));
  }
  return lit ? std::max(longest, medium.step / 1024.0) : INFINITE;
}

}  // namespace

std::vector<LightKink> light_kinks(const Context& context, int index, const RayD& ray, double t_max) {
  std::vector<LightKink> found;
  const Interval span = medium_interval(context.media[static_cast<std::size_t>(index)], ray, 0, t_max);
  const auto& lights = context.scene.lights;
  const auto add = [&](std::size_t light, const Kinks& kinks) {
    for (const double t : kinks.t)
      if (found.size() < KINKS_MAX) found.push_back({light, t});
  };
  for (std::size_t l = 0; l < lights.size(); ++l) {
    Kinks cones{span.t0, span.t1};
    if (is_near_spot(lights[l]))
      for (const double t : spot_cones(lights[l], ray)) cones.add(t);
    add(l, cones);
  }
  for (std::size_t l = 0; l < lights.size(); ++l) {
    Kinks faces{span.t0, span.t1};
    if (lights[l].type == LIGHT_SURFACE) continue;
    for (const Medium& medium : context.media)
      if (medium.region == REGION_BOX) edge_kinks(medium, lights[l], ray, faces);
    add(l, faces);
  }
  return found;
}

// The angle to the spot's direction has 1 - cos = beside: ((p - P)·D)² = cos² |p - P|² on the side of the cosine.
std::vector<double> spot_cones(const Light& light, const RayD& ray) {
  std::vector<double> found;
  const dvec3 axis = vec_unit(vec_promote(light.direction)), from = ray.origin - vec_promote(light.position);
  const double along = glm::dot(ray.dir, axis), height = glm::dot(from, axis);
  for (double i = 0; i <= 8; ++i) {
    const double cosine = 1 - (light.outer + i / 8 * (double(light.inner) - light.outer)), square = cosine * cosine;
    const double a = along * along - square, b = height * along - square * glm::dot(from, ray.dir);
    const double c = height * height - square * glm::dot(from, from), root = b * b - a * c;
    if (!(root >= 0)) continue;
    for (const double side : {-1.0, 1.0}) {
      const double t = (side * std::sqrt(root) - b) / a;
      if ((height + t * along) * cosine >= 0) found.push_back(t);
    }
  }
  return found;
}

std::vector<SegmentD> lit_segments(const Context& context, int index, const RayD& ray, double t_max) {
  const Medium& medium = context.media[static_cast<std::size_t>(index)];
  std::vector<SegmentD> found;
  const Interval span = medium_interval(medium, ray, 0, t_max);
  if (span.empty()) return found;
  const bool all = context.scene.frame.light_picks == static_cast<int>(context.scene.lights.size());
  const Kinks kinks = all ? kinks_find(context, index, ray, t_max, span) : Kinks{span.t0, span.t1};
  const double apart = (span.t1 - span.t0) / 65536;
  for (double t = span.t0; t < span.t1;) {
    double end = span.t1;
    for (const double kink : kinks.t)
      if (kink > t + apart) end = std::min(end, kink);
    end = std::min(end, t + (all ? step_at(context, medium, ray, kinks, t, end) : double(medium.step)));
    if (end >= span.t1 - apart) end = span.t1;
    found.push_back(
        {t, end, ivec3(0), medium.constant_density * (end - t), (t + end) / 2, static_cast<uint>(found.size())});
    t = end;
  }
  return found;
}

}  // namespace brume::reference
