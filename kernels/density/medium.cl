// The part of a ray inside a medium, and density lookups in its bricks. Knows no radiometry.
#ifndef BRUME_DENSITY_MEDIUM_CL
#define BRUME_DENSITY_MEDIUM_CL
#include "lib/scene.cl"
#include "lib/slab.cl"

#if BRUME_MEDIA == 1
#define MEDIA_END(scene) 1
#else
#define MEDIA_END(scene) ((scene)->frame->medium_count)
#endif

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
  const float3 entry = vec_point(o, r.dir, t0);
  r.origin = fmin_ordered(fmax_ordered(entry, lo), hi);  // the entry, never outside by rounding
  return r;
}

// Up to W segments of a ray, each inside one stored brick (or, for a constant medium, anywhere). (x, y, z) is the cell
// of the segment, or the first cell of its brick: the walk that fills them knows which, and says so as `within` below.
typedef struct {
  int count;       // how many have a length; 0 at the end of the ray. They come first; only marchers, whose steps lie
                   // in fixed lanes, leave gaps of size 0 where a brick is empty
  float begin[W];  // s at which the segment begins
  float place[W];  // s at which density and light are sampled: the middle, but for some marchers
  float size[W];   // world length; 0 beyond count
  int base[W];     // of the brick: the sample of cell (x, y, z) is at base + brick_stride(x, y, z)
  float x[W], y[W], z[W];
#if BRUME_STORAGE == 2
  float zero[W], part[W];  // of the brick: density = zero + part * what is stored
#endif
#if BRUME_RANDOM
  uint id[W];  // number of the segment along the ray: names its random numbers
#endif
#if BRUME_LIQUID
  float integral[W];  // ∫ρ over the segment, where the walk has found it already
#endif
#if BRUME_TRACKING
  float low[W];      // lower bound of the density in the brick
  float control[W];  // ∫ of such bounds from the segment before to this one
#endif
} Segments;

#define WITHIN_CELL 0                   // x, y, z is the cell itself
#define WITHIN_BRICK (BRICK_CELLS - 1)  // x, y, z is where the brick begins

#define brick_stride(x, y, z) (((z)*BRICK_SAMPLES + (y)) * BRICK_SAMPLES + (x))

// Unused lanes get a size of 0 and a harmless place, so that all W can be computed.
static inline void segments_pad(Segments* out) {
  for (int i = out->count; i < W; ++i) {
    out->begin[i] = 0.0f;
    out->place[i] = 0.0f;
    out->size[i] = 0.0f;
    out->base[i] = 0;
    out->x[i] = 0.0f;
    out->y[i] = 0.0f;
    out->z[i] = 0.0f;
#if BRUME_STORAGE == 2
    out->zero[i] = out->part[i] = 0.0f;
#endif
#if BRUME_RANDOM
    out->id[i] = 0;
#endif
#if BRUME_LIQUID
    out->integral[i] = 0.0f;
#endif
#if BRUME_TRACKING
    out->low[i] = 0.0f;
    out->control[i] = 0.0f;
#endif
  }
}

// A lookup of every lane: where its eight samples begin, and how far the point is from the first of them. The cell is
// clamped: a position that rounding put just outside stays with its cell, and the interpolation goes on smoothly there.
typedef struct {
  intW sample;
  floatW fx, fy, fz;
} Lookup;

static inline intW lookup_cell(floatW position, int within) {
  return within == WITHIN_CELL ? (intW)(0) : lanes_whole(position, (floatW)((float)within));
}

// At s along the ray, in the cell or brick that begins at (x0, y0, z0); its first sample is `first`.
static inline Lookup lookup_from(const MediumRay* ray, floatW s, floatW x0, floatW y0, floatW z0, intW first,
                                 int within) {
  const floatW x = mad_exact(s, (floatW)(ray->dir.x), (floatW)(ray->origin.x)) - x0;
  const floatW y = mad_exact(s, (floatW)(ray->dir.y), (floatW)(ray->origin.y)) - y0;
  const floatW z = mad_exact(s, (floatW)(ray->dir.z), (floatW)(ray->origin.z)) - z0;
  const intW cx = lookup_cell(x, within), cy = lookup_cell(y, within), cz = lookup_cell(z, within);
  Lookup l;
  l.sample = first + brick_stride(cx, cy, cz);
  l.fx = x - lanes_to_float(cx);
  l.fy = y - lanes_to_float(cy);
  l.fz = z - lanes_to_float(cz);
  return l;
}

static inline Lookup lookup_at(const MediumRay* ray, const Segments* at, floatW s, int within) {
  const floatW x0 = lanes_load(at->x), y0 = lanes_load(at->y), z0 = lanes_load(at->z);
  const intW first = lanes_load(at->base) + brick_stride(lanes_to_int(x0), lanes_to_int(y0), lanes_to_int(z0));
  return lookup_from(ray, s, x0, y0, z0, first, within);
}

// Blending is linear: it may come before the brick's own scale.
static inline floatW density_of(const Segments* at, floatW stored) {
#if BRUME_STORAGE == 2
  return mad_exact(stored, lanes_load(at->part), lanes_load(at->zero));
#else
  (void)at;
  return stored;
#endif
}

static inline floatW density_nearest(__global const Voxel* voxels, const MediumRay* ray, const Segments* at, floatW s,
                                     int within) {
  const Lookup l = lookup_at(ray, at, s, within);
  floatW here, next;
  voxels_gather2(voxels, l.sample, &here, &next);
  return density_of(at, here);
}

// The eight samples of a lookup, as stored, in pairs along x; and their blend at a place between them.
static inline void lookup_corners(__global const Voxel* voxels, intW sample, floatW* corner) {
  for (int k = 0; k < 4; ++k)
    voxels_gather2(voxels + brick_stride(0, k & 1, k >> 1), sample, &corner[2 * k], &corner[2 * k + 1]);
}

static inline floatW corners_blend(const floatW* corner, const Lookup* l) {
  floatW along_x[4];
  for (int k = 0; k < 4; ++k) along_x[k] = mad_exact(l->fx, corner[2 * k + 1] - corner[2 * k], corner[2 * k]);
  const floatW v0 = mad_exact(l->fy, along_x[1] - along_x[0], along_x[0]);
  const floatW v1 = mad_exact(l->fy, along_x[3] - along_x[2], along_x[2]);
  return mad_exact(l->fz, v1 - v0, v0);
}

static inline floatW lookup_blend(__global const Voxel* voxels, const Lookup* l) {
  floatW corner[8];
  lookup_corners(voxels, l->sample, corner);
  return corners_blend(corner, l);
}

// The value of either interpolation, as stored.
__attribute__((always_inline)) static inline floatW lookup_value(const Medium* medium, __global const Voxel* voxels,
                                                                 const Lookup* l) {
  if (medium->interpolation != INTERPOLATION_NEAREST) return lookup_blend(voxels, l);
  floatW here, next;
  voxels_gather2(voxels, l->sample, &here, &next);
  return here;
}

static inline floatW density_trilinear(__global const Voxel* voxels, const MediumRay* ray, const Segments* at, floatW s,
                                       int within) {
  const Lookup l = lookup_at(ray, at, s, within);
  return density_of(at, lookup_blend(voxels, &l));
}

#endif
