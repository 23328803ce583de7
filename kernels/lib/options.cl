// Every -D knob, its default and its meaning. The defaults make the generic kernel: any file here compiles alone, and
// host/render/kernel_options.cpp, the only place that writes -D strings, narrows them to what a scene needs.
#ifndef BRUME_LIB_OPTIONS_CL
#define BRUME_LIB_OPTIONS_CL

#ifndef BRUME_BUILTINS  // the compiler leaves built-in functions to be declared by lib/builtins.cl
#define BRUME_BUILTINS 0
#endif
#include "lib/builtins.cl"
#include "shared/method.h"

// Multiply-add is rounded once only where fma is written: kernels must not depend on what a compiler contracts.
#pragma OPENCL FP_CONTRACT OFF

#ifndef BRUME_LANES  // SIMD lanes inside a work-item: samples along a ray, boxes and triangles of a node. 1, 4, 8 or 16
#define BRUME_LANES 1
#endif
#ifndef BRUME_BVH_WIDTH  // children of a BVH node, triangles of a block: 4 or 8
#if BRUME_LANES < 8
#define BRUME_BVH_WIDTH 4
#else
#define BRUME_BVH_WIDTH 8
#endif
#endif
#ifndef BRUME_FAST_FMA  // the device rounds fma in hardware
#define BRUME_FAST_FMA 1
#endif

#ifndef BRUME_OUTLINE  // 1: large functions are compiled once and called; 0: inlined wherever they are used
#define BRUME_OUTLINE 0
#endif

// 0: no medium code; 1: one medium; 2: several, of which at most one is not constant or one walks alone; 3: up to
// MEDIA_TOGETHER; 4: any number
#ifndef BRUME_MEDIA
#define BRUME_MEDIA 4
#endif
#ifndef BRUME_STORAGE  // 0: voxels are floats; 1: halfs; 2: bytes between the bounds of their brick
#define BRUME_STORAGE 0
#endif
#ifndef BRUME_COLOR_TAU  // 0: sigma_t is grey in every medium, one optical depth serves three channels
#define BRUME_COLOR_TAU 1
#endif
#ifndef BRUME_METHODS_USED  // bit METHOD_x: some medium uses that method; -1, here and below: every row that there is
#define BRUME_METHODS_USED (-1)
#endif
#ifndef BRUME_JITTER  // some medium marches with jitter
#define BRUME_JITTER 1
#endif
#ifndef BRUME_TRACKING  // some medium tracks collisions
#define BRUME_TRACKING 1
#endif
#ifndef BRUME_ROULETTE  // the frame has a roulette threshold
#define BRUME_ROULETTE 1
#endif
#ifndef BRUME_SPHERE_REGION  // some medium fills a sphere instead of its box
#define BRUME_SPHERE_REGION 1
#endif
#ifndef BRUME_LIGHT_GRID  // some medium has a light grid
#define BRUME_LIGHT_GRID 1
#endif
#ifndef BRUME_LIQUID  // some medium is a liquid
#define BRUME_LIQUID 1
#endif
#ifndef BRUME_IN_SCATTERINGS_USED  // bit IN_SCATTERING_x of the frame
#define BRUME_IN_SCATTERINGS_USED (-1)
#endif
#ifndef BRUME_PHASES_USED  // bit PHASE_x
#define BRUME_PHASES_USED (-1)
#endif
#ifndef BRUME_SHAPES_USED  // bit SHAPE_x of the analytic shapes in the scene
#define BRUME_SHAPES_USED (-1)
#endif
#ifndef BRUME_SHAPE_BVH  // some shapes are behind a BVH
#define BRUME_SHAPE_BVH 1
#endif
#ifndef BRUME_TRIANGLES  // the scene has triangles
#define BRUME_TRIANGLES 1
#endif
#ifndef BRUME_INSTANCES  // some meshes are held once and stand in several places
#define BRUME_INSTANCES 1
#endif
#ifndef BRUME_GOURAUD  // some triangles blend the light of their corners
#define BRUME_GOURAUD 1
#endif
#ifndef BRUME_TEXTURED  // some material has a texture
#define BRUME_TEXTURED 1
#endif
#ifndef BRUME_SPECULAR  // some material reflects or refracts
#define BRUME_SPECULAR 1
#endif
#ifndef BRUME_CLEAR_SHADOWS  // light passes shapes that refract
#define BRUME_CLEAR_SHADOWS 1
#endif
#ifndef BRUME_STARTS_INSIDE  // camera rays may begin inside of shapes that refract
#define BRUME_STARTS_INSIDE 1
#endif
#ifndef BRUME_LIGHTS_USED  // bit LIGHT_x
#define BRUME_LIGHTS_USED (-1)
#endif
#ifndef BRUME_AMBIENT_OCCLUSION  // surfaces show how much of a white sky reaches them
#define BRUME_AMBIENT_OCCLUSION 1
#endif
#ifndef BRUME_LIGHTS_CHOSEN  // a point asks some of the lights, at random
#define BRUME_LIGHTS_CHOSEN 1
#endif

// Before a large function. PoCL compiles the body of a kernel three times over and what is inlined into it as often,
// and a cold build is most of what a small picture takes on a CPU; on a GPU a call costs more than that.
#if BRUME_OUTLINE
#define OUTLINED __attribute__((noinline)) static
#else
#define OUTLINED static inline
#endif

// For use in C conditions, where the compiler folds them; a preprocessor #if would take the enum's names for 0.
#define USES_METHOD(id) (((BRUME_METHODS_USED) >> METHOD_##id) & 1)

// The placements and rules of the methods in use, as bits.
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help) \
  | (USES_METHOD(id) ? 1 << PLACEMENT_##placement : 0)
enum { PLACEMENTS_USED = 0 BRUME_METHODS(ROW) };
#undef ROW
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help) \
  | (USES_METHOD(id) ? 1 << RULE_##rule : 0)
enum { RULES_USED = 0 BRUME_METHODS(ROW) };
#undef ROW
// Placements of those among them that are walked for their depth: a product needs no walk.
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help) \
  | (USES_METHOD(id) && RULE_##rule != RULE_PRODUCT ? 1 << PLACEMENT_##placement : 0)
enum { PLACEMENTS_WALKED = 0 BRUME_METHODS(ROW) };
#undef ROW
#define BRUME_RANDOM (BRUME_ROULETTE || BRUME_JITTER || BRUME_TRACKING || BRUME_LIGHTS_CHOSEN)
#define USES_PHASE(id) (((BRUME_PHASES_USED) >> PHASE_##id) & 1)
#define USES_SHAPE(id) (((BRUME_SHAPES_USED) >> SHAPE_##id) & 1)
#define USES_LIGHT(id) (((BRUME_LIGHTS_USED) >> LIGHT_##id) & 1)
// Folds where all lights of a scene are of one type.
#define LIGHT_IS(light, id) \
  (USES_LIGHT(id) && ((BRUME_LIGHTS_USED) == (1 << LIGHT_##id) || (light)->type == LIGHT_##id))
#define HAS_SURFACES ((BRUME_SHAPES_USED) || (BRUME_TRIANGLES))

// The rest of a ray is dropped once τ exceeds this in every channel: less than e^-24 = 4e-11 of what lies behind.
#define TAU_STOP 24.0f
#define TAU_BLACK 1e4f    // nothing gets through: exp(-1e4) is 0
#define TAU_FINITE 1e30f  // differences of depths stay numbers

#endif
