// Segments by collecting and sorting every crossing of a cell border.
#include "reference/medium.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "reference/liquid.hpp"
#include "shared/method.h"

namespace brume::reference {
namespace {

Medium medium_of(const PlannedScene& scene, int index, int method) {
  const Medium medium = scene.medium(static_cast<std::size_t>(index));
  return method == METHOD_FINE ? presence_fine(medium) : medium;
}

Interval box_interval(const dvec3& lo, const dvec3& hi, const RayD& ray, Interval span) {
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.dir[axis] == 0) {
      if (ray.origin[axis] < lo[axis] || ray.origin[axis] > hi[axis]) return {0, 0};
      continue;
    }
    const double a = (lo[axis] - ray.origin[axis]) / ray.dir[axis], b = (hi[axis] - ray.origin[axis]) / ray.dir[axis];
    span = {std::max(span.t0, std::min(a, b)), std::min(span.t1, std::max(a, b))};
  }
  return span;
}

Interval ellipsoid_interval(const dvec3& lo, const dvec3& hi, const RayD& ray, Interval span) {
  // in the space where the ellipsoid is the unit sphere
  const dvec3 half = 0.5 * (hi - lo);
  const dvec3 origin = (ray.origin - 0.5 * (lo + hi)) / half, dir = ray.dir / half;
  const double a = glm::dot(dir, dir), middle = -glm::dot(origin, dir) / a;
  const dvec3 closest = origin + middle * dir;
  const double square = (1 - glm::dot(closest, closest)) / a;
  if (square <= 0) return {0, 0};
  const double chord = std::sqrt(square);
  return {std::max(span.t0, middle - chord), std::min(span.t1, middle + chord)};
}

// The borders of cells crossed within (t0, t1), with t0 and t1 themselves, ascending.
std::vector<double> cell_crossings(const RayD& ray, double t0, double t1) {
  std::vector<double> crossings;
  crossings.reserve(128);
  crossings.push_back(t0);
  const dvec3 begin = ray.at(t0), end = ray.at(t1);
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.dir[axis] == 0) continue;
    const double first = std::floor(std::min(begin[axis], end[axis])),
                 last = std::ceil(std::max(begin[axis], end[axis]));
    for (double plane = first; plane <= last; ++plane) {
      const double t = (plane - ray.origin[axis]) / ray.dir[axis];
      if (t > t0 && t < t1) crossings.push_back(t);
    }
  }
  crossings.push_back(t1);
  std::sort(crossings.begin(), crossings.end());
  crossings.erase(std::unique(crossings.begin(), crossings.end()), crossings.end());
  return crossings;
}

static_assert(RULE_COUNT == 7 && PLACEMENT_COUNT == 4, "dda_rule, march_visit, pieces_visit and segments_visit know");

// ∫ρ over a segment within one cell.
double dda_rule(const PlannedScene& scene, const Medium& medium, const RayD& ray, const SegmentD& segment, int rule) {
  const double length = segment.t_end - segment.t_begin, middle = segment.middle();
  const auto density = [&](double t) { return density_in_cell(scene, medium, segment.cell, ray.at(t)); };
  const double apart = length / (2 * std::sqrt(3.0));
  switch (rule) {
    case RULE_GAUSS2:
      return length / 2 * (density(middle - apart) + density(middle + apart));
    case RULE_NEAREST:  // the cell's own sample, whatever the interpolation
      return length * density_in_cell(scene, medium, segment.cell, dvec3(segment.cell));
    case RULE_MIDPOINT:
      return length * density(middle);
    default:
      return std::nan("");  // not a rule of cells
  }
}

double piece_density_length(const PlannedScene& scene, const Medium& medium, const RayD& ray, const SegmentD& segment) {
  const double length = segment.t_end - segment.t_begin, apart = length / (2 * std::sqrt(3.0));
  return length / 2 *
         (density_at(scene, medium, ray.at(segment.middle() - apart)) +
          density_at(scene, medium, ray.at(segment.middle() + apart)));
}

uint cell_name(const ivec3& cell) {
  return static_cast<uint>(cell.x) * 0x8DA6B343u ^ static_cast<uint>(cell.y) * 0xD8163841u ^
         static_cast<uint>(cell.z) * 0xCB1AB31Fu;
}

// Where in step i a marcher samples, as a share of the step.
double march_share(int method, const RandomStream& random, uint i) {
  const double over = method_jitter(method);
  return method_share(method) + (over > 0 ? over * random.at(i, RANDOM_PLACE) : 0);
}

template <class Visit>
void dda_visit(const PlannedScene& scene, const Medium& medium, const RayD& ray, const Interval& span, int method,
               Visit visit) {
  const std::vector<double> crossings = cell_crossings(ray, span.t0, span.t1);
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    SegmentD segment{crossings[i], crossings[i + 1], ivec3(0), 0, 0, 0};
    segment.sample = segment.middle();
    segment.cell = cell_at(medium, ray.at(segment.middle()));
    segment.id = cell_name(segment.cell);
    segment.density_length = dda_rule(scene, medium, ray, segment, method_rule(method));
    visit(segment);
  }
}

template <class Visit>
void march_visit(const PlannedScene& scene, const Medium& medium, const RayD& ray, const Interval& span, int method,
                 const RandomStream& random, Visit visit) {
  const double length = span.t1 - span.t0;
  const double count = std::max(1.0, std::ceil(length / medium.step - 1.0 / 1024));
  const auto border = [&](double i) { return i == count ? span.t1 : span.t0 + length * (i / count); };
  for (double i = 0; i < count; ++i) {
    SegmentD segment{border(i), border(i + 1), ivec3(0), 0, 0, static_cast<uint>(i)};
    segment.sample = segment.t_begin + march_share(method, random, segment.id) * (segment.t_end - segment.t_begin);
    const dvec3 p = ray.at(segment.sample);
    segment.cell = cell_at(medium, p);
    segment.density_length = density_at(scene, medium, p) * (length / count);
    visit(segment);
  }
}

const float* piece_row(const PlannedScene& scene, const Medium& medium, int brick) {
  const int row = medium.piece_rates + PIECE_ROW * brick;
  return &scene.piece_rates[static_cast<std::size_t>(row)];
}

// A segment of a brick by two points that look up wherever they lie in it; `number` tells it from others of the brick.
SegmentD piece_of(const PlannedScene& scene, const Medium& medium, const RayD& ray, double a, double b,
                  const ivec3& brick, uint number) {
  SegmentD piece{a, b, cell_at(medium, ray.at((a + b) / 2)), 0, (a + b) / 2, 0};
  piece.id = cell_name(brick * BRICK_CELLS) ^ number * 0x85EBCA6Bu;
  piece.density_length = piece_density_length(scene, medium, ray, piece);
  return piece;
}

template <class Visit>
void pieces_visit(const PlannedScene& scene, const Medium& medium, const RayD& ray, const Interval& span, bool to_light,
                  Visit visit) {
  const std::vector<double> crossings = cell_crossings(ray, span.t0, span.t1);
  const auto cell_of = [&](std::size_t i) { return cell_at(medium, ray.at((crossings[i] + crossings[i + 1]) / 2)); };
  for (std::size_t first = 0, last; first + 1 < crossings.size(); first = last) {
    const ivec3 brick = cell_of(first) / BRICK_CELLS;
    for (last = first + 1; last + 1 < crossings.size() && cell_of(last) / BRICK_CELLS == brick;) ++last;
    const int number = brick_number(scene, medium, cell_of(first));
    if (number == BRICK_EMPTY) continue;
    const double rate = piece_row(scene, medium, number)[to_light ? PIECE_LIGHT : 0];
    if (rate >= PIECE_RATE_CELLS) {
      for (std::size_t i = first; i < last; ++i) {
        const ivec3 in = cell_of(i) % BRICK_CELLS;
        const int name = (in.z * BRICK_SAMPLES + in.y) * BRICK_SAMPLES + in.x;
        visit(piece_of(scene, medium, ray, crossings[i], crossings[i + 1], brick, static_cast<uint>(name)));
      }
      continue;
    }
    const double begin = crossings[first], length = crossings[last] - begin;
    const double count = std::max(1.0, std::ceil(rate * length * glm::length(ray.dir) - 0.75));
    for (double i = 0; i < count; ++i)
      visit(piece_of(scene, medium, ray, begin + length * (i / count), begin + length * ((i + 1) / count), brick,
                     static_cast<uint>(i)));
  }
}

// Calls visit(segment) from front to back.
template <class Visit>
void segments_visit(const PlannedScene& scene, const Medium& medium, const RayD& world, const Interval& span,
                    int method, const RandomStream& random, bool to_light, Visit visit) {
  if (span.empty()) return;
  const RayD ray = ray_to_cells(medium, world);
  if (medium.liquid >= 0)
    for (const SegmentD& segment : presence_segments(scene, medium, world, span)) visit(segment);
  else if (method_placement(method) == PLACEMENT_STEPS || medium.is_constant)
    march_visit(scene, medium, ray, span, method, random, visit);
  else if (method_placement(method) == PLACEMENT_PIECES)
    pieces_visit(scene, medium, ray, span, to_light, visit);
  else
    dda_visit(scene, medium, ray, span, method, visit);
}

}  // namespace

RayD ray_to_cells(const Medium& medium, const RayD& world) {
  return {affine_point(medium.cell_from_world, world.origin), affine_direction(medium.cell_from_world, world.dir)};
}

Interval medium_interval(const Medium& medium, const RayD& world, double t_min, double t_max) {
  const dvec3 lo = vec_promote(medium.lo), hi = vec_promote(medium.hi);
  const RayD ray = ray_to_cells(medium, world);
  return medium.region == REGION_SPHERE ? ellipsoid_interval(lo, hi, ray, {t_min, t_max})
                                        : box_interval(lo, hi, ray, {t_min, t_max});
}

std::vector<SegmentD> segments(const PlannedScene& scene, int medium, const RayD& ray, double t0, double t1, int method,
                               const RandomStream& random) {
  std::vector<SegmentD> found;
  const Medium m = medium_of(scene, medium, method);
  segments_visit(scene, m, ray, medium_interval(m, ray, t0, t1), method, random, false,
                 [&](const SegmentD& s) { found.push_back(s); });
  return found;
}

double optical_depth(const PlannedScene& scene, int medium, const RayD& ray, double t_max, int method, double* lookups,
                     const RandomStream& random, bool to_light) {
  const Medium m = medium_of(scene, medium, method);
  const Interval span = medium_interval(m, ray, 0, t_max);
  if (span.empty()) return 0;
  if (m.is_constant) return m.constant_density * (span.t1 - span.t0);
  if (to_light && method == METHOD_ADAPTIVE && m.light_steps) method = METHOD_MARCH_MIDPOINT;
  double depth = 0, count = 0;
  segments_visit(scene, m, ray, span, method, random, to_light, [&](const SegmentD& s) {
    depth += s.density_length;
    ++count;
  });
  if (lookups) *lookups += count * segment_lookups(m, method);
  return depth;
}

double density_length_gauss2(const PlannedScene& scene, const Medium& medium, const RayD& world,
                             const SegmentD& segment) {
  return dda_rule(scene, medium, ray_to_cells(medium, world), segment, RULE_GAUSS2);
}

double density_length_piece(const PlannedScene& scene, const Medium& medium, const RayD& world,
                            const SegmentD& segment) {
  return piece_density_length(scene, medium, ray_to_cells(medium, world), segment);
}

double segment_error_square(const PlannedScene& scene, const Medium& medium, const RayD& world,
                            const SegmentD& segment) {
  if (medium.is_constant) return 0;
  const double cells = (segment.t_end - segment.t_begin) * glm::length(ray_to_cells(medium, world).dir);
  return piece_row(scene, medium, brick_number(scene, medium, segment.cell))[PIECE_ROUGH] * cells;
}

int segment_lookups(const Medium& medium, int method) {
  return medium.is_constant ? 0 : rule_lookups(method_rule(method));
}

int method_exact(const Medium& medium) {
  if (medium.liquid >= 0) return METHOD_FINE;
  const int interpolated = medium.interpolation == INTERPOLATION_NEAREST ? FITS_NEAREST : FITS_TRILINEAR;
  return method_exact_of(medium.is_constant ? FITS_CONSTANT : interpolated);
}

}  // namespace brume::reference
