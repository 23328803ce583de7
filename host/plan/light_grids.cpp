// Light grids: which lattice each light gets in each medium.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "base/error.hpp"
#include "flat/transform.hpp"
#include "plan/plan_parts.hpp"

namespace brume {

namespace {

using glm::ivec3;

// A grid pays where a ray to the light is a walk through voxels.
bool wants_light_grids(const SceneDesc& desc, const Medium& m, const RenderPlan& plan) {
  // Where lights are chosen, a grid for every light is what choosing spares.
  const bool chosen = plan.frame.light_picks < plan.frame.light_count;
  const bool extended = plan_lights_extend(plan);  // light comes from a place that each ray chooses for itself
  const bool scatters = std::max({m.sigma_s.x, m.sigma_s.y, m.sigma_s.z}) > 0;
  return desc.render.shadow == SHADOW_GRID && !m.is_constant && !plan.lights.empty() && scatters && !chosen &&
         !extended;
}

// A box divided evenly.
struct Lattice {
  ivec3 points;
  dvec3 lo, spacing;  // cell space
  double count() const { return double(points.x) * points.y * points.z; }
};

struct Box {
  dvec3 lo, hi;
  bool holds(const dvec3& p) const {
    return glm::all(glm::lessThanEqual(lo, p)) && glm::all(glm::lessThanEqual(p, hi));
  }
  dvec3 middle() const { return 0.5 * (lo + hi); }
};

Box box_of(const Medium& m) { return {dvec3(m.lo.x, m.lo.y, m.lo.z), dvec3(m.hi.x, m.hi.y, m.hi.z)}; }

dvec3 sides_of(const Medium& medium, const Box& box) {  // in the world
  const dmat4 world_from_cell = matrix(medium.world_from_cell);
  dvec3 sides;
  for (int axis = 0; axis < 3; ++axis)
    sides[axis] = glm::length(dvec3(world_from_cell[axis])) * (box.hi[axis] - box.lo[axis]);
  return sides;
}

// The longest side of a medium in render.light_grid parts.
double part_of(const Medium& medium, int longest_parts) {
  const dvec3 sides = sides_of(medium, box_of(medium));
  return std::max({sides.x, sides.y, sides.z}) / longest_parts;
}

// A box in the cell space of a medium in as many parts of that size as cover it.
Lattice lattice_of(const Medium& medium, const Box& box, double part) {
  const ivec3 parts = glm::max(ivec3(glm::ceil(sides_of(medium, box) / part - 1e-6)), 1);
  return {parts + 1, box.lo, (box.hi - box.lo) / dvec3(parts)};
}

dmat4 cell_from_cell(const Medium& to, const Medium& from) {
  return matrix(to.cell_from_world) * matrix(from.world_from_cell);
}

// The box of a medium as one along the axes of another's cell space. What sticks out by rounding alone does not.
Box box_seen(const Medium& from, const Medium& medium) {
  const dmat4 seen = cell_from_cell(from, medium);
  const Box own = box_of(medium), other = box_of(from);
  Box box{dvec3(INFINITY), dvec3(-INFINITY)};
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 p = transform_point(seen, dvec3(corner & 1 ? own.hi.x : own.lo.x, corner & 2 ? own.hi.y : own.lo.y,
                                                corner & 4 ? own.hi.z : own.lo.z));
    box = {glm::min(box.lo, p), glm::max(box.hi, p)};
  }
  const dvec3 rounding = 1e-5 * (other.hi - other.lo);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(box.lo[axis] - other.lo[axis]) < rounding[axis]) box.lo[axis] = other.lo[axis];
    if (std::abs(box.hi[axis] - other.hi[axis]) < rounding[axis]) box.hi[axis] = other.hi[axis];
  }
  return box;
}

// Row of grid_from_cell for one axis of the lattice.
glm::dvec4 lattice_row(const Lattice& lattice, int axis) {
  glm::dvec4 row(0.0);
  row[axis] = 1 / lattice.spacing[axis];
  row[3] = -lattice.lo[axis] / lattice.spacing[axis];
  return row;
}

void grid_maps(LightGrid& grid, const glm::dvec4& u, const glm::dvec4& v, const glm::dvec4& k) {
  const dmat4 grid_from_cell = glm::transpose(dmat4(u, v, k, glm::dvec4(0, 0, 0, 1)));
  grid.grid_from_cell = affine(grid_from_cell);
  grid.cell_from_grid = affine(glm::inverse(grid_from_cell));
}

LightGrid grid_upright(const Lattice& lattice) {
  LightGrid grid{};
  grid.nu = grid.columns_u = lattice.points.x;
  grid.nv = grid.columns_v = lattice.points.y;
  grid.nk = lattice.points.z;
  grid_maps(grid, lattice_row(lattice, 0), lattice_row(lattice, 1), lattice_row(lattice, 2));
  return grid;
}

// How many columns the planes hold among them, and the first: those of the last plane lie floor(slope (nk - 1)) beside
// the first's.
void columns_count(float slope, int nk, int n, int& first, int& count) {
  const int last = static_cast<int>(std::floor(slope * static_cast<float>(nk - 1)));
  first = std::min(last, 0);
  count = n + std::abs(last);
}

// A light that runs along an axis of the box but for rounding is taken to run exactly along it.
float slope_of(double slope, int nk) {
  return std::abs(slope) * (nk - 1) < LIGHT_GRID_INSET ? 0.0f : static_cast<float>(slope);
}

// Columns along a light that travels by `travel` in cell space per world unit; planes across the axis along which it
// crosses most of them, so that no column moves by more than one from plane to plane.
LightGrid grid_along(const Lattice& lattice, const dvec3& travel) {
  const dvec3 steps = travel / lattice.spacing, size = glm::abs(steps);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const int axis_u = (axis + 1) % 3, axis_v = (axis + 2) % 3;
  LightGrid grid{};
  grid.nk = lattice.points[axis];
  grid.slope_u = slope_of(-steps[axis_u] / steps[axis], grid.nk);
  grid.slope_v = slope_of(-steps[axis_v] / steps[axis], grid.nk);
  // A plane holds the columns that meet the box there or up to the planes beside: one more on either side, and one
  // because they do not begin where the box does.
  const glm::dvec4 margin(0, 0, 0, 1), k = lattice_row(lattice, axis);
  grid.nu = lattice.points[axis_u] + 3;
  grid.nv = lattice.points[axis_v] + 3;
  grid_maps(grid, lattice_row(lattice, axis_u) + static_cast<double>(grid.slope_u) * k + margin,
            lattice_row(lattice, axis_v) + static_cast<double>(grid.slope_v) * k + margin, k);
  columns_count(grid.slope_u, grid.nk, grid.nu, grid.first_u, grid.columns_u);
  columns_count(grid.slope_v, grid.nk, grid.nv, grid.first_v, grid.columns_v);
  grid.column_step = static_cast<float>(1 / size[axis]);
  grid.from_first = steps[axis] > 0;
  return grid;
}

LightGrid grid_for(const Lattice& lattice, const Medium& medium, const Light& light) {
  if (light.type != LIGHT_DIRECTIONAL) return grid_upright(lattice);
  const dvec3 travel(light.direction.x, light.direction.y, light.direction.z);
  return grid_along(lattice, transform_dir(matrix(medium.cell_from_world), travel));
}

// Entries for one light after the other.
void entries_take(const std::string& file, int longest_parts, LightGrid& grid, RenderPlan& plan) {
  constexpr std::int64_t ENTRIES_MAX = 0x7fffffff / 3;  // kernels count all channels in an int
  grid.offset = static_cast<int>(plan.light_entries);
  plan.light_entries += static_cast<std::int64_t>(grid.nu) * grid.nv * grid.nk;
  if (plan.light_entries > ENTRIES_MAX)
    throw InputError(file + ": /render/light_grid: " + std::to_string(longest_parts) + " makes " +
                     std::to_string(plan.light_entries) + " entries or more over all media and lights; at most " +
                     std::to_string(ENTRIES_MAX) + " are allowed");
}

// The same entries by the maps of another medium.
LightGrid grid_seen(LightGrid grid, const Medium& from, const Medium& medium) {
  const dmat4 seen = matrix(grid.grid_from_cell) * cell_from_cell(from, medium);
  grid.grid_from_cell = affine(seen);
  grid.cell_from_grid = affine(glm::inverse(seen));
  return grid;
}

constexpr double POINTS_MORE = 2;  // beside the media, where walks are short

// Media that take one grid together, the first of which fills it.
struct Together {
  std::vector<std::size_t> media;
  Lattice lattice;
};

// `first` and those of `others` that stand on one spot with it, if a lattice about all of them, as fine as the finest,
// has at most POINTS_MORE times the points that their own have: n media then cost n times one and not n times n.
Together together_with(std::size_t first, const std::vector<std::size_t>& others, const std::vector<Medium>& media,
                       int longest_parts) {
  const Medium& m = media[first];
  Together all{{first}, lattice_of(m, box_of(m), part_of(m, longest_parts))};
  const Lattice own = all.lattice;
  Box box = box_of(m);
  double part = part_of(m, longest_parts), points = own.count();
  for (const std::size_t other : others) {
    const Medium& o = media[other];
    const Box seen = box_seen(m, o);
    if (!box_of(m).holds(seen.middle()) && !box_of(o).holds(box_seen(o, m).middle())) continue;
    box = {glm::min(box.lo, seen.lo), glm::max(box.hi, seen.hi)};
    part = std::min(part, part_of(o, longest_parts));
    points += lattice_of(o, box_of(o), part_of(o, longest_parts)).count();
    all.media.push_back(other);
  }
  all.lattice = lattice_of(m, box, part);
  return all.lattice.count() <= POINTS_MORE * points ? all : Together{{first}, own};
}

}  // namespace

std::vector<int> light_grids_plan(const SceneDesc& desc, const std::vector<Medium>& media, RenderPlan& plan) {
  std::vector<int> first(media.size(), -1);
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < media.size(); ++i)
    if (wants_light_grids(desc, media[i], plan)) left.push_back(i);
  while (!left.empty()) {
    const std::size_t filler = left.front();
    const Together all =
        together_with(filler, {left.begin() + 1, left.end()}, media, static_cast<int>(desc.render.light_grid));
    std::vector<LightGrid> grids;
    for (const Light& light : plan.lights) {
      grids.push_back(grid_for(all.lattice, media[filler], light));
      grids.back().media = static_cast<int>(all.media.size());
      entries_take(desc.file.string(), desc.render.light_grid, grids.back(), plan);
    }
    for (const std::size_t m : all.media) {
      first[m] = static_cast<int>(plan.light_grids.size());
      for (const LightGrid& grid : grids)
        plan.light_grids.push_back(m == filler ? grid : grid_seen(grid, media[filler], media[m]));
      left.erase(std::find(left.begin(), left.end(), m));
    }
  }
  return first;
}

}  // namespace brume
