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

// perspective:  point = axis + back (x right + y up),   dir = normalize(forward + x right + y up), the eye at -back
// along forward
// orthographic: point = axis + x right + y up,          dir = forward, the eye's plane at -back
// forward is unit; right and up carry the extent of the view. `axis` lies on the line of sight: in the eye itself (back
// = 0), but for cameras far from the scene beside the scene, so that float is spent on what is seen and not on the way
// to it.
typedef struct {
  Packed3 axis;
  int type;
  Packed3 forward;
  int width;  // film size in pixels
  Packed3 right;
  int height;
  Packed3 up;
  int spp;
  float back;  // from the eye to `axis`
} Camera;
BRUME_LAYOUT(Camera, 68);
BRUME_SHARED_END
#endif
