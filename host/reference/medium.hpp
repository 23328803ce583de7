// Media along a ray: where a medium begins and ends, into which segments a method cuts that, and ∫ρ dt over each.
// Knows densities only: coefficients, phase functions and lights are the business of scatter.hpp.
#pragma once
#include <vector>

#include "plan/render_plan.hpp"
#include "reference/random.hpp"
#include "reference/vec.hpp"
#include "shared/method.h"

namespace brume::reference {

// A ray in a medium's cell space; t stays the world distance, so dir is not unit.
RayD ray_to_cells(const Medium& medium, const RayD& world);

// [t0, t1] of the medium's region along the ray, cut to [t_min, t_max]; empty when t0 >= t1. Rays along a face count as
// inside.
struct Interval {
  double t0, t1;
  bool empty() const { return !(t0 < t1); }
};
Interval medium_interval(const Medium& medium, const RayD& world, double t_min, double t_max);

// The cell of a position by the half-open rule; beyond the region's border the outermost cell.
ivec3 cell_at(const Medium& medium, const dvec3& cell_position);

// Number of the stored brick in which a cell of the grid lies, or BRICK_EMPTY.
int brick_number(const PlannedScene& scene, const Medium& medium, const ivec3& cell);

// Density by the medium's own interpolation; the second form blends the samples of a cell that is already known.
double density_at(const PlannedScene& scene, const Medium& medium, const dvec3& cell_position);
double density_in_cell(const PlannedScene& scene, const Medium& medium, const ivec3& cell, const dvec3& cell_position);

struct SegmentD {
  double t_begin, t_end;
  ivec3 cell;             // the cell of the middle
  double density_length;  // ∫ρ dt
  double sample;          // where density (of marchers) and light are sampled
  uint id;                // names its random numbers: the number of the step, or a hash of the cell
  double middle() const { return 0.5 * (t_begin + t_end); }
};

// The segments of one medium (an index into PlannedScene::media) within [t0, t1], in order and without gaps; none has
// length 0. `random` places the samples of marchers with jitter.
std::vector<SegmentD> segments(const PlannedScene& scene, int medium, const RayD& ray, double t0, double t1, int method,
                               const RandomStream& random = {});

// ∫ρ dt over [0, t_max] by the method, without coefficients. Adds to *lookups, if given, the evaluations of the
// density. to_light: `adaptive` walks rays to lights by rates of their own.
double optical_depth(const PlannedScene& scene, int medium, const RayD& ray, double t_max, int method,
                     double* lookups = nullptr, const RandomStream& random = {}, bool to_light = false);

// ∫ρ dt by two-point Gauss over any piece of a segment within one cell: its t_begin, t_end and cell count.
double density_length_gauss2(const PlannedScene& scene, const Medium& medium, const RayD& ray, const SegmentD& segment);

// The same by a piece of `adaptive`, wherever its two points lie.
double density_length_piece(const PlannedScene& scene, const Medium& medium, const RayD& ray, const SegmentD& segment);

// What ∫ρ over a segment of `adaptive` errs by, as the plan has measured it in the brick: the mean square.
double segment_error_square(const PlannedScene& scene, const Medium& medium, const RayD& ray, const SegmentD& segment);

// Evaluations of the density that one segment of the method costs: 0 in a constant medium.
int segment_lookups(const Medium& medium, int method);

// The method whose ∫ρ dt is exact for the medium; of a liquid steps of a small part of a voxel.
inline constexpr int METHOD_FINE = METHOD_COUNT;
int method_exact(const Medium& medium);

}  // namespace brume::reference
