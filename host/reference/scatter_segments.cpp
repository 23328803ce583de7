// See scatter_segments.hpp. Written from PICTURE.md, one segment after the other.
#include "reference/scatter_segments.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "reference/light_ladder.hpp"
#include "reference/liquid.hpp"
#include "reference/lit_steps.hpp"
#include "reference/others.hpp"
#include "reference/runs.hpp"
#include "reference/scatter_light.hpp"
#include "reference/tracking.hpp"
#include "shared/method.h"

namespace brume::reference {
namespace {

double largest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }

// A walk through one medium that is not tracked, as PICTURE.md cuts it into segments and dense ones into parts.
struct SegmentWalk {
  const Context& context;
  const Medium& medium;
  int index, method, rule;
  const RayD& ray;
  RandomStream walk, places;  // of the walk; of the ray
  bool takes_ends;            // no medium is tracked
  dvec3 sigma_t, own_tau{0};
  Others others;
  std::vector<DepthAlong> depths;  // of the other media, where none is tracked
  Scattered& result;
  LightLadder ladder;
  std::vector<LightKink> kinks{};                      // along that
  double inside = 0;                                   // length of the ray's way through the medium
  std::vector<RunPoint> run{};                         // of `adaptive`, while its light is traced
  RunsBefore runs_before{};                            // light before it
  double squares = 0, seen_squares = 0, all_gain = 0;  // of what its pieces err by, also as it is seen; ∫ρT

  bool adapts() const { return method == METHOD_ADAPTIVE; }
  bool runs() const {
    return adapts() && medium.light_grids < 0 && vec_promote(medium.sigma_s) != dvec3(0) &&
           context.scene.frame.light_picks == static_cast<int>(context.scene.lights.size());
  }

  // τ of the other media up to where light is asked for, and along the segment.
  std::pair<dvec3, dvec3> beside(const SegmentD& segment) {
    if (!takes_ends)
      return {others.advance(segment.sample, walk.child(segment.id).child(STREAM_OTHERS), result.lookups), dvec3(0)};
    dvec3 before(0), along(0);
    for (const DepthAlong& other : depths) {
      before += other.to(segment.t_begin);
      along += other.to(segment.t_end) - other.to(segment.t_begin);
    }
    return {before, along};
  }

  double parts_of(const SegmentD& segment) {
    if (rule == IN_SCATTERING_RECTANGLE) return 1;
    const dvec3 along = takes_ends ? beside(segment).second : dvec3(0);
    const double depth = largest(sigma_t * segment.density_length + along);
    double parts = rule == IN_SCATTERING_GAUSS2 ? 4 * depth : 8 * depth;
    const bool glows = vec_promote(medium.sigma_s) == dvec3(0) && vec_promote(medium.emission) != dvec3(0);
    if (rule == IN_SCATTERING_GAUSS2 && glows) parts = std::max(parts, std::min(64 * largest(along), 8.0));
    if (adapts()) parts = depth / double(medium.tau_part);
    if (rule == IN_SCATTERING_GAUSS2) parts = std::max(parts, light_parts(segment));
    return std::clamp(std::ceil(parts - 1.0 / 1024), 1.0, 256.0);
  }

  // So many that none is longer than a quarter of its way to a lamp.
  double light_parts(const SegmentD& segment) const {
    const PlannedScene& scene = context.scene;
    double parts = 0;
    if (medium.is_constant || vec_promote(medium.sigma_s) == dvec3(0)) return parts;
    if (scene.frame.light_picks < static_cast<int>(scene.lights.size())) return parts;
    for (const Light& light : scene.lights) {
      if (light.type == LIGHT_DIRECTIONAL || light.exponent != 0) continue;
      const dvec3 position = vec_promote(light.position);
      const double nearest = std::clamp(glm::dot(position - ray.origin, ray.dir), segment.t_begin, segment.t_end);
      const double distance = std::max(glm::length(ray.at(nearest) - position), 1e-15);
      parts = std::max(parts, 4 * (segment.t_end - segment.t_begin) / distance);
    }
    return parts;
  }

  // Of ∫ρ over a segment within a cell, what its second point of two stands for.
  double second_share(const SegmentD& segment) const {
    const RayD in_cells = ray_to_cells(medium, ray);
    const auto density = [&](double share) {
      const double t = segment.t_begin + share * (segment.t_end - segment.t_begin);
      return adapts() ? density_at(context.scene, medium, in_cells.at(t))
                      : density_in_cell(context.scene, medium, segment.cell, in_cells.at(t));
    };
    const double first = density(FIRST_POINT), second = density(1 - FIRST_POINT);
    return first + second > 0 ? second / (first + second) : 0.5;
  }

  SegmentD part_of(const SegmentD& whole, double i, double count) {
    const double length = whole.t_end - whole.t_begin;
    SegmentD part = whole;
    part.t_begin = whole.t_begin + length * (i / count);
    part.t_end = i + 1 == count ? whole.t_end : whole.t_begin + length * ((i + 1) / count);
    part.sample = part.t_begin + (whole.sample - whole.t_begin) / count;
    part.density_length = whole.density_length / count;
    part.id = whole.id + static_cast<uint>(i) * 0x9E3779B1u;
    if (method_rule(method) != RULE_GAUSS2 && !adapts()) return part;
    part.density_length = (adapts() ? density_length_piece : density_length_gauss2)(context.scene, medium, ray, part);
    result.lookups += segment_lookups(medium, method);
    return part;
  }

  // The depth from which on a segment is dense.
  double dense_from() const {
    if (adapts()) return 3.0 / 2;
    if (rule == IN_SCATTERING_SEGMENT) return medium.is_constant ? 1.0 / 512 : 1.0 / 16;
    return rule == IN_SCATTERING_GAUSS2 ? 1.0 / 2 : INFINITY;
  }

  // False: roulette ended the ray.
  bool scatter(const SegmentD& segment) {
    const auto [other_tau, other_depth] = beside(segment);
    const dvec3 depth = sigma_t * segment.density_length + other_depth, before = own_tau + other_tau;
    const bool deep = largest(depth) > dense_from();
    Segment at{index, segment.sample,  walk,          segment.id, walk.child(segment.id), places,
               deep,  segment.t_begin, segment.t_end, depth};
    at.two_points = rule == IN_SCATTERING_GAUSS2;
    at.bends = takes_ends;
    at.inside = inside;
    at.kinks = &kinks;
    at.ladder = &ladder;
    if (method_rule(method) == RULE_GAUSS2 || adapts()) at.second = second_share(segment);
    dvec3 gain;
    for (int c = 0; c < 3; ++c)
      gain[c] = adapts() && before[c] > medium.tau_lit ? 0 : gain_of(rule, segment.density_length, before[c], depth[c]);
    if (adapts()) {
      const double square = segment_error_square(context.scene, medium, ray, segment);
      squares += square;
      seen_squares += square * std::pow(gain.y / segment.density_length, 2);
      all_gain += gain.y;
    }
    if (runs() && !at.dense())
      run_take(at, gain);
    else
      result.radiance += sent_from(context, at, ray, result) * gain;
    own_tau += sigma_t * segment.density_length;
    if (!(context.scene.frame.roulette > 0)) return true;
    dvec3 transmittance = transmittance_of(own_tau);
    const bool goes_on = roulette(context.scene.frame.roulette, walk, segment.id, transmittance);
    own_tau = tau_of(transmittance);
    return goes_on;
  }

  // The two points of a segment.
  void run_take(const Segment& at, const dvec3& gain) {
    result.radiance += vec_promote(medium.emission) * gain;
    const dvec3 behind = at.second * transmittance_of(at.depth / std::sqrt(3.0)),
                share = behind / (1 - at.second + behind);
    const double length = at.end - at.begin;
    run.push_back({at.begin + FIRST_POINT * length, gain * (1.0 - share), at.random, places});
    run.push_back({at.begin + (1 - FIRST_POINT) * length, gain * share, at.random, places});
    if (run.size() == RUN_POINTS) run_shine();
  }

  void run_shine() {
    result.radiance += run_radiance(context, index, ray, run, inside, runs_before, result);
    run.clear();
  }

  void walk_all(double t_max) {
    const Interval span = medium_interval(medium, ray, 0, t_max);
    inside = span.t1 - span.t0;
    if (rule == IN_SCATTERING_GAUSS2 && !medium.is_constant &&
        context.scene.frame.light_picks == static_cast<int>(context.scene.lights.size()))
      kinks = light_kinks(context, index, ray, t_max);
    const bool lit_steps = rule == IN_SCATTERING_GAUSS2 && medium.is_constant;
    for (const SegmentD& segment : lit_steps ? lit_segments(context, index, ray, t_max)
                                             : segments(context.scene, index, ray, 0, t_max, method, walk)) {
      result.lookups += segment_lookups(medium, method);
      if (!(segment.density_length > 0)) continue;
      const double count = parts_of(segment);
      for (double i = 0; i < count; ++i) {
        const SegmentD part = count > 1 ? part_of(segment, i, count) : segment;
        if (part.density_length > 0 && !scatter(part)) return;
        // what is left is beyond any measure; the kernels stop earlier
        if (count > 1 && -std::log(1e-300) < std::min({own_tau.x, own_tau.y, own_tau.z})) break;
      }
    }
  }
};

void medium_segments(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& random,
                     Scattered& result) {
  const Medium& medium = context.media[static_cast<std::size_t>(index)];
  SegmentWalk scattering{
      context,
      medium,
      index,
      context.method(medium),
      context.method(medium) == METHOD_ADAPTIVE ? int(IN_SCATTERING_GAUSS2) : context.scene.frame.in_scattering,
      ray,
      random.child(static_cast<uint>(index)),
      random,
      context.scene.frame.takes_ends != 0,
      sigma_t_of(medium),
      dvec3(0),
      {context, index, ray},
      {},
      result,
      {context, ray, t_max}};
  for (int other = 0; scattering.takes_ends && other < static_cast<int>(context.media.size()); ++other)
    if (other != index)
      scattering.depths.emplace_back(context, other, ray, t_max, random.child(static_cast<uint>(other)),
                                     result.lookups);
  const auto sum = [&] { return result.radiance.x + result.radiance.y + result.radiance.z; };
  const double before = scattering.runs_before.seen = sum();
  scattering.walk_all(t_max);
  scattering.run_shine();
  if (scattering.all_gain > 0)
    result.error += std::abs(sum() - before) / 3 * std::sqrt(scattering.seen_squares) / scattering.all_gain;
  result.tau_error = std::hypot(result.tau_error, largest(scattering.sigma_t) * std::sqrt(scattering.squares));
  result.tau += scattering.own_tau;
}

// The same by collisions: each is worth ∫ρ in the mean.
void medium_track(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& random,
                  Scattered& result) {
  const RandomStream walk = random.child(static_cast<uint>(index));
  const Medium& medium = context.media[static_cast<std::size_t>(index)];
  const dvec3 sigma_t = sigma_t_of(medium);
  dvec3 transmittance(1);
  Others others{context, index, ray};
  const auto visit = [&](const CollisionD& collision) {
    const CollisionWorth worth = collide(collision, sigma_t, walk, medium.method, transmittance);
    result.lookups += collision.spacing > 0;
    if (worth.weight > 0) {
      const Segment at{index, collision.t, walk, collision.id, walk.child(collision.id), random};
      const dvec3 tau = others.advance(collision.t, at.random.child(STREAM_OTHERS), result.lookups);
      result.radiance += sent_from(context, at, ray, result) * worth.before * transmittance_of(tau) * worth.weight;
    }
    return roulette(context.scene.frame.roulette, walk, collision.id, transmittance) && !is_black(transmittance);
  };
  collisions_visit(context.scene, medium, ray, medium_interval(medium, ray, 0, t_max), walk, medium.method, false,
                   visit);
  result.tau += tau_of(transmittance);
}

}  // namespace

void medium_scatter(const Context& context, int index, const RayD& ray, double t_max, const RandomStream& random,
                    Scattered& result) {
  const Medium& medium = context.media[static_cast<std::size_t>(index)];
  const auto scatter = medium.liquid >= 0             ? liquid_scatter
                       : method_tracks(medium.method) ? medium_track
                                                      : medium_segments;
  scatter(context, index, ray, t_max, random, result);
}

}  // namespace brume::reference
