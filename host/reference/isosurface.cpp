// See the header and PICTURE, Isosurfaces.
#include "reference/isosurface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

#include "reference/medium.hpp"

namespace brume::reference {
namespace {

// What places the grid; the rest of a medium is not read.
Medium grid_of(const Isosurface& s) {
  Medium m{};
  m.cell_from_world = s.cell_from_world;
  m.lo = s.lo;
  m.hi = s.hi;
  m.brick_offset = s.brick_offset;
  m.cells_x = s.cells_x;
  m.cells_y = s.cells_y;
  m.cells_z = s.cells_z;
  m.brick_nx = s.brick_nx;
  m.brick_ny = s.brick_ny;
  m.brick_nz = s.brick_nz;
  m.interpolation = INTERPOLATION_TRILINEAR;
  m.region = REGION_BOX;
  m.liquid = -1;
  return m;
}

// Where the ray passes from cell to cell, ascending, from the first to the last of the interval.
std::vector<double> borders_of(const RayD& cells, const Interval& span) {
  std::vector<double> borders{span.t0, span.t1};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = cells.at(span.t0)[axis], b = cells.at(span.t1)[axis];
    if (cells.dir[axis] == 0) continue;
    for (double plane = std::ceil(std::min(a, b)); plane <= std::floor(std::max(a, b)); ++plane) {
      const double t = (plane - cells.origin[axis]) / cells.dir[axis];
      if (t > span.t0 && t < span.t1) borders.push_back(t);
    }
  }
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  return borders;
}

// Density less iso along one cell, as a function of the share of the way through it.
class CellDensity {
 public:
  CellDensity(const PlannedScene& scene, const Medium& grid, double iso, const RayD& cells, double from, double to)
      : scene_(scene), grid_(grid), iso_(iso), cells_(cells), from_(from), to_(to) {
    cell_ = cell_at(grid, cells.at((from + to) / 2));
  }
  double t(double share) const { return from_ + share * (to_ - from_); }
  double at(double share) const { return density_in_cell(scene_, grid_, cell_, cells_.at(t(share))) - iso_; }

  // Ends of the parts in which it only rises or only falls. The cubic goes through four of its values.
  std::vector<double> monotone_parts() const {
    const double f0 = at(0), f1 = at(1.0 / 3), f2 = at(2.0 / 3), f3 = at(1);
    const double c1 = (-11 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 2, c2 = 9 * (2 * f0 - 5 * f1 + 4 * f2 - f3) / 2,
                 c3 = 9 * (-f0 + 3 * f1 - 3 * f2 + f3) / 2;
    std::vector<double> ends{0, 1};
    const auto add = [&](double u) {
      if (u > 0 && u < 1) ends.push_back(u);
    };
    const double square = c2 * c2 - 3 * c3 * c1;
    if (square > 0) {
      const double q = -(c2 + std::copysign(std::sqrt(square), c2));
      add(q / (3 * c3));
      add(c1 / q);
    }
    std::sort(ends.begin(), ends.end());
    return ends;
  }

  // The one change of side between two shares, by halves.
  double change(double a, double b) const {
    const bool above = at(a) > 0;
    for (int halving = 0; halving < 60; ++halving) ((at((a + b) / 2) > 0) == above ? a : b) = (a + b) / 2;
    return (a + b) / 2;
  }

 private:
  const PlannedScene& scene_;
  const Medium& grid_;
  double iso_;
  const RayD& cells_;
  double from_, to_;
  ivec3 cell_;
};

// t of the first change of side; `inside` is then the new one.
std::optional<double> first_change(const PlannedScene& scene, const Medium& grid, double iso, const RayD& cells,
                                   const Interval& span, std::optional<bool>& inside) {
  const std::vector<double> borders = borders_of(cells, span);
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const CellDensity density(scene, grid, iso, cells, borders[i], borders[i + 1]);
    const bool first = density.at(0) > 0;
    if (inside && *inside != first) {
      inside = first;
      return borders[i];
    }
    inside = first;
    const std::vector<double> ends = density.monotone_parts();
    for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
      if ((density.at(ends[part + 1]) > 0) == first) continue;
      inside = !first;
      return density.t(density.change(ends[part], ends[part + 1]));
    }
  }
  return std::nullopt;
}

// The side of the grid's border that is nearest, as shared/ray.h counts them.
double border_nearest(const Medium& grid, const dvec3& p) {
  int side = 0;
  double least = INFINITE;
  for (int axis = 0; axis < 3; ++axis)
    for (int upper = 0; upper < 2; ++upper) {
      const double off = std::abs(vec_promote(upper ? grid.hi : grid.lo)[axis] - p[axis]);
      if (off < least) side = 1 + 2 * axis + upper;
      least = std::min(least, off);
    }
  return side;
}

dvec3 to_world(const Isosurface& s, const dvec3& n) { return vec_unit(affine_normal(s.cell_from_world, n)); }

}  // namespace

HitD isosurface_hit(const PlannedScene& scene, const Isosurface& surface, const RayD& ray, double t_max) {
  const Medium grid = grid_of(surface);
  const Interval span = medium_interval(grid, ray, 0, INFINITE);
  if (span.empty()) return {};
  const RayD cells = ray_to_cells(grid, ray);
  std::optional<bool> inside;
  if (span.t0 > 0) inside = false;
  std::optional<double> t = first_change(scene, grid, surface.iso, cells, span, inside);
  bool border = t && *t == span.t0;
  if (!t && inside.value_or(false)) {
    t = span.t1;
    border = true;
    inside = false;
  }
  if (!t || !(*t > 0 && *t < t_max)) return {};
  return {*t, PRIMITIVE_NONE, border ? border_nearest(grid, cells.at(*t)) : 0, *inside ? 0.0 : 1.0};
}

Normals isosurface_normals(const PlannedScene& scene, const Isosurface& surface, const dvec3& point, const dvec3& dir,
                           const HitD& hit) {
  const Medium grid = grid_of(surface);
  if (hit.u > 0) {
    const int side = static_cast<int>(hit.u) - 1;
    dvec3 outward(0);
    outward[side / 2] = side % 2 ? 1 : -1;
    return {to_world(surface, outward), to_world(surface, outward)};
  }
  const dvec3 lo = vec_promote(grid.lo), hi = vec_promote(grid.hi);
  const dvec3 p = glm::clamp(affine_point(surface.cell_from_world, point), lo, hi);
  const auto slope = [&](int axis, double from, double to) {
    dvec3 a = p, b = p;
    a[axis] = std::max(from, lo[axis]);
    b[axis] = std::min(to, hi[axis]);
    return (density_at(scene, grid, b) - density_at(scene, grid, a)) / (b[axis] - a[axis]);
  };
  dvec3 own, smooth;
  for (int axis = 0; axis < 3; ++axis) {
    own[axis] = -slope(axis, std::floor(p[axis]), std::floor(p[axis]) + 1);
    smooth[axis] = -slope(axis, p[axis] - 1, p[axis] + 1);
  }
  dvec3 geometric = to_world(surface, own);
  const double along = glm::dot(geometric, dir);
  if ((along > 0) != (hit.v > 0)) geometric = vec_unit(geometric - along * dir);
  if (smooth == dvec3(0)) return {geometric, geometric};
  const dvec3 shading = to_world(surface, smooth);
  const bool outward = glm::dot(glm::reflect(dir, shading), geometric) > 0;
  return {geometric, outward == (hit.v == 0) ? shading : geometric};
}

}  // namespace brume::reference
