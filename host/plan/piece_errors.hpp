// What pieces and equal steps err by in each brick of a grid, whatever the tolerance: measured once for every plan.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "flat/flat_scene.hpp"

namespace brume {

constexpr std::array<int, 4> PIECES = {1, 2, 4, 8};       // of a brick; more are no cheaper than its cells
constexpr std::array<int, 4> LIGHT_STEPS = {1, 2, 4, 7};  // through a brick
constexpr double LINE_CELLS = BRICK_CELLS - 1;            // over which errors are measured

// Of one brick: errors of ∫ρ along a line of LINE_CELLS cells, in cells times density, by PIECES of two points each and
// by LIGHT_STEPS of one.
struct BrickErrors {
  std::int32_t brick;
  std::array<float, PIECES.size()> pieces;
  std::array<float, LIGHT_STEPS.size()> steps;
};

struct GridErrors {
  std::vector<BrickErrors> bricks;  // those that are stored, each once
  double mean_density = 0;          // of their samples
};

// Of the grids of one scene, which outlives it. Not for several threads.
class PieceErrors {
 public:
  const GridErrors& of(const FlatScene& flat, int grid);

 private:
  std::map<int, GridErrors> known_;
};

}  // namespace brume
