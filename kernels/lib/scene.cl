// All scene buffers in one struct that device functions pass around, made of the list in shared/scene_buffers.h.
#ifndef BRUME_LIB_SCENE_CL
#define BRUME_LIB_SCENE_CL
#include "lib/vec.cl"
#include "lib/voxels.cl"
#include "shared/bvh.h"
#include "shared/frame.h"
#include "shared/light.h"
#include "shared/light_grid.h"
#include "shared/material.h"
#include "shared/medium.h"
#include "shared/ray.h"
#include "shared/scene_buffers.h"
#include "shared/shape.h"

#define SCENE_MEMBER(space, type, name, kind, member, what) space const type* name;
#define SCENE_ARGUMENT(space, type, name, kind, member, what) space const type* name
#define SCENE_NAME(space, type, name, kind, member, what) name
#define SCENE_COMMA ,

typedef struct {
  BRUME_SCENE_BUFFERS(SCENE_MEMBER, )
} Scene;

// The first arguments of every kernel that reads the scene, and the struct of them.
#define SCENE_ARGS BRUME_SCENE_BUFFERS(SCENE_ARGUMENT, SCENE_COMMA)
#define SCENE_PACK \
  { BRUME_SCENE_BUFFERS(SCENE_NAME, SCENE_COMMA) }

#endif
