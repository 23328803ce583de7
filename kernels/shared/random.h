// Names of the random streams and of the numbers in them: what kernels and reference must agree on to see the same picture.
#ifndef BRUME_SHARED_RANDOM_H
#define BRUME_SHARED_RANDOM_H

// Streams under a ray's own: its walk through medium m is m. Under a walk: segment n is n.
#define STREAM_LIGHT 0x10000u      // + l: a shadow ray to light l, from a surface or a segment; under it, medium m is m
#define STREAM_LIGHT_END 0x40000u  // + l: the same from where a dense segment ends
#define STREAM_OTHERS 0x20000u     // the other media up to a segment, + 1: along it; under it, medium m is m
#define STREAM_REFRACT 0x30000u    // the ray that a surface refracts
#define STREAM_REFLECT 0x30001u    // the ray that it reflects

// Numbers of segment n
#define RANDOM_PLACE 0u     // where it is sampled
#define RANDOM_REAL 1u      // whether a tentative collision is a real one
#define RANDOM_ROULETTE 2u  // whether the walk goes on
#define RANDOM_PURPOSES 3u
#endif
