// Steps through liquids, and gradients of their presence. See liquid.hpp.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "reference/liquid.hpp"

namespace brume::reference {
namespace {

constexpr double SLICES_ALONG = 1.0 / 8;  // rays that cross the planes of slices less than this have equal steps

// Where steps begin and end, t ascending.
std::vector<double> borders(const PlannedScene& scene, const Medium& medium, const RayD& ray, const Interval& span) {
  std::vector<double> t{span.t0};
  const dvec3 view = vec_promote(scene.frame.camera.forward);
  const double across = glm::dot(view, ray.dir), distance = medium.step;
  if (medium.slices && std::abs(across) >= SLICES_ALONG) {
    const double first = glm::dot(view, ray.at(span.t0)) / distance, last = glm::dot(view, ray.at(span.t1)) / distance;
    std::vector<double> planes;
    for (double plane = std::floor(std::min(first, last)); plane <= std::max(first, last) + 1; ++plane)
      planes.push_back((plane * distance - glm::dot(view, ray.origin)) / across);
    std::sort(planes.begin(), planes.end());
    for (const double plane : planes)
      if (plane > span.t0 && plane < span.t1) t.push_back(plane);
  } else {
    const double length = span.t1 - span.t0, count = std::max(1.0, std::ceil(length / distance - 1.0 / 1024));
    for (double i = 1; i < count; ++i) t.push_back(span.t0 + length * (i / count));
  }
  t.push_back(span.t1);
  return t;
}

// ∫ of a presence that goes evenly from a to b over [0, 1], 0 where it is below `outside`.
double mean_of(double a, double b, double outside) {
  if (a >= outside && b >= outside) return (a + b) / 2;
  if (a < outside && b < outside) return 0;
  const double above = std::max(a, b);
  return (above - outside) / std::abs(b - a) * (above + outside) / 2;
}

// Sample s of the grid, beyond which the nearest goes on.
float sample_of(const PlannedScene& scene, const Medium& medium, const ivec3& s) {
  const ivec3 cells(medium.cells_x, medium.cells_y, medium.cells_z),
      bricks(medium.brick_nx, medium.brick_ny, medium.brick_nz);
  const ivec3 at = glm::clamp(s, ivec3(0), cells), brick = glm::min(at / BRICK_CELLS, bricks - 1);
  const int number = brick_number(scene, medium, brick * BRICK_CELLS);
  if (number == BRICK_EMPTY) return 0;
  const ivec3 in = at - brick * BRICK_CELLS;
  return scene.voxels[static_cast<std::size_t>(number) * BRICK_VALUES +
                      static_cast<std::size_t>((in.z * BRICK_SAMPLES + in.y) * BRICK_SAMPLES + in.x)];
}

// Half the difference of two samples as a device keeps it; it is taken in single precision.
double half_difference(float next, float last, int storage) {
  const float value = 0.5f * (next - last);
  if (storage == STORAGE_U8) {
    const float code = std::nearbyint(value * float(GRADIENT_PARTS) + 128.0f);
    return (double(code) - 128) / GRADIENT_PARTS;
  }
  if (storage == STORAGE_F32 || value == 0) return value;
  const int exponent = std::max(std::ilogb(value), -14);
  return std::ldexp(std::nearbyint(std::ldexp(value, 10 - exponent)), exponent - 10);
}

dvec3 sample_gradient(const PlannedScene& scene, const Medium& medium, const ivec3& s) {
  dvec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    ivec3 next = s, last = s;
    ++next[axis];
    --last[axis];
    gradient[axis] = half_difference(sample_of(scene, medium, next), sample_of(scene, medium, last), scene.storage);
  }
  return gradient;
}

}  // namespace

Medium presence_fine(Medium medium) {
  constexpr double STEPS_IN_A_VOXEL = 16;
  const glm::dmat3 cell(vec_promote(medium.world_from_cell.m), vec_promote(medium.world_from_cell.m + 4),
                        vec_promote(medium.world_from_cell.m + 8));
  medium.step = static_cast<float>(std::cbrt(std::abs(glm::determinant(cell))) / STEPS_IN_A_VOXEL);
  medium.slices = 0;
  return medium;
}

dvec3 presence_gradient(const PlannedScene& scene, const Medium& medium, const dvec3& p) {
  const ivec3 cell = cell_at(medium, p);
  const int number = brick_number(scene, medium, cell);
  const Liquid& liquid = scene.liquids[static_cast<std::size_t>(medium.liquid)];
  if (number == BRICK_EMPTY || scene.gradient_bricks[static_cast<std::size_t>(number + liquid.gradients)].medium < 0)
    return dvec3(0);
  const dvec3 share = p - dvec3(cell);
  dvec3 gradient(0);
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
    const dvec3 weights = glm::mix(1.0 - share, share, dvec3(at));
    gradient += weights.x * weights.y * weights.z * sample_gradient(scene, medium, cell + at);
  }
  return gradient;
}

std::vector<PresenceStep> presence_steps(const PlannedScene& scene, const Medium& medium, const RayD& world,
                                         const Interval& span) {
  const RayD ray = ray_to_cells(medium, world);
  const std::vector<double> t = borders(scene, medium, world, span);
  std::vector<PresenceStep> steps;
  double before = density_at(scene, medium, ray.at(t.front()));
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double after = density_at(scene, medium, ray.at(t[i]));
    steps.push_back({t[i - 1], t[i], before, after, static_cast<uint>(i)});
    before = after;
  }
  return steps;
}

std::vector<SegmentD> presence_segments(const PlannedScene& scene, const Medium& medium, const RayD& world,
                                        const Interval& span) {
  const double outside = scene.liquids[static_cast<std::size_t>(medium.liquid)].outside;
  const RayD ray = ray_to_cells(medium, world);
  std::vector<SegmentD> segments;
  for (const PresenceStep& step : presence_steps(scene, medium, world, span)) {
    SegmentD segment{step.t_begin, step.t_end, ivec3(0), 0, 0, step.id};
    segment.sample = segment.middle();
    segment.cell = cell_at(medium, ray.at(segment.sample));
    segment.density_length = mean_of(step.before, step.after, outside) * (step.t_end - step.t_begin);
    segments.push_back(segment);
  }
  return segments;
}

}  // namespace brume::reference
