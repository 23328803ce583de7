// What an item costs at least, counted by hand from the kernels: an fma is 2, sums, products, comparisons, minima and
// conversions are 1. Indices of bricks and how a ray is set up are left out: a row that spends its time on them is far
// from its limit, and that is what the roofline is to show.
#include <cmath>

#include "base/error.hpp"
#include "roofline_parts.hpp"
#include "shared/aov.h"
#include "shared/medium.h"
#include "shared/ray.h"
#include "shared/shape.h"

namespace brume::bench {

namespace {

struct CostRow {
  const char* name;
  double bytes, flops, loads;
  const char* because;
};

constexpr double RAY = sizeof(Ray), HIT = sizeof(Hit), MEDIUM = sizeof(MediumResult), SAMPLE = sizeof(Sample),
                 PIXEL = sizeof(FilmPixel), WORK = sizeof(Work), SURFACE = sizeof(SurfaceResult), VALUES = BRICK_VALUES,
                 CELLS = BRICK_CELLS * BRICK_CELLS * BRICK_CELLS;

// clang-format off
constexpr CostRow COSTS[] = {
    {"copied byte", 1, 0, 0, "half of it read, half written"},
    {"flop", 0, 1, 0, "of independent chains"},
    {"load", 0, 0, 1, "two neighbouring numbers out of the nearest cache"},
    {"lookup, nearest", 0, 2, 1, "one sample; product with the length and sum; each stored voxel read once at most"},
    {"lookup, trilinear", 0, 32, 4,
     "place 3 fma, 3 differences; 7 blends of a difference and an fma; an fma into the sum; eight samples in four "
     "pairs; each stored voxel read once at most"},
    {"cell", 0, 21, 0,
     "the nearest of three faces 3, middle 2, length 1; per axis a comparison, two sums, a difference, a product"},
    {"light-grid lookup", 0, 56, 4,
     "three coordinates 6; plane 5; in two planes two axes of slope, floor, difference, two bounds, rest 6; 7 blends "
     "21; eight points in four pairs; each point read once"},
    {"light-grid point", 4, 0, 0,
     "written once; the lookups of its piece of column, a voxel each; each stored voxel read once"},
    {"box", 0, 20, 0, "six planes of a difference and a product; 6 minima and maxima, widened, compared"},
    {"triangle", 0, 52, 0, "corners 21, edges 9, determinant 3, u and v 2, t 7, comparisons 10"},
    {"camera ray", WORK + RAY + HIT, 40, 0, "work read; ray and hit written; direction, its length, entry into bounds"},
    {"shadow ray", RAY + HIT + MEDIUM + SURFACE, 40, 0, "all of its hit read; result written; the surface's colour"},
    {"secondary ray", 3 * RAY + HIT, 40, 0, "written by its surface, moved into its wave; hit written; reflection"},
    {"primary_rays", WORK + RAY + HIT, 40, 0, "work read; ray and hit written; direction, its length"},
    {"traverse_dda", RAY + HIT + MEDIUM, 0, 0, "ray and hit read; result written"},
    {"shadow_transmittance", HIT, 0, 0, "hit read"},
    {"shade", RAY + HIT + MEDIUM + SAMPLE, 24, 0, "ray, hit and result read; sample written; weighed, summed up"},
    {"secondary_rays", SAMPLE, 0, 0, "sample read"},
    {"accumulate", WORK + SAMPLE + 2 * PIXEL, 40, 0, "work and sample read; pixel read and written; its sums"},
    {"transfer", WORK + 4 * PIXEL, 0, 0, "work written; pixels from film to device and back, each time read and written"},
    {"written pixel", PIXEL + 3, 60, 0, "sums read; three bytes of file at most; mean, curve"},
    {"byte of values", 1, 0, 0, "of float numbers, read or written; the file itself"},
    {"triangle of a tree", sizeof(Triangle) + 9 * 4 + 4, 0, 0,
     "read once; its corners and number written; at each level of a binary tree three bins and a box, 12"},
    {"voxel of a brick", 4 + 4 * VALUES / CELLS, 2, 0, "read; written with its share of a brick's rim; range"},
};
// clang-format on

}  // namespace

Cost cost_of(const std::string& name) {
  for (const CostRow& row : COSTS)
    if (row.name == name) return {row.bytes, row.flops, row.loads, row.because};
  throw RuntimeError("the roofline does not know what '" + name + "' costs");
}

Cost cost_of_reading(Cost cost, double bytes, double items) {
  cost.bytes += bytes / items;
  return cost;
}

Cost cost_of_ray(const std::string& name, std::size_t triangles, int width) {
  Cost cost = cost_of(name);
  const double leaves = std::max(double(triangles) / width, 1.0);
  cost.flops +=
      width * (std::ceil(std::log(leaves) / std::log(width)) * cost_of("box").flops + cost_of("triangle").flops);
  cost.because += "; a node a level of the tree, one block of triangles";
  return cost;
}

}  // namespace brume::bench
