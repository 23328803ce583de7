// Wave 0: the camera rays of a batch, item = pixel of the crop × sample, samples fastest. Of every wave: the surfaces that its rays hit
// first.
#include "lib/camera.cl"
#include "shapes/shapes.cl"

__kernel void primary_rays(SCENE_ARGS, uint first_pixel, uint first_sample, uint samples, uint wave, uint count,
                           __global Ray* rays, __global Hit* hits) {
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const Scene scene = SCENE_PACK;
  if (wave == 0) {
    const uint index = first_pixel + item / samples;
    const uint crop_width = (uint)(frame->crop_x1 - frame->crop_x0);
    const uint x = (uint)frame->crop_x0 + index % crop_width, y = (uint)frame->crop_y0 + index / crop_width;
    Ray camera = camera_ray(frame, y * (uint)frame->camera.width + x, first_sample + item % samples);
    ray_start_before_planes(&scene, &camera);
    rays[item] = camera;
  }
  const Ray ray = rays[item];
  hits[item] = scene_hit(&scene, vec_unpack(ray.origin), vec_unpack(ray.dir), INFINITY, 0);
}
