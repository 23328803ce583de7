// The stretch of a ray inside a medium, and density lookups in its bricks. Knows no radiometry.
#ifndef BRUME_LIB_MEDIUM_CL
#define BRUME_LIB_MEDIUM_CL
#include "lib/scene.cl"
#include "shapes/box.cl"

// A ray inside one medium, measured in world length s from where it enters: cell-space position = origin + s dir.
// Starting at the entry keeps float for the medium, however far the camera is.
typedef struct {
  float3 origin, dir;  // cell space; dir per world unit
  float t_begin;       // world distance of the entry along the ray
  float length;        // world length inside; <= 0: the ray misses the medium
} MediumRay;

// Cuts to the ellipsoid inscribed in [lo, hi], in the space where it is the unit sphere.
static inline int sphere_region_cut(float3 lo, float3 hi, float3 o, float3 d, float* t0, float* t1) {
  const float3 inv_radius = 2.0f / (hi - lo);
  const float3 so = (o - 0.5f * (lo + hi)) * inv_radius, sd = d * inv_radius;
  const float a = dot(sd, sd), b = dot(so, sd) / a;
  const float3 perpendicular = so - b * sd;
  const float half_squared = (1.0f - dot(perpendicular, perpendicular)) / a;
  if (!(half_squared > 0.0f)) return 0;
  const float half_chord = sqrt(half_squared);
  *t0 = fmax(*t0, -b - half_chord);
  *t1 = fmin(*t1, -b + half_chord);
  return *t0 <= *t1;
}

static inline MediumRay medium_ray(const Medium* medium, float3 origin, float3 dir, float t_max) {
  MediumRay r;
  r.dir = affine_dir(&medium->cell_from_world, dir);
  const float3 o = affine_point(&medium->cell_from_world, origin);
  const float3 lo = vec_unpack(medium->lo), hi = vec_unpack(medium->hi);
  float t0 = 0.0f, t1 = t_max;
#if BRUME_SPHERE_REGION
  const int inside = medium->region == REGION_SPHERE ? sphere_region_cut(lo, hi, o, r.dir, &t0, &t1)
                                                     : box_cut(lo, hi, o, r.dir, &t0, &t1);
#else
  const int inside = box_cut(lo, hi, o, r.dir, &t0, &t1);
#endif
  r.t_begin = t0;
  r.length = inside ? t1 - t0 : 0.0f;
  r.origin = fmin(fmax(vec_point(o, r.dir, t0), lo), hi);  // the entry, never outside by rounding
  return r;
}

// Up to W stretches of a ray, each inside one stored brick (or, for a constant medium, anywhere).
typedef struct {
  int count;
  float middle[W];                           // s of the middle
  float size[W];                             // world length; 0 beyond count
  int base[W];                               // first voxel of the brick
  float brick_x[W], brick_y[W], brick_z[W];  // its first cell
} Segments;

static inline void segment_push(Segments* out, float middle, float size, int base, int bx, int by, int bz) {
  const int i = out->count++;
  out->middle[i] = middle;
  out->size[i] = size;
  out->base[i] = base;
  out->brick_x[i] = (float)(bx * BRICK_CELLS);
  out->brick_y[i] = (float)(by * BRICK_CELLS);
  out->brick_z[i] = (float)(bz * BRICK_CELLS);
}

// Unused lanes get a size of 0 and a harmless place, so that all W can be computed.
static inline void segments_pad(Segments* out) {
  for (int i = out->count; i < W; ++i) {
    out->middle[i] = 0.0f;
    out->size[i] = 0.0f;
    out->base[i] = 0;
    out->brick_x[i] = 0.0f;
    out->brick_y[i] = 0.0f;
    out->brick_z[i] = 0.0f;
  }
}

// Brick-local coordinate of every lane at s, and its cell. Clamping keeps a position that rounding put just outside its brick
// in the brick; the interpolation goes on smoothly there.
static inline intW local_cell(floatW position) {
  return clamp(lanes_to_int(floor(position)), (intW)(0), (intW)(BRICK_CELLS - 1));
}

typedef struct {
  floatW x, y, z;
} LocalPoint;

static inline LocalPoint local_point(const MediumRay* ray, const Segments* at, floatW s) {
  LocalPoint p;
  p.x = mad_exact(s, (floatW)(ray->dir.x), (floatW)(ray->origin.x)) - lanes_load(at->brick_x);
  p.y = mad_exact(s, (floatW)(ray->dir.y), (floatW)(ray->origin.y)) - lanes_load(at->brick_y);
  p.z = mad_exact(s, (floatW)(ray->dir.z), (floatW)(ray->origin.z)) - lanes_load(at->brick_z);
  return p;
}

static inline intW sample_offset(const Segments* at, intW x, intW y, intW z) {
  return lanes_load(at->base) + (z * BRICK_SAMPLES + y) * BRICK_SAMPLES + x;
}

static inline floatW density_nearest(__global const float* voxels, const MediumRay* ray, const Segments* at, floatW s) {
  const LocalPoint p = local_point(ray, at, s);
  floatW here, next;
  lanes_gather2(voxels, sample_offset(at, local_cell(p.x), local_cell(p.y), local_cell(p.z)), &here, &next);
  return here;
}

static inline floatW density_trilinear(__global const float* voxels, const MediumRay* ray, const Segments* at,
                                       floatW s) {
  const LocalPoint p = local_point(ray, at, s);
  const intW x = local_cell(p.x), y = local_cell(p.y), z = local_cell(p.z);
  const floatW fx = p.x - lanes_to_float(x), fy = p.y - lanes_to_float(y), fz = p.z - lanes_to_float(z);
  const intW i = sample_offset(at, x, y, z);
  floatW a, b;
#define ALONG_X(out, offset)                   \
  lanes_gather2(voxels, i + (offset), &a, &b); \
  const floatW out = mad_exact(fx, b - a, a)
  ALONG_X(v00, 0);
  ALONG_X(v10, BRICK_SAMPLES);
  ALONG_X(v01, BRICK_SAMPLES * BRICK_SAMPLES);
  ALONG_X(v11, BRICK_SAMPLES * BRICK_SAMPLES + BRICK_SAMPLES);
#undef ALONG_X
  const floatW v0 = mad_exact(fy, v10 - v00, v00);
  const floatW v1 = mad_exact(fy, v11 - v01, v01);
  return mad_exact(fz, v1 - v0, v0);
}

#endif
