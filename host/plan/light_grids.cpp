// Light grids: which lattice each light gets in each medium.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

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

// The box of a medium divided evenly: the longest side in render.light_grid parts, the others in as many of that size
// as cover them.
struct Lattice {
  ivec3 points;
  dvec3 lo, spacing;  // cell space
};

Lattice lattice_of(const Medium& medium, int longest_parts) {
  const dmat4 world_from_cell = matrix(medium.world_from_cell);
  const dvec3 lo(medium.lo.x, medium.lo.y, medium.lo.z), size = dvec3(medium.hi.x, medium.hi.y, medium.hi.z) - lo;
  dvec3 sides;
  for (int axis = 0; axis < 3; ++axis) sides[axis] = glm::length(dvec3(world_from_cell[axis])) * size[axis];
  const double part = std::max({sides.x, sides.y, sides.z}) / longest_parts;
  const ivec3 parts = glm::max(ivec3(glm::ceil(sides / part - 1e-6)), 1);
  return {parts + 1, lo, size / dvec3(parts)};
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

}  // namespace

int light_grids_append(const SceneDesc& desc, const Medium& medium, RenderPlan& plan) {
  if (!wants_light_grids(desc, medium, plan)) return -1;
  const Lattice lattice = lattice_of(medium, desc.render.light_grid);
  const dmat4 cell_from_world = matrix(medium.cell_from_world);
  const int first = static_cast<int>(plan.light_grids.size());
  for (const Light& light : plan.lights) {
    const dvec3 travel(light.direction.x, light.direction.y, light.direction.z);
    LightGrid grid = light.type == LIGHT_DIRECTIONAL ? grid_along(lattice, transform_dir(cell_from_world, travel))
                                                     : grid_upright(lattice);
    grid.offset = static_cast<int>(plan.light_entries);
    plan.light_entries += static_cast<std::int64_t>(grid.nu) * grid.nv * grid.nk;
    constexpr std::int64_t ENTRIES_MAX = 0x7fffffff / 3;  // kernels count all channels in an int
    if (plan.light_entries > ENTRIES_MAX)
      throw InputError(desc.file.string() + ": /render/light_grid: " + std::to_string(desc.render.light_grid) +
                       " makes " + std::to_string(plan.light_entries) +
                       " entries or more over all media and lights; at most " + std::to_string(ENTRIES_MAX) +
                       " are allowed");
    plan.light_grids.push_back(grid);
  }
  return first;
}

}  // namespace brume
