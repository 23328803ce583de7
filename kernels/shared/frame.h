// Everything of a frame that is not a buffer: one per launch, kernels read it as __constant.
#ifndef BRUME_SHARED_FRAME_H
#define BRUME_SHARED_FRAME_H
#include "shared/camera.h"
#include "shared/platform.h"

// What a camera ray shows of a surface.
#define BRUME_INTEGRATORS(ROW)                                \
  ROW(WHITTED, "whitted", "lights, media, mirrors and glass") \
  ROW(AMBIENT_OCCLUSION, "ambient_occlusion", "how much of a white sky reaches a surface")

BRUME_SHARED_BEGIN
enum Integrator {
#define ROW(id, name, help) INTEGRATOR_##id,
  BRUME_INTEGRATORS(ROW)
#undef ROW
      INTEGRATOR_COUNT
};

typedef struct {
  Camera camera;
  Packed3 background;
  int light_count;
  Packed3 ambient;
  int list_count;  // of shape_list
  int medium_count;
  int triangle_count;  // of those in the world
  uint seed;
  int in_scattering;
  int max_depth;
  float roulette;  // view rays below this transmittance are ended at random, the rest weighs more; 0: never
  int takes_ends;  // dense segments take the light from both ends: no medium is tracked
  int crop_x0, crop_y0, crop_x1, crop_y1;  // pixels rendered: [x0,x1) x [y0,y1)
  Packed3 bounds_lo,
      bounds_hi;          // a box about everything finite, where camera rays start; lo = hi: there is nothing finite
  int light_picks;        // how many lights a point asks: all, or fewer that it chooses by FlatScene::light_shares
  int directions;         // of ambient occlusion; 0: surfaces are lit by lights
  float occlusion_reach;  // what is further off does not occlude
  int occlusion_rotates;  // 1: the directions are turned from pixel to pixel and sample to sample
  int hides_background;   // 1: camera rays see nothing where they hit nothing; mirrors and glass go on seeing it
  float cutoff;           // rays whose light weighs less than this in every channel are not sent on
  int clear_shadows;      // 1: light passes shapes that refract, straight on; 0: they block it
  int starts_inside;      // 1: camera rays may begin inside of shapes that refract
  int instance_root;      // of the BVH over the instances; -1: there are none
  int shape_root;         // of the BVH over shapes; -1: all of them are in shape_list
  int light_ladder;       // 1: where several media stand on one spot, depths to the lights are interpolated
} Frame;
BRUME_LAYOUT(Frame, 212);
BRUME_SHARED_END
#endif
