// A participating medium over a brick grid (design §5).
// "Cell space": the space in which the DDA walks. Cell c spans [c, c+1) on each axis.
//   nearest:   cell = voxel; sample c is the value of the whole cell.
//   trilinear: cell c lies between sample c and sample c+1; the value at cell-space position p blends the 8 samples
//              floor(p) + {0,1} with weights p - floor(p).
// Bricks hold BRICK_CELLS³ cells with the BRICK_SAMPLES³ samples that a trilinear lookup of them needs, x fastest.
#ifndef BRUME_SHARED_MEDIUM_H
#define BRUME_SHARED_MEDIUM_H
#include "shared/platform.h"

#define BRICK_CELLS 8
#define BRICK_SAMPLES 9
#define BRICK_VALUES (BRICK_SAMPLES * BRICK_SAMPLES * BRICK_SAMPLES)
#define BRICK_EMPTY (-1)  // entry of a brick whose samples are all zero: not stored

// The index is cut into blocks of bricks too.
#define BRICK_BLOCK_SHIFT 3
#define BRICK_BLOCK (1 << BRICK_BLOCK_SHIFT)  // bricks along a side
#define BRICK_BLOCK_ENTRIES (BRICK_BLOCK * BRICK_BLOCK * BRICK_BLOCK)

BRUME_SHARED_BEGIN
enum MediumRegion { REGION_BOX, REGION_SPHERE };  // sphere: the ellipsoid inscribed in [lo, hi]; only for `constant`

// bricks:  ints, the index, of two levels. Block (b >> 3) of brick b: where in `bricks` its entries begin stands at
//          brick_offset + (z * blocks_y + y) * blocks_x + x, blocks = ceil(brick_n / 8). Entry of brick b, at that
//          + ((z & 7) * 8 + (y & 7)) * 8 + (x & 7): number n of its stored samples, which begin at
//          voxels[n * BRICK_VALUES], or BRICK_EMPTY. Blocks of the same entry throughout share them; bricks of one
//          constant value share their samples.
// ranges:  2 floats (min, max of the samples) per stored brick.
typedef struct {
  Affine cell_from_world;
  Affine world_from_cell;
  Packed3 lo;  // the medium fills [lo, hi] in cell space; outside its density is 0
  int brick_offset;
  Packed3 hi;
  int interpolation;
  Packed3 sigma_a;  // per world unit, times density
  int phase;
  Packed3 sigma_s;
  float g;
  Packed3 emission;  // radiance per world unit, times density
  int region;
  int cells_x, cells_y, cells_z;     // cells of the grid; cells outside [lo, hi] may exist as padding
  int brick_nx, brick_ny, brick_nz;  // ceil(cells / BRICK_CELLS)
  float constant_density;            // where is_constant
  int is_constant;                   // no bricks: the density is constant_density all over the region
  float step;                        // world length of a marching step for this medium
  int method;                        // Method, resolved: never auto
  int light_grids;    // 0: light is traced; else 1 + the number of the first of its light grids, one per light
  float track_sigma;  // extinction per density at which trackers collide: the largest σt, or what makes a glow seen
} Medium;
BRUME_LAYOUT(Medium, 224);
BRUME_SHARED_END
#endif
