// The built-in functions that kernels call, where BRUME_BUILTINS says that nobody else declares them. OpenCL C's own
// header declares 15 000, and PoCL reads it twice in each process that builds a program: 0.1 s. A function or a type
// that is missing here does not compile; attributes are those of that header, so that the machine code is the same.
#ifndef BRUME_LIB_BUILTINS_CL
#define BRUME_LIB_BUILTINS_CL
#if BRUME_BUILTINS

#define READS_NOTHING __attribute__((overloadable, const))
#define READS __attribute__((overloadable, pure))
#define WRITES __attribute__((overloadable))

// DECLARE(name, type) of each width.
#define SCALAR_AND_WIDE(DECLARE, name, type) \
  DECLARE(name, type)                        \
  DECLARE(name, type##2)                     \
  DECLARE(name, type##3)                     \
  DECLARE(name, type##4)                     \
  DECLARE(name, type##8)                     \
  DECLARE(name, type##16)
#define OF_ONE(name, type) type READS_NOTHING name(type);
#define OF_TWO(name, type) type READS_NOTHING name(type, type);
#define OF_THREE(name, type) type READS_NOTHING name(type, type, type);
#define OF_BITS(name, type) int READS_NOTHING name(type);

SCALAR_AND_WIDE(OF_ONE, sqrt, float)
SCALAR_AND_WIDE(OF_ONE, exp, float)
SCALAR_AND_WIDE(OF_ONE, log, float)
SCALAR_AND_WIDE(OF_ONE, log1p, float)
SCALAR_AND_WIDE(OF_ONE, sin, float)
SCALAR_AND_WIDE(OF_ONE, cos, float)
SCALAR_AND_WIDE(OF_ONE, acos, float)
SCALAR_AND_WIDE(OF_ONE, fabs, float)
SCALAR_AND_WIDE(OF_ONE, floor, float)
SCALAR_AND_WIDE(OF_ONE, ceil, float)
SCALAR_AND_WIDE(OF_TWO, fmin, float)
SCALAR_AND_WIDE(OF_TWO, fmax, float)
SCALAR_AND_WIDE(OF_TWO, copysign, float)
SCALAR_AND_WIDE(OF_THREE, fma, float)
SCALAR_AND_WIDE(OF_THREE, clamp, float)
SCALAR_AND_WIDE(OF_TWO, min, int)
SCALAR_AND_WIDE(OF_TWO, max, int)
SCALAR_AND_WIDE(OF_THREE, clamp, int)
SCALAR_AND_WIDE(OF_BITS, all, int)
SCALAR_AND_WIDE(OF_BITS, any, int)
OF_ONE(exp2, float)
OF_ONE(log2, float)
OF_TWO(pow, float)
OF_TWO(atan2, float)
OF_TWO(nextafter, float)
OF_BITS(isfinite, float)
OF_BITS(signbit, float)
OF_TWO(min, uint)
OF_TWO(max, uint)
OF_ONE(popcount, int)
OF_ONE(popcount, uint)
OF_ONE(popcount, long)
OF_ONE(popcount, ulong)
float READS_NOTHING ldexp(float, int);
float READS_NOTHING dot(float2, float2);
float READS_NOTHING dot(float3, float3);
float READS_NOTHING length(float2);
float READS_NOTHING length(float3);
float3 READS_NOTHING normalize(float3);
float3 READS_NOTHING cross(float3, float3);
size_t READS_NOTHING get_global_id(uint);

// Of each width: lanes, and what takes one number for all of them.
#define OF_LANES(n)                                          \
  float##n READS_NOTHING fmin(float##n, float);              \
  float##n READS_NOTHING fmax(float##n, float);              \
  float##n READS_NOTHING clamp(float##n, float, float);      \
  int##n READS_NOTHING min(int##n, int);                     \
  int##n READS_NOTHING max(int##n, int);                     \
  int##n READS_NOTHING clamp(int##n, int, int);              \
  float##n READS_NOTHING select(float##n, float##n, int##n); \
  int##n READS_NOTHING select(int##n, int##n, int##n);       \
  int##n READS_NOTHING signbit(float##n);                    \
  int##n READS_NOTHING convert_int##n(float##n);             \
  float##n READS_NOTHING convert_float##n(int##n);           \
  char##n READS_NOTHING convert_char##n(int##n);             \
  float##n READS vload##n(size_t, const __private float*);   \
  float##n READS vload##n(size_t, const __global float*);    \
  int##n READS vload##n(size_t, const __private int*);       \
  int##n READS vload##n(size_t, const __global int*);        \
  void WRITES vstore##n(float##n, size_t, __private float*); \
  void WRITES vstore##n(float##n, size_t, __global float*);  \
  void WRITES vstore##n(int##n, size_t, __private int*);
OF_LANES(2)
OF_LANES(3)
OF_LANES(4)
OF_LANES(8)
OF_LANES(16)

// What voxels and texels are stored as.
uchar2 READS vload2(size_t, const __global uchar*);
uchar4 READS vload4(size_t, const __global uchar*);
float READS_NOTHING convert_float(uchar);
float2 READS_NOTHING convert_float2(uchar2);
float4 READS_NOTHING convert_float4(uchar4);
uchar4 READS_NOTHING convert_uchar4_sat_rte(float4);
void WRITES vstore4(uchar4, size_t, __global uchar*);
float READS vload_half(size_t, const __global half*);
float2 READS vload_half2(size_t, const __global half*);
float4 READS vload_half4(size_t, const __global half*);
void WRITES vstore_half4_rte(float4, size_t, __global half*);

#undef READS_NOTHING
#undef READS
#undef WRITES
#undef SCALAR_AND_WIDE
#undef OF_ONE
#undef OF_TWO
#undef OF_THREE
#undef OF_BITS
#undef OF_LANES
#endif
#endif
