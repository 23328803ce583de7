// Textures and the light that a material sends to the viewer. Definitions: PICTURE, The pixel; shared/material.h.
#ifndef BRUME_MATERIALS_MATERIAL_CL
#define BRUME_MATERIALS_MATERIAL_CL
#include "materials/surface.cl"

static inline float3 texel_load(const Scene* scene, const Texture* t, int x, int y) {
  __global const float* p = scene->texels + 3 * (size_t)(t->offset + (uint)(y * t->width + x));
  return (float3)(p[0], p[1], p[2]);
}

// A coordinate within the image, [0, 1].
static inline float image_wrap(float x, int wrap) {
  if (wrap == WRAP_REPEAT) return x - floor(x);
  if (wrap != WRAP_MIRROR) return clamp(x, 0.0f, 1.0f);
  const float folded = x - 2.0f * floor(0.5f * x);
  return folded > 1.0f ? 2.0f - folded : folded;
}

// Index of the texel left of x and its right neighbour; returns the weight of the neighbour. Only where images are
// repeated is the last texel beside the first.
static inline float texel_pair(float x, int n, int wrap, int* i0, int* i1) {
  const int clamped = wrap != WRAP_REPEAT;
  const float wrapped = image_wrap(x, wrap) * (float)n - 0.5f;
  const float low = floor(wrapped);
  const int i = (int)low;
  *i0 = i < 0 ? (clamped ? 0 : n - 1) : min(i, n - 1);
  *i1 = i < 0 ? 0 : (*i0 + 1 >= n ? (clamped ? n - 1 : 0) : *i0 + 1);
  return wrapped - low;
}

static inline float3 texture_image(const Scene* scene, const Texture* t, float2 uv, uint* second) {
  const float u = t->uv_scale[0] * uv.x + t->uv_offset[0], v = t->uv_scale[1] * uv.y + t->uv_offset[1];
  *second = t->wrap == WRAP_ONCE && (u < 0.0f || u > 1.0f || v < 0.0f || v > 1.0f);
  if (*second) return (float3)(1.0f);
  int x0, x1, y0, y1;
  const float fx = texel_pair(u, t->width, t->wrap, &x0, &x1);
  const float fy = texel_pair(v, t->height, t->wrap, &y0, &y1);
  const float3 a = texel_load(scene, t, x0, y0), b = texel_load(scene, t, x1, y0);
  const float3 c = texel_load(scene, t, x0, y1), d = texel_load(scene, t, x1, y1);
  const float3 low = a + fx * (b - a);
  const float3 high = c + fx * (d - c);
  return fmax(t->base + t->gain * (low + fy * (high - low)), 0.0f);
}

// Color of the texture; *second is set where the hit lies in the second color of a checker or beside an image shown
// once.
OUTLINED float3 texture_lookup(const Scene* scene, int index, float2 uv, uint* second) {
  const Texture t = scene->textures[index];
  if (t.type == TEXTURE_IMAGE) return texture_image(scene, &t, uv, second);
  const float squares = floor(uv.x * t.scale) + floor(uv.y * t.scale);
  *second = (squares - 2.0f * floor(0.5f * squares)) != 0.0f;
  return vec_unpack(*second ? t.color_b : t.color_a);
}

// A color of a material times its texture, -1 for none; *second as above.
static inline float3 texture_times(const Scene* scene, Packed3 color, int texture, float2 uv, uint* second) {
  *second = 0;
#if BRUME_TEXTURED
  if (texture >= 0) return vec_unpack(color) * texture_lookup(scene, texture, uv, second);
#endif
  return vec_unpack(color);
}

// Radiance towards the viewer per irradiance E, for light that arrives along -to_light (N·L > 0 is the caller's to
// check).
static inline float3 material_reflect(const Material* m, float3 diffuse, float3 n, float3 to_light, float3 to_viewer) {
  const float n_dot_l = dot(n, to_light);
  float3 out = diffuse * (n_dot_l * INV_PI_F);
  if (m->model != MATERIAL_LAMBERT) {
    const float cosine = m->model == MATERIAL_PHONG ? dot(2.0f * n_dot_l * n - to_light, to_viewer)
                                                    : dot(n, normalize(to_light + to_viewer));
    if (cosine > 0.0f) out += vec_unpack(m->specular) * exp2(m->shininess * log2(cosine));
  }
  return out;
}

#endif
