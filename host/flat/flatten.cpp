// See flatten.hpp: the order of the parts, where the origin goes and how long a flat unit is.
#include "flat/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

// A box about what the camera looks at, for scenes without anything finite.
Bounds view_bounds(const CameraDesc& camera) {
  const double size = camera.type == CAMERA_PERSPECTIVE ? glm::distance(camera.eye, camera.target) : camera.height;
  Bounds bounds;
  bounds.add(camera.target - 0.5 * size);
  bounds.add(camera.target + 0.5 * size);
  return bounds;
}

double longest_side(const Bounds& bounds) {
  const dvec3 size = bounds.size();
  return std::max({size.x, size.y, size.z});
}

// Half the scene's longest side or up to half of that: 1 for the default bounds of media.
double unit_choose(const Bounds& bounds) { return std::exp2(std::floor(std::log2(longest_side(bounds))) - 1); }

// The origin to which positions are made relative: a multiple of a power of two near the scene's centre. A scene near zero stays
// where it is, and a shift by such a multiple leaves every bit of a picture alone.
dvec3 origin_choose(const Bounds& bounds) {
  const double unit = std::exp2(std::ceil(std::log2(2 * longest_side(bounds))));
  return unit * glm::round(bounds.center() / unit);
}

void crop_set(Frame& frame, const std::array<int, 4>& crop, glm::ivec2 size) {
  const bool whole = crop[0] == crop[2] && crop[1] == crop[3];
  frame.crop_x0 = whole ? 0 : crop[0];
  frame.crop_y0 = whole ? 0 : crop[1];
  frame.crop_x1 = whole ? size.x : crop[2];
  frame.crop_y1 = whole ? size.y : crop[3];
  if (frame.crop_x0 < 0 || frame.crop_y0 < 0 || frame.crop_x0 >= frame.crop_x1 || frame.crop_y0 >= frame.crop_y1 ||
      frame.crop_x1 > size.x || frame.crop_y1 > size.y)
    throw InputError("--crop: expected X0,Y0,X1,Y1 with 0 <= X0 < X1 <= " + std::to_string(size.x) +
                     " and 0 <= Y0 < Y1 <= " + std::to_string(size.y));
}

}  // namespace

FlatScene flatten(const SceneDesc& desc, const FlattenOptions& options) {
  LoadedScene loaded;
  return flatten(desc, loaded, options);
}

FlatScene flatten(const SceneDesc& desc, LoadedScene& loaded, const FlattenOptions& options) {
  FlatScene scene;
  scene.name = desc.file.filename().string();
  scene.exposure = desc.film.exposure;
  scene.bvh_width = options.bvh_width;

  std::vector<LoadedMedium> media = load_media(desc, loaded, scene.notes);
  LoadedShapes shapes = load_shapes(desc, loaded, scene.notes);
  Bounds bounds = shapes.bounds;
  for (const LoadedMedium& medium : media) medium_bounds_add(medium, bounds);
  const Bounds size = bounds.empty() ? view_bounds(desc.camera) : bounds;
  if (!std::isfinite(longest_side(size)))
    throw InputError(scene.name + ": what its transforms make of shapes and media is larger than any number");
  scene.origin = origin_choose(size);
  scene.unit = unit_choose(size);

  flatten_camera(desc, bounds, scene);
  flatten_lights(desc, scene);
  flatten_materials(desc, loaded, shapes, scene);
  flatten_shapes(shapes, scene);
  flatten_media(desc, media, scene);
  crop_set(scene.frame, options.crop, desc.film.size);
  work_check(desc, media, scene);
  scene.frame.hides_background = options.hide_background;
  return scene;
}

}  // namespace brume
