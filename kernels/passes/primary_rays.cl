// Camera rays of a batch and the surfaces they hit first. Item = pixel of the crop × sample, samples fastest.
#include "lib/camera.cl"
#include "shapes/shapes.cl"

__kernel void primary_rays(SCENE_ARGS, uint first_pixel, uint first_sample, uint samples, uint count,
                           __global Ray* rays, __global Hit* hits) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  const uint index = first_pixel + item / samples;
  const uint crop_width = (uint)(frame->crop_x1 - frame->crop_x0);
  const uint x = (uint)frame->crop_x0 + index % crop_width, y = (uint)frame->crop_y0 + index / crop_width;
  Ray ray = camera_ray(frame, y * (uint)frame->camera.width + x, first_sample + item % samples);
  ray_start_before_planes(&scene, &ray);
  rays[item] = ray;
  hits[item] = scene_hit(&scene, vec_unpack(ray.origin), vec_unpack(ray.dir), INFINITY, 0);
}
