// All scene buffers in one struct that device functions pass around. SCENE_ARGS and SCENE_PACK are the only lists of them;
// host/render/device_scene.cpp sets the same arguments in the same order.
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
#include "shared/shape.h"

typedef struct {
  __constant const Frame* frame;
  __global const Light* lights;
  __global const float* light_shares;
  __global const Material* materials;
  __global const Texture* textures;
  __global const float* texels;
  __global const Shape* shapes;
  __global const Triangle* triangles;
  __global const float* bvh_nodes;
  __global const int* bvh_links;
  __global const float* bvh_blocks;
  __global const int* bvh_ids;
  __global const Medium* media;
  __global const int* bricks;
  __global const float* ranges;
  __global const voxel_t* voxels;
  __global const LightGrid* light_grids;
  __global const float* light_tau;
} Scene;

#define SCENE_ARGS                                                                                        \
  __constant const Frame *frame, __global const Light *lights, __global const float *light_shares,        \
      __global const Material *materials, __global const Texture *textures, __global const float *texels, \
      __global const Shape *shapes, __global const Triangle *triangles, __global const float *bvh_nodes,  \
      __global const int *bvh_links, __global const float *bvh_blocks, __global const int *bvh_ids,       \
      __global const Medium *media, __global const int *bricks, __global const float *ranges,             \
      __global const voxel_t *voxels, __global const LightGrid *light_grids, __global const float *light_tau

#define SCENE_PACK                                                                                                 \
  {                                                                                                                \
    frame, lights, light_shares, materials, textures, texels, shapes, triangles, bvh_nodes, bvh_links, bvh_blocks, \
        bvh_ids, media, bricks, ranges, voxels, light_grids, light_tau                                             \
  }

#endif
