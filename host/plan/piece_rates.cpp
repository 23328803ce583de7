// How finely `adaptive` walks a medium (PICTURE, Pieces): what pieces of each brick would err by, against what the
// tolerance allows.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "plan/plan_parts.hpp"

namespace brume {

namespace {

constexpr double SHARE_OF_BRICK = 0.05;  // of the tolerance: what the pieces of one brick may err by
constexpr double LIGHT_COARSER = 16;     // of rays to lights: a pixel is the mean of many, whose errors differ

double largest_sigma_t(const MediumBody& m) {
  return std::max({m.sigma_a.x + m.sigma_s.x, m.sigma_a.y + m.sigma_s.y, m.sigma_a.z + m.sigma_s.z});
}

// Flat length of a cell's side, by its volume.
double cell_side(const PlacedGrid& placed) {
  const float* m = placed.world_from_cell.m;
  const glm::dvec3 x(m[0], m[4], m[8]), y(m[1], m[5], m[9]), z(m[2], m[6], m[10]);
  return std::cbrt(std::abs(glm::dot(x, glm::cross(y, z))));
}

// What a medium is walked by, and how much of the tolerance each brick has.
struct Bricks {
  const GridErrors& errors;
  double side, allowed;  // of a cell; error of a brick, in cells times density
};

Bricks bricks_judge(double tolerance, const FlatScene& flat, std::size_t medium, const PlacedGrid& placed,
                    PieceErrors& known) {
  Bricks bricks{known.of(flat, placed.grid), cell_side(placed), 0};
  const double column = bricks.errors.mean_density * flat.sizes[medium].longest / 2;
  const double sigma_t = largest_sigma_t(flat.media[medium]);
  bricks.allowed = SHARE_OF_BRICK * tolerance * (sigma_t * column > 1 ? 1 / sigma_t : column) / bricks.side;
  return bricks;
}

// The rows of all bricks; what rays to lights then take on a CPU, in cycles.
double rates_set(const Bricks& bricks, float* rows) {
  constexpr double BRICK_CYCLES = 90, POINT_CYCLES = 8, CELL_BY_CELL = 480;
  double cycles = 0;
  for (const BrickErrors& its : bricks.errors.bricks) {
    float* row = rows + PIECE_ROW * its.brick;
    row[PIECE_ROUGH] = 0;  // cells are exact
    for (std::size_t i = PIECES.size(); i-- > 0;) {
      const double error = its.pieces[i];
      if (error > bricks.allowed * LIGHT_COARSER) break;
      row[PIECE_LIGHT] = float(PIECES[i]) / BRICK_CELLS;
      if (error > bricks.allowed) continue;
      row[0] = row[PIECE_LIGHT];
      row[PIECE_ROUGH] = static_cast<float>(std::pow(error * bricks.side, 2) / LINE_CELLS);
    }
    const double points = 2.0 * BRICK_CELLS * row[PIECE_LIGHT];
    cycles += BRICK_CYCLES + (row[PIECE_LIGHT] < PIECE_RATE_CELLS ? points * POINT_CYCLES : CELL_BY_CELL);
  }
  return cycles;
}

// The longest equal step of rays to lights by which bricks err as little in the mean; 0: it takes longer than pieces.
double light_step(const Bricks& bricks, double cycles) {
  constexpr double STEP_CYCLES = 12, STEPS_COARSER = 6;  // errors of equal steps are more alike from ray to ray
  const auto count = static_cast<double>(bricks.errors.bricks.size());
  for (std::size_t i = 0; i < LIGHT_STEPS.size(); ++i) {
    double squares = 0;
    for (const BrickErrors& its : bricks.errors.bricks) squares += double(its.steps[i]) * its.steps[i];
    if (squares > count * std::pow(bricks.allowed * STEPS_COARSER, 2)) continue;
    return count * LIGHT_STEPS[i] * STEP_CYCLES < cycles ? LINE_CELLS / LIGHT_STEPS[i] * bricks.side : 0;
  }
  return 0;
}

}  // namespace

void adaptive_plan(double tolerance, const FlatScene& flat, std::size_t medium, PieceErrors& known, RenderPlan& plan) {
  MediumWalk& walk = plan.walks[medium];
  walk.tolerance = static_cast<float>(tolerance);
  walk.tau_part = static_cast<float>(std::clamp(std::pow(270 * tolerance, 0.25), 1.0 / 64, 1.0));
  walk.tau_lit = static_cast<float>(std::clamp(std::log(16 / tolerance), 1.0, 24.0));
  walk.light_grade = static_cast<float>(std::clamp(0.5 * std::pow(36 * tolerance, 0.25), double(LIGHT_GRADE), 0.5));
  const PlacedGrid& placed = flat.placed[static_cast<std::size_t>(medium_placed(flat.media[medium]))];
  if (placed.grid < 0) {
    walk.step = static_cast<float>(flat.sizes[medium].longest * std::min(0.25, std::pow(tolerance, 0.25)));
    return;
  }
  const Bricks bricks = bricks_judge(tolerance, flat, medium, placed, known);
  walk.piece_rates = static_cast<int>(plan.piece_rates.size());
  plan.piece_rates.resize(plan.piece_rates.size() + PIECE_ROW * flat.voxels.size() / BRICK_VALUES, PIECE_RATE_CELLS);
  const double cycles = rates_set(bricks, &plan.piece_rates[static_cast<std::size_t>(walk.piece_rates)]);
  const double step = light_step(bricks, cycles);
  walk.light_steps = step > 0;
  if (step > 0) walk.step = static_cast<float>(step);
}

}  // namespace brume
