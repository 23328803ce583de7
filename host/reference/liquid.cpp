// What a liquid sends along a view ray, step by step. See liquid.hpp; written from PICTURE, Liquids.
#include "reference/liquid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "reference/others.hpp"

namespace brume::reference {
namespace {

struct LiquidWalk {
  const Context& context;
  const Medium& medium;
  const Liquid& liquid;
  int index;
  const RayD& ray;
  RandomStream walk, places;  // of the walk; of the ray
  Others others;
  std::vector<DepthAlong> depths;  // of the other media, where none is tracked
  Scattered& result;
  dvec3 tau{0};  // of the liquid up to the step at work

  double within(double presence) const { return std::clamp<double>(presence, liquid.outside, liquid.inside); }

  dvec3 tau_beside(double t, uint id) {
    if (!context.scene.frame.takes_ends) return others.advance(t, walk.child(id).child(STREAM_OTHERS), result.lookups);
    dvec3 sum(0);
    for (const DepthAlong& other : depths) sum += other.to(t);
    return sum;
  }

  // Out of the liquid, from differences along the axes of cell space; 0 where there are none.
  dvec3 normal_of(const dvec3& gradient) const {
    const dvec3 world = affine_normal(medium.cell_from_world, gradient);
    return world == dvec3(0) ? world : -glm::normalize(world);
  }

  // What a place of the boundary with that normal sends back along the ray, of all lights.
  dvec3 lit(double t, const dvec3& normal, uint id) const {
    dvec3 sum = vec_promote(liquid.ambient) * vec_promote(context.scene.frame.ambient);
    for (const LightPick& pick : light_picks(context.scene, walk, id)) {
      const LightSample light = light_at(context.scene, context.scene.lights[pick.light], ray.at(t), places);
      const double cosine = -glm::dot(normal, light.travel);
      if (!(cosine > 0)) continue;
      dvec3 sent = cosine * vec_promote(liquid.diffuse);
      const dvec3 half_way = glm::normalize(-ray.dir - light.travel);
      if (glm::dot(normal, ray.dir) < 0 && glm::dot(normal, half_way) > 0)
        sent += vec_promote(liquid.specular) * std::pow(glm::dot(normal, half_way), double(liquid.shininess));
      sum += pick.weight * light.irradiance * sent;
    }
    return sum;
  }

  // `own`: ∫ρ of the liquid from the begin of the step at work to t.
  void shine(double t, double amount, double own, const dvec3& gradient, uint id) {
    if (!(amount > 0)) return;
    const dvec3 through = transmittance_of(tau + sigma_t_of(medium) * own + tau_beside(t, id));
    result.radiance += amount * through * lit(t, normal_of(gradient), id);
  }

  double amount_of(const PresenceStep& step) const {
    const double change = within(step.after) - within(step.before);
    if (!(liquid.rate > 0)) return std::abs(change);
    const double length = (step.t_end - step.t_begin) * liquid.rate;
    if (step.after != step.before) return length * change / (step.after - step.before);
    return step.before >= liquid.outside && step.before <= liquid.inside ? length : 0;
  }

  // Where in the step the presence is in the middle of what it changes by: two steps of the false position.
  double place_of(const PresenceStep& step, const RayD& in_cells) {
    ++result.lookups;
    if (step.before == step.after) return 0.5;
    ++result.lookups;
    const double a = step.before, b = step.after, middle = (within(a) + within(b)) / 2, first = (middle - a) / (b - a);
    const double t = step.t_begin + first * (step.t_end - step.t_begin);
    const double found = density_at(context.scene, medium, in_cells.at(t));
    const bool behind = (found < middle) == (a < middle) && found != middle;  // not yet there
    const double closer =
        behind ? first + (1 - first) * (middle - found) / (b - found) : first * (middle - a) / (found - a);
    return closer >= 0 && closer <= 1 ? closer : first;  // presences too much alike
  }

  void take(const PresenceStep& step, const RayD& in_cells) {
    const double outside = liquid.outside, length = step.t_end - step.t_begin;
    const auto whole = [&](double from, double to) {  // ∫ of a presence even between them, per length
      const double high = std::max(from, to), low = std::max(std::min(from, to), outside);
      return high < outside ? 0 : (from == to ? 1 : (high - low) / std::abs(to - from)) * (high + low) / 2;
    };
    const double amount = amount_of(step);
    if (amount > 0) {
      const double share = place_of(step, in_cells), t = step.t_begin + share * length;
      const double there = step.before + share * (step.after - step.before);
      shine(t, amount, share * length * whole(step.before, there),
            presence_gradient(context.scene, medium, in_cells.at(t)), step.id);
    }
    tau += sigma_t_of(medium) * (length * whole(step.before, step.after));
  }

  // Through the face of the medium's box at t, behind which the presence is 0.
  void face(double t, double presence, const RayD& in_cells, uint id) {
    if (liquid.rate > 0) return;
    const dvec3 p = in_cells.at(t), from_lo = p - vec_promote(medium.lo), to_hi = vec_promote(medium.hi) - p;
    dvec3 gradient(0);
    double nearest = INFINITE;
    for (int axis = 0; axis < 3; ++axis) {
      const double distance = std::min(std::abs(from_lo[axis]), std::abs(to_hi[axis]));
      if (!(distance < nearest)) continue;
      nearest = distance;
      gradient = dvec3(0);
      gradient[axis] = std::abs(from_lo[axis]) < std::abs(to_hi[axis]) ? 1 : -1;
    }
    shine(t, within(presence) - liquid.outside, 0, gradient, id);
  }
};

}  // namespace

void liquid_scatter(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& random,
                    Scattered& result) {
  const Medium& medium = context.media[static_cast<std::size_t>(index)];
  const Interval span = medium_interval(medium, ray, 0, t_max);
  if (span.empty()) return;
  LiquidWalk walk{context,
                  medium,
                  context.scene.liquids[static_cast<std::size_t>(medium.liquid)],
                  index,
                  ray,
                  random.child(static_cast<uint>(index)),
                  random,
                  {context, index, ray},
                  {},
                  result};
  for (int other = 0; context.scene.frame.takes_ends && other < static_cast<int>(context.media.size()); ++other)
    if (other != index)
      walk.depths.emplace_back(context, other, ray, t_max, random.child(static_cast<uint>(other)), result.lookups);
  const RayD in_cells = ray_to_cells(medium, ray);
  const std::vector<PresenceStep> steps = presence_steps(context.scene, medium, ray, span);
  if (span.t0 > 0) walk.face(span.t0, steps.front().before, in_cells, 0);
  for (const PresenceStep& step : steps) walk.take(step, in_cells);
  result.lookups += static_cast<double>(steps.size()) + 1;
  if (span.t1 < t_max) walk.face(span.t1, steps.back().after, in_cells, static_cast<uint>(steps.size()) + 1);
  result.tau += walk.tau;
}

}  // namespace brume::reference
