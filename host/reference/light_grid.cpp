// See light_grid.hpp. The columns and planes are shared/light_grid.h's.
#include "reference/light_grid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace brume::reference {
namespace {

// Column at which plane k begins; the slope is a float and so is its product with k.
int first_of(float slope, int k) {
  const auto product = static_cast<float>(static_cast<double>(slope) * k);
  return static_cast<int>(std::floor(product));
}

bool holds(const LightGrid& grid, int u, int v, int k) {
  const int iu = u - first_of(grid.slope_u, k), iv = v - first_of(grid.slope_v, k);
  return iu >= 0 && iu < grid.nu && iv >= 0 && iv < grid.nv;
}

std::size_t index_of(const LightGrid& grid, int u, int v, int k) {
  const int iu = u - first_of(grid.slope_u, k), iv = v - first_of(grid.slope_v, k);
  return (static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.nv) + static_cast<std::size_t>(iv)) *
             static_cast<std::size_t>(grid.nu) +
         static_cast<std::size_t>(iu);
}

struct Column {
  int u, v, id;
};

// Where the column crosses plane k, moved into the box where it does so outside.
struct Crossing {
  dvec3 point;  // world
  bool moved;
};

Crossing crossing_of(const Medium& medium, const LightGrid& grid, const Column& column, int k) {
  const double margin = grid.column_step > 0 ? 1 : 0;
  const auto inside = [&](int at, double slope, int n, bool& moved) {
    const double begin = slope * k + margin, end = begin + n - 1 - 3 * margin;
    const double to = std::clamp(static_cast<double>(at), begin + LIGHT_GRID_INSET, end - LIGHT_GRID_INSET);
    moved = moved || (to != at && slope != 0);
    return to;
  };
  bool moved = false;
  const double u = inside(column.u, grid.slope_u, grid.nu, moved);
  const double v = inside(column.v, grid.slope_v, grid.nv, moved);
  return {affine_point(medium.world_from_cell, affine_point(grid.cell_from_grid, dvec3(u, v, k))), moved};
}

constexpr double TAU_LARGEST = 24;  // that a grid holds

void column_fill(const Context& context, const Medium& medium, std::size_t light, const LightGrid& grid,
                 const Column& column, std::vector<dvec3>& tau) {
  const int step = grid.from_first ? 1 : -1, begin = grid.from_first ? 0 : grid.nk - 1;
  const RandomStream random{static_cast<uint>(column.id), static_cast<uint>(light), context.scene.frame.seed};
  const dvec3* before = nullptr;  // τ of the point before, where this one lies behind it along the light
  for (int k = begin; k >= 0 && k < grid.nk; k += step) {
    if (!holds(grid, column.u, column.v, k)) {
      before = nullptr;
      continue;
    }
    const Crossing crossing = crossing_of(medium, grid, column, k);
    if (crossing.moved) before = nullptr;
    dvec3& here = tau[index_of(grid, column.u, column.v, k)];
    const LightSample sample = light_at(context.scene, context.scene.lights[light], crossing.point, random);
    double lookups = 0;
    if (sample.shines())
      here = (before ? *before : dvec3(0)) + media_tau(context, {crossing.point, -sample.travel},
                                                       before ? static_cast<double>(grid.column_step) : sample.distance,
                                                       random.child(static_cast<uint>(k)), lookups);
    here = glm::min(here, TAU_LARGEST);
    before = grid.column_step > 0 && !crossing.moved ? &here : nullptr;
  }
}

}  // namespace

LightDepths light_grids_make(const Context& context, const Medium& medium) {
  LightDepths depths;
  for (std::size_t l = 0; l < context.scene.lights.size(); ++l) {
    const LightGrid& grid = light_grid_of(context.scene, medium, l);
    depths.tau.emplace_back(static_cast<std::size_t>(grid.nu) * static_cast<std::size_t>(grid.nv) *
                            static_cast<std::size_t>(grid.nk));
    for (int id = 0; id < grid.columns_u * grid.columns_v; ++id)
      column_fill(context, medium, l, grid,
                  {grid.first_u + id % grid.columns_u, grid.first_v + id / grid.columns_u, id}, depths.tau.back());
  }
  return depths;
}

const LightGrid& light_grid_of(const PlannedScene& scene, const Medium& medium, std::size_t light) {
  return scene.light_grids.at(static_cast<std::size_t>(medium.light_grids) + light);
}

dvec3 light_grid_tau(const LightDepths& depths, const LightGrid& grid, const Medium& medium, std::size_t light,
                     const dvec3& point) {
  const dvec3 g = affine_point(grid.grid_from_cell, affine_point(medium.cell_from_world, point));
  const int k0 = std::clamp(static_cast<int>(std::floor(g.z)), 0, grid.nk - 2);
  dvec3 tau(0);
  for (int k = k0; k <= k0 + 1; ++k) {
    const int first_u = first_of(grid.slope_u, k), first_v = first_of(grid.slope_v, k);
    const int u = std::clamp(static_cast<int>(std::floor(g.x)), first_u, first_u + grid.nu - 2);
    const int v = std::clamp(static_cast<int>(std::floor(g.y)), first_v, first_v + grid.nv - 2);
    const double wk = k == k0 ? 1 - (g.z - k0) : g.z - k0;
    for (int corner = 0; corner < 4; ++corner) {
      const int du = corner & 1, dv = corner >> 1;
      const double wu = du ? g.x - u : 1 - (g.x - u), wv = dv ? g.y - v : 1 - (g.y - v);
      tau += wk * wu * wv * depths.tau[light][index_of(grid, u + du, v + dv, k)];
    }
  }
  return tau;
}

}  // namespace brume::reference
