// Gradients of the presence of liquids: runs once, before the first batch. Item = row of samples of a brick.
#include "density/gradients.cl"

__kernel void presence_gradients(SCENE_ARGS, uint count, __global Voxel* out) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  gradient_row(&scene, item, out);
}
