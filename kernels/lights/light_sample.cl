// What a light sends to a point, before anything blocks or weakens it.
#ifndef BRUME_LIGHTS_LIGHT_SAMPLE_CL
#define BRUME_LIGHTS_LIGHT_SAMPLE_CL
#include "lib/scene.cl"

typedef struct {
  float3 travel;      // unit, from the light to the point
  float3 irradiance;  // at normal incidence; of a light with an area divided by pdf
  float distance;     // to where on the light it comes from; INFINITY for directional
  float reach;        // surfaces nearer than this block it: a surface that is a light is none of them itself
  float pdf;          // per steradian, of that place among all of the light; 1 for a light without extent
} LightSample;

#endif
