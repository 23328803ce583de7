// See flatten.hpp: the order of the parts, and where the origin goes.
#include "flat/flatten.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

// The origin to which positions are made relative: a multiple of a power of two near the scene's centre. A scene near zero stays
// where it is, and a shift by such a multiple leaves every bit of a picture alone.
dvec3 origin_choose(const Bounds& bounds) {
  if (bounds.empty()) return dvec3(0);
  const dvec3 size = bounds.size();
  const double extent = std::max({size.x, size.y, size.z});
  if (!(extent > 0)) return dvec3(0);
  const double unit = std::exp2(std::ceil(std::log2(2 * extent)));
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
  FlatScene scene;
  scene.name = desc.file.filename().string();
  scene.exposure = desc.film.exposure;
  scene.bvh_width = options.bvh_width;

  std::vector<LoadedMedium> media = load_media(desc, scene.notes);
  LoadedShapes shapes = load_shapes(desc, scene.notes);
  Bounds bounds = shapes.bounds;
  for (const LoadedMedium& medium : media) medium_bounds_add(medium, bounds);
  scene.origin = origin_choose(bounds);

  flatten_camera(desc, scene);
  flatten_lights(desc, scene);
  flatten_materials(desc, shapes, scene);
  flatten_shapes(shapes, scene);
  flatten_media(desc, media, scene);
  crop_set(scene.frame, options.crop, desc.film.size);
  scene.frame.hides_background = options.hide_background;
  return scene;
}

}  // namespace brume
