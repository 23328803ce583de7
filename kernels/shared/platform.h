// Makes one header readable by C++17 and OpenCL C 1.2: scalar names, namespace, layout assertions.
// Keyed on __OPENCL_C_VERSION__ because a bare clang (the lint) does not define __OPENCL_VERSION__.
#ifndef BRUME_SHARED_PLATFORM_H
#define BRUME_SHARED_PLATFORM_H

#ifdef __OPENCL_C_VERSION__
#define BRUME_SHARED_BEGIN
#define BRUME_SHARED_END
#define BRUME_LAYOUT(type, size) _Static_assert(sizeof(type) == (size), #type " has another size on this device")
#else
#include <cstdint>
#define BRUME_SHARED_BEGIN namespace brume {
#define BRUME_SHARED_END }
#define BRUME_LAYOUT(type, size)                                                \
  static_assert(sizeof(type) == (size), #type " has another size on the host"); \
  static_assert(alignof(type) == 4, #type " must hold 4-byte scalars only")
#endif

// Every struct that crosses has its row in shared/layout.h as well: fields and offsets are compared there.
BRUME_SHARED_BEGIN
#ifndef __OPENCL_C_VERSION__
using uint = std::uint32_t;
#endif

// Three floats without the padding of float3: the same 12 bytes for both compilers.
typedef struct {
  float x, y, z;
} Packed3;
BRUME_LAYOUT(Packed3, 12);

// Affine map, 3 rows of (x, y, z, offset): p'_i = m[4i] x + m[4i+1] y + m[4i+2] z + m[4i+3].
typedef struct {
  float m[12];
} Affine;
BRUME_LAYOUT(Affine, 48);
BRUME_SHARED_END

#endif
