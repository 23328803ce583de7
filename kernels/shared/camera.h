// The camera as kernels and reference see it. Film coordinates x, y run over [-1,1], x to the right, y up.
#ifndef BRUME_SHARED_CAMERA_H
#define BRUME_SHARED_CAMERA_H
#include "shared/platform.h"

#define BRUME_CAMERAS(ROW)                                                            \
  ROW(PERSPECTIVE, "perspective", "pinhole at eye, vertical opening vfov in degrees") \
  ROW(ORTHOGRAPHIC, "orthographic", "parallel rays, height of the view in world units")

BRUME_SHARED_BEGIN
enum CameraType {
#define ROW(id, name, help) CAMERA_##id,
  BRUME_CAMERAS(ROW)
#undef ROW
      CAMERA_COUNT
};

// perspective:  origin = eye,                    dir = normalize(forward + x right + y up)
// orthographic: origin = eye + x right + y up,   dir = forward
// forward is unit; right and up carry the extent of the view.
typedef struct {
  Packed3 eye;
  int type;
  Packed3 forward;
  int width;  // film size in pixels
  Packed3 right;
  int height;
  Packed3 up;
  int spp;
} Camera;
BRUME_LAYOUT(Camera, 64);
BRUME_SHARED_END
#endif
