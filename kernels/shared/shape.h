// Shapes: analytic ones in a short list, triangles (single ones and meshes) behind the BVH.
#ifndef BRUME_SHARED_SHAPE_H
#define BRUME_SHARED_SHAPE_H
#include "shared/platform.h"

// ROW(ID, name; kernels: NAME_hit and NAME_normal, help)
// The analytic shapes, which their 12 numbers say all of.
#define BRUME_CLOSED_FORMS(ROW)                                                             \
  ROW(SPHERE, sphere, "center, radius")                                                     \
  ROW(CYLINDER, cylinder, "closed cylinder: centre of the base, centre of the top, radius") \
  ROW(PLANE, plane, "unbounded: a point and the normal")                                    \
  ROW(QUAD, quad, "parallelogram corner + s u + t v, s and t in [0,1]")                     \
  ROW(BOX, box, "min, max, with a transform")

// All records. `triangle` and `mesh` are scene types too; both become Triangles.
#define BRUME_SHAPES(ROW) \
  BRUME_CLOSED_FORMS(ROW) \
  ROW(ISOSURFACE, isosurface, "where the density of a grid is iso")

BRUME_SHARED_BEGIN
enum ShapeType {
#define ROW(id, name, help) SHAPE_##id,
  BRUME_SHAPES(ROW)
#undef ROW
      SHAPE_COUNT
};

// data, by type (uv: texture coordinates of the hit)
//   sphere    0-2 center, 3 radius                       uv: u = atan2(-z, x)/2π mod 1, v = 1 - acos(y)/π of the unit
//   normal
//   cylinder  0-2 base, 3-5 unit axis, 6 height, 7 radius, 8-10 unit x axis of its frame
//                                                        uv: side u = azimuth/2π mod 1, v = height fraction; caps
//                                                        ((x+1)/2, (y+1)/2)
//   plane     0-2 point, 3-5 unit normal, 6-8 u axis, as long as a flat unit is in world units
//                                                        uv: (p - point)·u axis, (p - point)·(normal × u axis): world
//                                                        units
//   quad      0-2 corner, 3-5 unit normal, 6-8 s axis, 9-11 t axis: with (p - corner)·axis = s, t for p = corner + s u
//   + t v
//                                                        uv: (s, t)
//   box       0-11 Affine from world to the unit cube [0,1]³   uv: the face's two remaining coordinates, x before y
//   before z
//   isosurface 0 its number in FlatScene::isosurfaces, as a float    uv: 0
typedef struct {
  int type;
  int material;
  float pad[2];
  float data[12];
} Shape;
BRUME_LAYOUT(Shape, 64);

// Where the trilinear density of a grid in bricks (shared/medium.h) is `iso`. It closes at the border of [lo, hi] in
// cell space, outside of which the density is 0.
typedef struct {
  Affine cell_from_world;
  Packed3 lo;
  float iso;
  Packed3 hi;
  int brick_offset;
  int cells_x, cells_y, cells_z;
  int brick_nx, brick_ny, brick_nz;
  int masks;  // of stored brick n: ISO_MASK_WORDS words of FlatScene::iso_masks from masks + n * ISO_MASK_WORDS on
} Isosurface;
BRUME_LAYOUT(Isosurface, 108);

// Bit (z * 8 + y) * 8 + x of a brick's mask: its cell (x, y, z) may hold iso, however the voxels are stored.
#define ISO_MASK_WORDS 16

// One normal; normals blended over it; the light of its corners blended.
enum TriangleShading { TRIANGLE_FLAT, TRIANGLE_PHONG, TRIANGLE_GOURAUD };

// In the world, or of a mesh with instances in the space of that; the hit is (1-u-v) p0 + u p1 + v p2. Normals are
// unit; unused for TRIANGLE_FLAT.
typedef struct {
  Packed3 p[3];
  Packed3 n[3];
  float uv[6];  // u0 v0 u1 v1 u2 v2; zero when the mesh has none
  int material;
  int shading;
} Triangle;
BRUME_LAYOUT(Triangle, 104);

// A mesh that is held once where it stands in one of its places.
typedef struct {
  Affine mesh_from_world, world_from_mesh;
  int root;        // of the mesh's BVH
  int mesh;        // its number in FlatScene::meshes
  int material;    // instead of those of the triangles; -1: theirs
  float reach;     // how large coordinates get on the way there and back, in the world: PICTURE, Hits
  Packed3 lo, hi;  // a box about it in the world, wider than what rounding of that way comes to
} Instance;
BRUME_LAYOUT(Instance, 136);

// A primary key of everything that can be hit: analytic shapes first, triangles from FIRST_TRIANGLE on; of instances
// the triangle of the mesh, and the number of the instance beside it.
#define PRIMITIVE_NONE (-1)
#define FIRST_TRIANGLE (1 << 24)
#define INSTANCE_NONE (-1)

// One name of both for keys and random numbers; that of the primitive where there is no instance.
static inline uint primitive_name(int primitive, int instance) {
  return (uint)primitive + (uint)(instance - INSTANCE_NONE) * 0x165667B1u;
}
BRUME_SHARED_END
#endif
