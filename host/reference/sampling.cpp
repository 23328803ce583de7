// Random numbers, positions within a pixel and camera rays: see the header and PICTURE.md.
#include "reference/sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace brume::reference {
namespace {

void pcg4d_mix(std::array<uint, 4>& v) {
  v[0] += v[1] * v[3];
  v[1] += v[2] * v[0];
  v[2] += v[0] * v[1];
  v[3] += v[1] * v[2];
}

uint bits_reversed(uint x) {
  uint reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= (x >> bit & 1u) << (31 - bit);
  return reversed;
}

// Moves binary digits, the first one in the highest bit; a digit moves by what stands before it and by the seed.
uint owen_scrambled(uint digits, uint seed) {
  uint x = bits_reversed(digits);
  x = x ^ 0x3d20adeau * x;
  x = (x + seed) * (seed / 65536u | 1u);
  x = x ^ 0x05526c56u * x;
  x = x ^ 0x53a22864u * x;
  return bits_reversed(x);
}

double uniform(uint bits) { return (bits >> 8) * 0x1p-24; }

}  // namespace

uint rng_bits(uint pixel, uint sample, uint dimension, uint seed) {
  std::array<uint, 4> v{pixel, sample, dimension, seed};
  for (uint& x : v) x = x * 1664525u + 1013904223u;
  pcg4d_mix(v);
  for (uint& x : v) x ^= x >> 16;
  pcg4d_mix(v);
  return v[0];
}

double rng_uniform(uint pixel, uint sample, uint dimension, uint seed) {
  return uniform(rng_bits(pixel, sample, dimension, seed));
}

uint sobol(uint index, int dimension) {
  uint direction = 1u << 31, digits = 0;
  for (; index != 0; index >>= 1) {
    if (index & 1u) digits ^= direction;
    direction = dimension == 0 ? direction >> 1 : direction ^ (direction >> 1);
  }
  return digits;
}

dvec2 sobol_scrambled(uint index, uint pixel, uint sample, uint seed) {
  return {uniform(owen_scrambled(sobol(index, 0), rng_bits(pixel, sample, 0, seed))),
          uniform(owen_scrambled(sobol(index, 1), rng_bits(pixel, sample, 1, seed)))};
}

dvec2 pixel_position(uint pixel, uint sample, int spp, uint seed) {
  if (spp <= 1) return {0.5, 0.5};
  return sobol_scrambled(sample, pixel, 0, seed);
}

static_assert(CAMERA_COUNT == 2, "camera_ray knows all");

RayD camera_ray(const Camera& camera, int x, int y, const dvec2& position) {
  const double film_x = 2 * (x + position.x) / camera.width - 1;
  const double film_y = 1 - 2 * (y + position.y) / camera.height;
  const dvec3 axis = vec_promote(camera.axis);
  const dvec3 forward = vec_unit(vec_promote(camera.forward));
  const dvec3 offset = film_x * vec_promote(camera.right) + film_y * vec_promote(camera.up);
  if (camera.type == CAMERA_ORTHOGRAPHIC) return {axis + offset, forward};
  return {axis + static_cast<double>(camera.back) * offset, vec_unit(forward + offset)};
}

FrameRayD frame_ray(const Frame& frame, int x, int y, const dvec2& position) {
  const RayD ray = camera_ray(frame.camera, x, y, position);
  const dvec3 forward = vec_unit(vec_promote(frame.camera.forward));
  const double behind = frame.camera.back / glm::dot(ray.dir, forward);  // the camera lies at t = -behind
  const dvec3 lo = vec_promote(frame.bounds_lo), hi = vec_promote(frame.bounds_hi);
  double enters = -behind, leaves = INFINITE;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.dir[axis] == 0) {
      if (ray.origin[axis] < lo[axis] || ray.origin[axis] > hi[axis]) leaves = -INFINITE;
      continue;
    }
    const double a = (lo[axis] - ray.origin[axis]) / ray.dir[axis], b = (hi[axis] - ray.origin[axis]) / ray.dir[axis];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  const double t = lo.x < hi.x && enters <= leaves ? enters : 0;
  return {{ray.at(t), ray.dir}, behind + t};
}

}  // namespace brume::reference
