// Entry points that run single device functions on arrays, for `brume check` and the kernel tests. All have one form:
// item i reads its floats of `in` and writes its floats of `out`; host/check knows the strides.
#include "density/density.cl"
#include "density/gradients.cl"
#include "lib/camera.cl"
#include "materials/inside.cl"
#include "materials/material.cl"
#include "materials/surface.cl"
#include "media/scatter.cl"
#include "shapes/cell_crossing.cl"
#include "shapes/together.cl"
#include "shared/aov.h"
#include "shared/layout.h"

#define PROBE(name) __kernel void name(SCENE_ARGS, uint count, __global const float* in, __global float* out)
#define PROBE_ITEM                          \
  const uint item = (uint)get_global_id(0); \
  if (item >= count) return;                \
  const Scene scene = SCENE_PACK;           \
  (void)scene

static inline float3 probe_load3(__global const float* p) { return (float3)(p[0], p[1], p[2]); }
static inline void probe_store3(float3 v, __global float* p) {
  p[0] = v.x;
  p[1] = v.y;
  p[2] = v.z;
}

// What liquids need before any other probe: out: their gradients
__kernel void probe_gradients(SCENE_ARGS, uint count, __global Voxel* out) {
  PROBE_ITEM;
  gradient_row(&scene, item, out);
}

// in: pixel, sample, dimension, seed as bits. out: u
PROBE(probe_rng) {
  PROBE_ITEM;
  __global const uint* v = (__global const uint*)(in + 4 * item);
  out[item] = rng_uniform(v[0], v[1], v[2], v[3]);
}

// in: pixel, sample as bits. out: origin, direction
PROBE(probe_camera) {
  PROBE_ITEM;
  __global const uint* v = (__global const uint*)(in + 2 * item);
  uint pixels[W], samples[W];
  for (int i = 0; i < W; ++i) {
    pixels[i] = v[0];
    samples[i] = v[1];
  }
  const CameraRays rays = camera_rays(frame, pixels, samples);
  for (int c = 0; c < 3; ++c) {
    out[6 * item + c] = lanes_last(rays.origin.v[c]);
    out[6 * item + 3 + c] = lanes_last(rays.dir.v[c]);
  }
}

// in: phase as bits, g, before, after. out: value
PROBE(probe_phase) {
  PROBE_ITEM;
  __global const float* v = in + 8 * item;
  out[item] = phase_eval(as_int(v[0]), v[1], probe_load3(v + 2), probe_load3(v + 5));
}

static inline void probe_store_hit(const Hit* hit, __global float* out) {
  out[0] = hit->primitive == PRIMITIVE_NONE ? INFINITY : hit->t;
  out[1] = as_float(hit->primitive);
  out[2] = hit->u;
  out[3] = hit->v;
  out[4] = as_float(hit->instance);
}

// in: origin, direction, t_max. out: t, primitive as bits, u, v, instance as bits
PROBE(probe_hit) {
  PROBE_ITEM;
  __global const float* v = in + 7 * item;
  const Hit hit = scene_hit(&scene, probe_load3(v), probe_load3(v + 3), v[6], 0);
  probe_store_hit(&hit, out + 5 * item);
}

#if RAYS_TOGETHER
// The same by W rays at once; of `any` only whether something is hit.
static inline void probe_together(const Scene* scene, uint item, uint count, __global const float* in, int any,
                                  __global float* out) {
  if (item % W != 0) return;
  RayLanes rays;
  for (uint i = 0; i < W; ++i) {
    __global const float* v = in + 7 * min(item + i, count - 1);
    ray_lane_set(&rays, i, probe_load3(v), probe_load3(v + 3), v[6]);
  }
  rays_hit(scene, &rays, any);
  for (uint i = 0; i < min((uint)W, count - item); ++i) {
    const Hit hit = ray_lane_hit(&rays, (int)i);
    if (any)
      out[item + i] = (float)(hit.primitive != PRIMITIVE_NONE);
    else
      probe_store_hit(&hit, out + 5 * (item + i));
  }
}

PROBE(probe_hit_together) {
  PROBE_ITEM;
  probe_together(&scene, item, count, in, 0, out);
}

PROBE(probe_occluded_together) {
  PROBE_ITEM;
  probe_together(&scene, item, count, in, 1, out);
}
#endif

// in: origin, direction, t_max. out: 1 when something is hit before t_max
PROBE(probe_occluded) {
  PROBE_ITEM;
  __global const float* v = in + 7 * item;
  out[item] = (float)scene_occluded(&scene, probe_load3(v), probe_load3(v + 3), v[6]);
}

// in: origin, direction, t, primitive as bits, u, v, instance as bits. out: geometric normal, shading normal, uv
PROBE(probe_surface) {
  PROBE_ITEM;
  __global const float* v = in + 11 * item;
  Hit hit;
  hit.t = v[6];
  hit.primitive = as_int(v[7]);
  hit.u = v[8];
  hit.v = v[9];
  hit.instance = as_int(v[10]);
  Surface s;
  surface_at(&scene, probe_load3(v), probe_load3(v + 3), &hit, &s);
  probe_store3(s.geometric_normal, out + 8 * item);
  probe_store3(s.normal, out + 8 * item + 3);
  out[8 * item + 6] = s.uv.x;
  out[8 * item + 7] = s.uv.y;
}

// in: 8 corners of a cell, iso, where a ray enters it, the way to where it leaves it. out: where it crosses the surface
// first as a share of that way, else -1
PROBE(probe_cell) {
  PROBE_ITEM;
  __global const float* v = in + 15 * item;
  CellRay cell;
  for (int i = 0; i < 8; ++i) cell.corner[i] = v[i];
  cell.iso = v[8];
  cell.p = probe_load3(v + 9);
  cell.d = probe_load3(v + 12);
  int inside = -1;
  out[item] = cell_crossing(&cell, &inside);
}

// in: cosine of the angle of incidence, ratio of the indices of refraction. out: share that is mirrored
PROBE(probe_fresnel) {
  PROBE_ITEM;
  out[item] = fresnel_reflectance(in[2 * item], in[2 * item + 1]);
}

// in: texture as bits, u, v. out: color, 1 in the second color of a checker or beside an image that is shown once
PROBE(probe_texture) {
  PROBE_ITEM;
  __global const float* v = in + 3 * item;
  uint second = 0;
  probe_store3(texture_lookup(&scene, as_int(v[0]), (float2)(v[1], v[2]), &second), out + 4 * item);
  out[4 * item + 3] = (float)second;
}

// in: light as bits, point. out: direction of travel, irradiance, distance
PROBE(probe_light) {
  PROBE_ITEM;
  __global const float* v = in + 4 * item;
  const LightSample s = light_sample(&scene, as_int(v[0]), probe_load3(v + 1), random_begin(frame, item, 0));
  probe_store3(s.travel, out + 7 * item);
  probe_store3(s.irradiance, out + 7 * item + 3);
  out[7 * item + 6] = s.distance;
}

// in: medium as bits, origin, direction, t_max. out: PROBE_SEGMENTS pairs (t of the sample, length), unused ones 0
#define PROBE_SEGMENTS 128
PROBE(probe_segments) {
  PROBE_ITEM;
  __global const float* v = in + 8 * item;
  __global float* o = out + 2 * PROBE_SEGMENTS * item;
  const Medium medium = media[as_int(v[0])];
  const MediumRay ray = medium_ray(&medium, probe_load3(v + 1), probe_load3(v + 4), v[7]);
  for (int i = 0; i < 2 * PROBE_SEGMENTS; ++i) o[i] = 0.0f;
  if (!(ray.length > 0.0f)) return;
  Walk walk = walk_begin(&scene, &medium, &ray, random_begin(frame, item, 0), WALK_SCATTERS);
  Segments at;
  int n = 0;
  for (walk_next(&scene, &medium, &ray, &walk, &at); at.count > 0; walk_next(&scene, &medium, &ray, &walk, &at)) {
    for (int i = 0; i < at.count && n < PROBE_SEGMENTS; ++i, ++n) {
      o[2 * n] = ray.t_begin + at.place[i];
      o[2 * n + 1] = at.size[i];
    }
  }
}

// in: medium as bits, origin, direction, t_max. out: ∫ρ
PROBE(probe_integral) {
  PROBE_ITEM;
  __global const float* v = in + 8 * item;
  const Medium medium = media[as_int(v[0])];
  const MediumRay ray = medium_ray(&medium, probe_load3(v + 1), probe_load3(v + 4), v[7]);
  uint lookups = 0;
  out[item] = walk_total(&scene, &medium, &ray, random_begin(frame, item, 0), WALK_SEEN, 0.0f, &lookups);
}

// in: medium as bits, 16 points in its cell space. out: their densities
#define PROBE_POINTS 16
PROBE(probe_density) {
  PROBE_ITEM;
  __global const float* v = in + (1 + 3 * PROBE_POINTS) * item;
  const Medium medium = media[as_int(v[0])];
  for (int first = 0; first < PROBE_POINTS; first += W) {
    float p[3][W], density[W];
    for (int i = 0; i < W; ++i)
      for (int axis = 0; axis < 3; ++axis) p[axis][i] = v[1 + 3 * (first + i) + axis];
    lanes_store(density_at(&scene, &medium, lanes_load(p[0]), lanes_load(p[1]), lanes_load(p[2])), density);
    for (int i = 0; i < W; ++i) out[PROBE_POINTS * item + first + i] = density[i];
  }
}

// in: origin, direction, t_max. out: radiance and transmittance of all media
PROBE(probe_scatter) {
  PROBE_ITEM;
  __global const float* v = in + 7 * item;
  const MediumResult result =
      media_scatter(&scene, probe_load3(v), probe_load3(v + 3), v[6], random_begin(frame, item, 0));
  probe_store3(vec_unpack(result.radiance), out + 6 * item);
  probe_store3(vec_unpack(result.transmittance), out + 6 * item + 3);
}

// in: material as bits, normal, to light, to viewer. out: radiance of irradiance 1; 0 for light from behind
PROBE(probe_material) {
  PROBE_ITEM;
  __global const float* v = in + 10 * item;
  const Material material = materials[as_int(v[0])];
  const float3 normal = probe_load3(v + 1), to_light = probe_load3(v + 4), to_viewer = probe_load3(v + 7);
  float3 sent = (float3)(0.0f);
  if (dot(normal, to_light) > 0.0f)
    sent = material_reflect(&material, vec_unpack(material.diffuse), normal, to_light, to_viewer);
  probe_store3(sent, out + 3 * item);
}

// out: of each shared struct its size, then where each of its fields lies, as this device lays it out
PROBE(probe_layout) {
  PROBE_ITEM;
  (void)in;
  int n = 0;
#define F(field) out[n++] = (float)(uint)(size_t)(&((Laid*)0)->field);
#define STRUCT(struct_type, fields)       \
  {                                       \
    typedef struct_type Laid;             \
    out[n++] = (float)(uint)sizeof(Laid); \
    fields                                \
  }
  BRUME_STRUCTS(STRUCT)
#undef STRUCT
#undef F
}
