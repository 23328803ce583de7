// The buffers of a scene, in the order in which kernels take them. This is the only list: kernels/lib/scene.cl makes of
// it the struct `Scene`, its arguments and how they are packed, host/render/device_scene.cpp what fills them. A new
// buffer is a row.
#ifndef BRUME_SHARED_SCENE_BUFFERS_H
#define BRUME_SHARED_SCENE_BUFFERS_H
#include "shared/platform.h"

// ROW(address space, type of an element, name in kernels, kind, where the host finds it, what messages call it), NEXT
// between them.
//   FLAT    the same for every picture of a scene: a member of FlatScene
//   PLAN    of one picture: a member of RenderPlan
//   STORED  depends on render.storage; gradients are filled on the device, once
//   JOINED  of the media of FlatScene and their walks in RenderPlan (medium_join)
//   SCRATCH filled on the device
#define BRUME_SCENE_BUFFERS(ROW, NEXT)                                                                    \
  ROW(__constant, Frame, frame, PLAN, frame, "frame")                                                     \
  NEXT ROW(__global, Light, lights, PLAN, lights, "lights") NEXT ROW(__global, float, light_shares, PLAN, \
                                                                     light_shares, "light shares") NEXT   \
  ROW(__global, Material, materials, FLAT, materials, "materials") NEXT                                   \
  ROW(__global, Texture, textures, FLAT, textures, "textures") NEXT                                       \
  ROW(__global, float, texels, FLAT, texels, "texture pixels") NEXT                                       \
  ROW(__global, Shape, shapes, FLAT, shapes, "shapes") NEXT                                               \
  ROW(__global, int, shape_list, FLAT, shape_list, "list of shapes") NEXT                                 \
  ROW(__global, Isosurface, isosurfaces, FLAT, isosurfaces, "isosurfaces") NEXT                           \
  ROW(__global, uint, iso_masks, FLAT, iso_masks, "cells of isosurfaces") NEXT                            \
  ROW(__global, Triangle, triangles, FLAT, triangles, "triangles") NEXT                                   \
  ROW(__global, Instance, instances, FLAT, instances, "instances") NEXT                                   \
  ROW(__global, float, bvh_nodes, FLAT, bvh_nodes, "BVH nodes") NEXT                                      \
  ROW(__global, float, bvh_blocks, FLAT, bvh_blocks, "BVH triangles") NEXT                                \
  ROW(__global, Medium, media, JOINED, media, "media") NEXT                                               \
  ROW(__global, int, bricks, FLAT, bricks, "brick index") NEXT                                            \
  ROW(__global, float, ranges, STORED, brick_ranges, "brick ranges") NEXT                                 \
  ROW(__global, Voxel, voxels, STORED, voxels, "voxels") NEXT                                             \
  ROW(__global, Liquid, liquids, FLAT, liquids, "liquids") NEXT                                           \
  ROW(__global, GradientBrick, gradient_bricks, FLAT, gradient_bricks, "bricks of gradients") NEXT        \
  ROW(__global, Voxel, gradients, STORED, gradients, "gradients") NEXT                                    \
  ROW(__global, float, piece_rates, PLAN, piece_rates, "rates of pieces") NEXT                            \
  ROW(__global, LightGrid, light_grids, PLAN, light_grids, "light grids") NEXT                            \
  ROW(__global, float, light_tau, SCRATCH, light_entries, "light grid depths")

#endif
