// Participating media. One is written as four structs, apart because each is shared or changed by itself:
//   BrickGrid   a grid in bricks, however many media show it       (of FlatScene, as the next two)
//   PlacedGrid  where it stands
//   MediumBody  what fills it: coefficients and phase function, or a Liquid
//   MediumWalk  how one picture walks through it                   (of RenderPlan)
// medium_join puts the four together: Medium, the only one that kernels read.
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

#define GRADIENT_ITEMS (BRICK_SAMPLES * BRICK_SAMPLES)  // of a brick, each a row of samples
#define GRADIENT_PARTS 254                              // a difference of presences, halved, is within ±1/2

// So many media are walked side by side along a view ray.
#define MEDIA_TOGETHER 16

BRUME_SHARED_BEGIN
enum MediumRegion { REGION_BOX, REGION_SPHERE };  // sphere: the ellipsoid inscribed in [lo, hi]; only for `constant`

// A grid cut into bricks, wherever it stands and however many media show it.
// bricks:  ints, the index, of two levels. Block (b >> 3) of brick b: where in `bricks` its entries begin stands at
//          brick_offset + (z * blocks_y + y) * blocks_x + x, blocks = ceil(brick_n / 8). Entry of brick b, at that
//          + ((z & 7) * 8 + (y & 7)) * 8 + (x & 7): number n of its stored samples, which begin at
//          voxels[n * BRICK_VALUES], or BRICK_EMPTY. Blocks of the same entry throughout share them; bricks of one
//          constant value share their samples.
// ranges:  2 floats (min, max of the samples) per stored brick.
// gradients: of the stored bricks of liquids, 4 values for every sample: the differences of its neighbours along x, y
//          and z, halved, and the sample itself; as voxels are stored, in bytes (value - 128) / GRADIENT_PARTS. Beyond
//          the grid the nearest sample goes on; bricks of one value have none.
typedef struct {
  int brick_offset;
  int cells_x, cells_y, cells_z;     // cells of the grid; cells outside a medium's [lo, hi] may exist as padding
  int brick_nx, brick_ny, brick_nz;  // ceil(cells / BRICK_CELLS)
} BrickGrid;
BRUME_LAYOUT(BrickGrid, 28);

// A density in the world: a grid, or one value all over a region.
typedef struct {
  Affine cell_from_world;
  Affine world_from_cell;
  Packed3 lo;  // it fills [lo, hi] in cell space; outside the density is 0
  int grid;    // -1: none, the density is constant_density
  Packed3 hi;
  int interpolation;
  int region;
  float constant_density;
} PlacedGrid;
BRUME_LAYOUT(PlacedGrid, 136);

// What fills it. A glow with a density of its own is a medium of its own (density -1), so that it keeps its own exact
// walk.
typedef struct {
  Packed3 sigma_a;  // per world unit, times density
  int density;      // placed grid that absorbs and scatters, -1: none
  Packed3 sigma_s;
  int glow;          // placed grid that emits, the density where that is not -1; -1: none
  Packed3 emission;  // radiance per world unit, times density
  int phase;
  float g;
  int liquid;  // -1: none
} MediumBody;
BRUME_LAYOUT(MediumBody, 56);

// A liquid: the density of its medium is its presence p, which counts as 0 below `outside`. Light is scattered where p
// is between `outside` and `inside`.
typedef struct {
  Packed3 diffuse;  // albedo times light_intensity
  float outside;
  Packed3 specular;
  float inside;
  Packed3 ambient;  // times that of the frame
  float shininess;
  float rate;     // 0: lit by the change of p; else by the way between outside and inside, so much per flat unit
  int gradients;  // brick of its gradients less brick of its samples
} Liquid;
BRUME_LAYOUT(Liquid, 56);

// Of a brick of gradients: where it lies, so that its neighbours are found.
typedef struct {
  int medium, x, y, z;
} GradientBrick;
BRUME_LAYOUT(GradientBrick, 16);

// How one picture walks through a medium.
typedef struct {
  int method;         // Method, resolved: never auto
  float step;         // world length of a marching step
  float light_grade;  // of the distance to a light: no step through a constant medium near it is longer
  float track_sigma;  // extinction per density at which trackers collide: the largest σt, or what makes a glow seen
  int light_grids;    // number of the first of its light grids, one per light; -1: light is traced
  float tolerance;    // of `adaptive`, as the next ones
  float tau_part;     // optical depth above which a segment is cut
  float tau_lit;      // optical depth behind which no light is asked for
  int piece_rates;    // its rows of RenderPlan::piece_rates begin there
  int light_steps;    // rays to lights take equal steps of `step` instead of pieces
  int slices;         // of a liquid: steps end on planes across the view, `step` apart
} MediumWalk;
BRUME_LAYOUT(MediumWalk, 44);

// All of it side by side, as kernels read it: one copy out of memory for every ray.
typedef struct {
  Affine cell_from_world, world_from_cell;
  Packed3 lo, hi;
  int brick_offset, cells_x, cells_y, cells_z, brick_nx, brick_ny, brick_nz;
  int interpolation, region, is_constant;
  float constant_density;
  Packed3 sigma_a, sigma_s, emission;
  int phase;
  float g;
  int method;
  float step, light_grade, track_sigma;
  int light_grids;
  float tolerance, tau_part, tau_lit;
  int piece_rates, light_steps;
  int liquid, slices;
} Medium;
BRUME_LAYOUT(Medium, 256);

#ifndef __OPENCL_C_VERSION__
static inline int medium_placed(MediumBody body) { return body.density >= 0 ? body.density : body.glow; }

// `grid` is not read where the density is constant.
static inline Medium medium_join(const BrickGrid* grid, const PlacedGrid* placed, const MediumBody* body,
                                 const MediumWalk* walk) {
  Medium m;
  m.cell_from_world = placed->cell_from_world;
  m.world_from_cell = placed->world_from_cell;
  m.lo = placed->lo;
  m.hi = placed->hi;
  m.brick_offset = grid->brick_offset;
  m.cells_x = grid->cells_x;
  m.cells_y = grid->cells_y;
  m.cells_z = grid->cells_z;
  m.brick_nx = grid->brick_nx;
  m.brick_ny = grid->brick_ny;
  m.brick_nz = grid->brick_nz;
  m.interpolation = placed->interpolation;
  m.region = placed->region;
  m.is_constant = placed->grid < 0;
  m.constant_density = placed->constant_density;
  m.sigma_a = body->sigma_a;
  m.sigma_s = body->sigma_s;
  m.emission = body->emission;
  m.phase = body->phase;
  m.g = body->g;
  m.method = walk->method;
  m.step = walk->step;
  m.light_grade = walk->light_grade;
  m.track_sigma = walk->track_sigma;
  m.light_grids = walk->light_grids;
  m.tolerance = walk->tolerance;
  m.tau_part = walk->tau_part;
  m.tau_lit = walk->tau_lit;
  m.piece_rates = walk->piece_rates;
  m.light_steps = walk->light_steps;
  m.liquid = body->liquid;
  m.slices = walk->slices;
  return m;
}
#endif
BRUME_SHARED_END
#endif
