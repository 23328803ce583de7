// floatW / intW: W floats side by side inside one work-item, W = BRUME_LANES. On a CPU they become one SIMD register;
// with W = 1 they are plain scalars and a GPU's own threads are the lanes. PoCL does not vectorise divergent loops by
// itself.
#ifndef BRUME_LIB_LANES_CL
#define BRUME_LIB_LANES_CL
#include "lib/options.cl"

#define W BRUME_LANES

// The smaller and the larger of two numbers that are not NaN: one instruction where fmin, which must pass over a NaN,
// takes four.
#define fmin_ordered(a, b) ((a) < (b) ? (a) : (b))
#define fmax_ordered(a, b) ((a) > (b) ? (a) : (b))

#if BRUME_FAST_FMA
#define mad_exact(a, b, c) fma(a, b, c)
#else
#define mad_exact(a, b, c) ((a) * (b) + (c))
#endif

#if W == 1
typedef float floatW;
typedef int intW;
#define lanes_load(p) (*(p))
#define lanes_store(v, p) (*(p) = (v))
#define lanes_to_int(v) ((int)(v))
#define lanes_to_float(v) ((float)(v))
#define lanes_select(when_false, when_true, condition) ((condition) ? (when_true) : (when_false))
#define lanes_any(condition) (condition)
#define lanes_all(condition) (condition)
#define lanes_sum(v) (v)
#define lanes_iota() (0.0f)
#define lanes_before(v) (0.0f)
#define lanes_gather_int(p, offset) ((p)[offset])
#define lanes_first(v) (v)
#define lanes_last(v) (v)
#define lanes_shift(first, v) (first)  // v moved on by one lane, behind `first`
#else
#define LANES_GLUE_(a, b) a##b
#define LANES_GLUE(a, b) LANES_GLUE_(a, b)
typedef LANES_GLUE(float, BRUME_LANES) floatW;
typedef LANES_GLUE(int, BRUME_LANES) intW;
#define lanes_load(p) LANES_GLUE(vload, BRUME_LANES)(0, p)
#define lanes_store(v, p) LANES_GLUE(vstore, BRUME_LANES)(v, 0, p)
#define lanes_to_int(v) LANES_GLUE(convert_int, BRUME_LANES)(v)
#define lanes_to_float(v) LANES_GLUE(convert_float, BRUME_LANES)(v)
#define lanes_select(when_false, when_true, condition) select(when_false, when_true, condition)
#define lanes_any(condition) lanes_any_of(LANES_GLUE(convert_char, BRUME_LANES)(condition))
#define lanes_all(condition) all(condition)
#define lanes_first(v) ((v).s0)
// Lanes as bytes of one or two words: `any` looks at lane by lane.
#if W == 4
static inline int lanes_any_of(char4 lanes) { return as_uint(lanes) != 0; }
#elif W == 8
static inline int lanes_any_of(char8 lanes) { return as_ulong(lanes) != 0; }
#else
static inline int lanes_any_of(char16 lanes) { return (as_ulong2(lanes).x | as_ulong2(lanes).y) != 0; }
#endif
#endif

// Sums in a fixed tree, so that a picture does not depend on the compiler; lanes_before: of the lanes before each.
#if W == 4
static inline float lanes_sum(floatW v) {
  const float2 a = v.lo + v.hi;
  return a.x + a.y;
}
#define lanes_last(v) ((v).s3)
#define lanes_shift(first, v) ((float4)(first, (v).xyz))
#define lanes_iota() ((float4)(0, 1, 2, 3))
static inline floatW lanes_before(floatW v) {
  v += (float4)(0, v.xyz);
  v += (float4)(0, 0, v.xy);
  return (float4)(0, v.xyz);
}
static inline intW lanes_gather_int(__global const int* p, intW o) {
  return (int4)(p[o.s0], p[o.s1], p[o.s2], p[o.s3]);
}
#elif W == 8
static inline float lanes_sum(floatW v) {
  const float4 a = v.lo + v.hi;
  const float2 b = a.lo + a.hi;
  return b.x + b.y;
}
#define lanes_last(v) ((v).s7)
#define lanes_shift(first, v) ((float8)(first, (v).s012, (v).s3456))
#define lanes_iota() ((float8)(0, 1, 2, 3, 4, 5, 6, 7))
static inline floatW lanes_before(floatW v) {
  v += (float8)(0, v.s012, v.s3456);
  v += (float8)(0, 0, v.s01, v.s2345);
  v += (float8)((float4)(0), v.lo);
  return (float8)(0, v.s012, v.s3456);
}
static inline intW lanes_gather_int(__global const int* p, intW o) {
  return (int8)(p[o.s0], p[o.s1], p[o.s2], p[o.s3], p[o.s4], p[o.s5], p[o.s6], p[o.s7]);
}
#elif W == 16
static inline float lanes_sum(floatW v) {
  const float8 a = v.lo + v.hi;
  const float4 b = a.lo + a.hi;
  const float2 c = b.lo + b.hi;
  return c.x + c.y;
}
#define lanes_last(v) ((v).sf)
#define lanes_shift(first, v) ((float16)(first, (v).s012, (v).s3456, (v).s789abcde))
#define lanes_iota() ((float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
static inline floatW lanes_before(floatW v) {
  v += (float16)(0, v.s012, v.s3456, v.s789abcde);
  v += (float16)(0, 0, v.s01, v.s2345, v.s6789abcd);
  v += (float16)((float4)(0), v.s0123, v.s456789ab);
  v += (float16)((float8)(0), v.lo);
  return (float16)(0, v.s012, v.s3456, v.s789abcde);
}
static inline intW lanes_gather_int(__global const int* p, intW o) {
  return (int16)(p[o.s0], p[o.s1], p[o.s2], p[o.s3], p[o.s4], p[o.s5], p[o.s6], p[o.s7], p[o.s8], p[o.s9], p[o.sa],
                 p[o.sb], p[o.sc], p[o.sd], p[o.se], p[o.sf]);
}
#endif

// x cut to [0, last], and 0 where it is no number; the whole number before it.
#define lanes_cut(x, last) fmin_ordered(fmax_ordered(x, (floatW)(0.0f)), last)
#define lanes_whole(x, last) lanes_to_int(lanes_cut(x, last))

// name(p, offset, &first, &second): p[offset] and p[offset + 1] of every lane, by load2(p) -> float2. One 8-byte load a
// lane is 1.3 times as fast as two of 4 bytes. Pairs are put side by side whole and taken apart at once: number by
// number the compiler makes of 16 lanes two chains of 13 permutations that wait for each other. Where several are
// loaded about the same places, let p differ and not offset: lanes come out of a register one by one, then only once.
#define PAIRS4(load2, p, a, b, c, d) \
  ((float8)((float4)(load2(p + a), load2(p + b)), (float4)(load2(p + c), load2(p + d))))
#if W == 1
#define LANES_GATHER2(name, type, load2)                                                        \
  static inline void name(__global const type* p, intW offset, floatW* first, floatW* second) { \
    const float2 q = load2(p + offset);                                                         \
    *first = q.x;                                                                               \
    *second = q.y;                                                                              \
  }
#elif W == 4
#define LANES_GATHER2(name, type, load2)                                                             \
  static inline void name(__global const type* p, intW o, floatW* first, floatW* second) {           \
    const float2 a = load2(p + o.s0), b = load2(p + o.s1), c = load2(p + o.s2), d = load2(p + o.s3); \
    *first = (float4)(a.x, b.x, c.x, d.x);                                                           \
    *second = (float4)(a.y, b.y, c.y, d.y);                                                          \
  }
#elif W == 8
#define LANES_GATHER2(name, type, load2)                                                               \
  static inline void name(__global const type* p, intW o, floatW* first, floatW* second) {             \
    const float16 pairs =                                                                              \
        (float16)(PAIRS4(load2, p, o.s0, o.s1, o.s2, o.s3), PAIRS4(load2, p, o.s4, o.s5, o.s6, o.s7)); \
    *first = pairs.even;                                                                               \
    *second = pairs.odd;                                                                               \
  }
#else
#define LANES_GATHER2(name, type, load2)                                                               \
  static inline void name(__global const type* p, intW o, floatW* first, floatW* second) {             \
    const float16 lower =                                                                              \
        (float16)(PAIRS4(load2, p, o.s0, o.s1, o.s2, o.s3), PAIRS4(load2, p, o.s4, o.s5, o.s6, o.s7)); \
    const float16 upper =                                                                              \
        (float16)(PAIRS4(load2, p, o.s8, o.s9, o.sa, o.sb), PAIRS4(load2, p, o.sc, o.sd, o.se, o.sf)); \
    *first = (float16)(lower.even, upper.even);                                                        \
    *second = (float16)(lower.odd, upper.odd);                                                         \
  }
#endif

// 1 - exp(-x) for x >= 0, within 3 ulp: below 1/2 its series, where the difference would cancel; a third of the time of
// expm1.
#define EXP_TERM(type, sum, x, factorial) mad_exact(sum, x, (type)(1.0f / (factorial)))
#define ONE_MINUS_EXP(name, type)                                                                \
  static inline type name(type x) {                                                              \
    type sum = EXP_TERM(type, EXP_TERM(type, (type)(-1.0f / 40320.0f), x, 5040.0f), x, -720.0f); \
    sum = EXP_TERM(type, EXP_TERM(type, EXP_TERM(type, sum, x, 120.0f), x, -24.0f), x, 6.0f);    \
    return mad_exact(mad_exact(sum, x, (type)(-0.5f)), x, (type)(1.0f)) * x;                     \
  }
ONE_MINUS_EXP(one_minus_exp_series, float)
#if W == 1
#define lanes_one_minus_exp_series one_minus_exp_series
#else
ONE_MINUS_EXP(lanes_one_minus_exp_series, floatW)
#endif

static inline float one_minus_exp(float x) { return x < 0.5f ? one_minus_exp_series(x) : 1.0f - exp(-x); }

static inline floatW lanes_one_minus_exp(floatW x) {
  const intW thin = x < (floatW)(0.5f);
  const floatW series = lanes_one_minus_exp_series(x);
  return lanes_all(thin) ? series : lanes_select(1.0f - exp(-x), series, thin);
}

// (1 - exp(-x)) / x for x >= 0, 1 at 0: the mean of exp(-t) over t in [0, x].
static inline floatW lanes_mean_exp(floatW x) {
  return lanes_select(lanes_one_minus_exp(x) / x, (floatW)(1.0f) - 0.5f * x, x < 1e-4f);
}

#define LOAD2_FLOAT(p) vload2(0, p)
LANES_GATHER2(lanes_gather2, float, LOAD2_FLOAT)

#endif
