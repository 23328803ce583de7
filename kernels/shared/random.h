// Names of the random streams and of the numbers in them: what kernels and reference must agree on to see the same
// picture.
#ifndef BRUME_SHARED_RANDOM_H
#define BRUME_SHARED_RANDOM_H

// Streams under a ray's own: its walk through medium m is m. Under a walk: segment n is n.
// Shadow rays are numbered by the light, or by the pick where lights are chosen: below LIGHT_PICKS_MAX.
#define STREAM_LIGHT 0x10000u         // + n: shadow ray n, from a surface or a segment; under it, medium m is m
#define STREAM_LIGHT_END 0x40000u     // + n: the same from where a dense segment ends
#define STREAM_OTHERS 0x20000u        // the other media up to a segment, + 1: along it; under it, medium m is m
#define STREAM_REFRACT 0x30000u       // the ray that a surface refracts
#define STREAM_REFLECT 0x30001u       // the ray that it reflects
#define STREAM_LIGHT_CHOICE 0x30002u  // which lights are asked
#define STREAM_LIGHT_PLACE 0x30003u   // where on surfaces that emit

// Numbers of segment n
#define RANDOM_PLACE 0u     // where it is sampled
#define RANDOM_REAL 1u      // whether a tentative collision is a real one
#define RANDOM_ROULETTE 2u  // whether the walk goes on
#define RANDOM_PURPOSES 3u
#endif
