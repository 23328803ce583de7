// What a surface that refracts does to a ray: which share of it goes through, and what it is inside of then.
#ifndef BRUME_MATERIALS_INSIDE_CL
#define BRUME_MATERIALS_INSIDE_CL
#include "materials/surface.cl"

static inline void inside_begin(int* inside) {
  for (int i = 0; i < INSIDE_MAX; ++i) inside[i] = -1;
}

// Beyond INSIDE_MAX the outermost is forgotten.
static inline void inside_enter(int* inside, int material) {
  for (int i = INSIDE_MAX - 1; i > 0; --i) inside[i] = inside[i - 1];
  inside[0] = material;
}

// 0: it was not inside of it.
static inline int inside_leave(int* inside, int material) {
  int found = 0;
  for (int i = 0; i < INSIDE_MAX; ++i) {
    found = found || inside[i] == material;
    if (found) inside[i] = i + 1 < INSIDE_MAX ? inside[i + 1] : -1;
  }
  return found;
}

// exp(-absorption * length) [Beer-Lambert], also for a length without end.
static inline float3 absorption_transmittance(const Scene* scene, int material, float length) {
  const float3 absorption = vec_unpack(scene->materials[material].absorption);
  return select((float3)(1.0f), exp(-absorption * length), absorption > 0.0f);
}

// What is left over a length of the way inside of what was entered last.
static inline float3 inside_transmittance(const Scene* scene, const int* inside, float length) {
  return inside[0] < 0 ? (float3)(1.0f) : absorption_transmittance(scene, inside[0], length);
}

// Share of unpolarised light that is mirrored where `cosine` is that of the angle of incidence, eta the index of
// refraction of its side over that of the other.
static inline float fresnel_reflectance(float cosine, float eta) {
  const float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
  if (!(k >= 0.0f)) return 1.0f;
  const float through = sqrt(k);
  const float across = (eta * cosine - through) / fmax(eta * cosine + through, FLT_MIN);
  const float along = (cosine - eta * through) / fmax(cosine + eta * through, FLT_MIN);
  return 0.5f * (across * across + along * along);
}

#endif
