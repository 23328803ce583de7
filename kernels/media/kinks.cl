// Where along a view ray the light that arrives is not smooth: at the cones of spots, and where its way through a
// medium begins to leave it by another face (PICTURE, Lit steps).
#ifndef BRUME_MEDIA_KINKS_CL
#define BRUME_MEDIA_KINKS_CL
#include "media/stretch.cl"

#define KINKS_MAX 64
#define CONES 8  // a spot's soft edge in equal parts of 1 - cos: what a grazing ray sees of it is no polynomial

// Those between two places, in no order.
typedef struct Kinks {
  float s[KINKS_MAX];
  int light[KINKS_MAX];  // whose light it is; -1: of any
  int count;
  int asked;  // the light whose kinks are added
  float from, until;
} Kinks;

static inline void kinks_begin(Kinks* k, float from, float until) {
  k->count = 0;
  k->asked = -1;
  k->from = from;
  k->until = until;
}

static inline void kink_add(Kinks* k, float s) {
  if (!(s > k->from && s < k->until && k->count < KINKS_MAX)) return;
  k->s[k->count] = s;
  k->light[k->count++] = k->asked;
}

// Where a ray in the light's own space, `from` the light, crosses the cone of 1 - cos = beside.
static inline void cone_kinks(Kinks* k, float3 from, float3 dir, float3 axis, float beside) {
  const float cosine = 1.0f - beside, square = cosine * cosine;
  const float along = dot(dir, axis), height = dot(from, axis);
  const float a = along * along - square, b = height * along - square * dot(from, dir);
  const float c = height * height - square * dot(from, from), root = b * b - a * c;
  if (!(root >= 0.0f)) return;
  for (int side = -1; side <= 1; side += 2) {
    const float s = ((float)side * sqrt(root) - b) / a;
    if (mad_exact(s, along, height) * cosine >= 0.0f) kink_add(k, s);
  }
}

// `point` lies at s = 0.
static inline void spot_kinks(Kinks* k, const Light* light, float3 point, float3 dir) {
  const float3 from = point - vec_unpack(light->position), axis = vec_unpack(light->direction);
  for (int i = 0; i <= CONES; ++i) {
    const float share = (float)i / (float)CONES;
    cone_kinks(k, from, dir, axis, mad_exact(share, light->inner - light->outer, light->outer));
  }
}

// Where the way from the ray to a light, in a box's cell space at `light` (a point) or along it, leaves the box through
// an edge: to both sides of it by another face. The four edges along axis a, b and c being the others.
static inline void edge_kinks(Kinks* k, const float* o, const float* d, const float* light, int is_point,
                              const float* lo, const float* hi, int a) {
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  for (int e = 0; e < 4; ++e) {
    const float edge_b = e & 1 ? hi[b] : lo[b], edge_c = e & 2 ? hi[c] : lo[c];
    const float to_b = is_point ? edge_b - light[b] : light[b], to_c = is_point ? edge_c - light[c] : light[c];
    const float s = ((o[c] - edge_c) * to_b - (o[b] - edge_b) * to_c) / (d[b] * to_c - d[c] * to_b);
    if (!(s > k->from && s < k->until)) continue;
    float at[3], way[3];
    for (int i = 0; i < 3; ++i) {
      at[i] = mad_exact(s, d[i], o[i]);
      way[i] = is_point ? light[i] - at[i] : light[i];
    }
    const float u = fabs(way[b]) > fabs(way[c]) ? (edge_b - at[b]) / way[b] : (edge_c - at[c]) / way[c];
    const float met = mad_exact(u, way[a], at[a]);
    if (u > 0.0f && (!is_point || u < 1.0f) && met >= lo[a] && met <= hi[a]) kink_add(k, s);
  }
}

// `point` lies at s = 0.
static inline void box_kinks(Kinks* k, const Medium* medium, const Light* light, float3 point, float3 dir) {
  float o[3], d[3], lo[3], hi[3], to[3];
  const int is_point = light->type != LIGHT_DIRECTIONAL;
  const float3 position = vec_unpack(light->position) * ldexp(1.0f, light->exponent);
  vstore3(affine_point(&medium->cell_from_world, point), 0, o);
  vstore3(affine_dir(&medium->cell_from_world, dir), 0, d);
  vstore3(vec_unpack(medium->lo), 0, lo);
  vstore3(vec_unpack(medium->hi), 0, hi);
  vstore3(is_point ? affine_point(&medium->cell_from_world, position)
                   : affine_dir(&medium->cell_from_world, -vec_unpack(light->direction)),
          0, to);
  for (int a = 0; a < 3; ++a) edge_kinks(k, o, d, to, is_point, lo, hi, a);
}

// Of the rule `gauss2`, but where segments end at kinks anyway or no light is taken at two points of them.
#define HAS_LIGHT_KINKS(scene, medium)                                                           \
  (SUMS_BY(scene, medium, GAUSS2) && !IS_PRODUCT(medium) && !PLACEMENT_IS(medium, COLLISIONS) && \
   !(METHOD_IS(medium, ADAPTIVE) && (medium)->light_grids < 0) && vec_max(vec_unpack((medium)->sigma_s)) > 0.0f)

// Adds those of all lights without an area along a ray's way through the medium: the cones, then what boxes do.
OUTLINED void kinks_of_lights(const Scene* scene, const Stretch* stretch, Kinks* k) {
  if (!LIGHTS_ALL(scene)) return;
  const float3 point = vec_point(stretch->origin, stretch->dir, stretch->ray->t_begin);
  for (int l = 0; USES_LIGHT(SPOT) && l < scene->frame->light_count && k->count < KINKS_MAX; ++l) {
    const Light light = scene->lights[l];
    k->asked = l;
    if (LIGHT_IS(&light, SPOT) && light.exponent == 0) spot_kinks(k, &light, point, stretch->dir);
  }
  for (int l = 0; l < scene->frame->light_count && k->count < KINKS_MAX; ++l) {
    const Light light = scene->lights[l];
    k->asked = l;
    if (LIGHT_IS(&light, SURFACE)) continue;
    for (int m = 0; m < MEDIA_END(scene); ++m) {
      const Medium medium = scene->media[m];
      if (medium.region == REGION_BOX) box_kinks(k, &medium, &light, point, stretch->dir);
    }
  }
}

#endif
