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

// Half the scene's longest side or up to half of that: 1 for the default bounds of media.
double unit_choose(const Bounds& bounds) { return std::exp2(std::floor(std::log2(bounds.longest_side())) - 1); }

// The origin to which positions are made relative: a multiple of a power of two near the scene's centre. A scene near
// zero stays where it is, and a shift by such a multiple leaves every bit of a picture alone.
dvec3 origin_choose(const Bounds& bounds) {
  const double unit = std::exp2(std::ceil(std::log2(2 * bounds.longest_side())));
  return unit * glm::round(bounds.center() / unit);
}

}  // namespace

FlatScene scene_flatten(const SceneDesc& given, LoadedScene& loaded, int bvh_width) {
  const SceneDesc desc = liquids_as_shapes(given);
  std::vector<std::string> for_the_plan;
  media_check(desc, media_rows(desc), for_the_plan);  // before large files are read for nothing
  FlatScene scene;
  scene.name = desc.file.filename().string();
  scene.bvh_width = bvh_width;
  scene.bvh_rule = desc.render.bvh;

  const std::vector<LoadedMedium> media = load_media(desc, loaded, scene.notes);
  LoadedShapes shapes = load_shapes(desc, loaded, scene.notes);
  scene.bounds = shapes.bounds;
  for (const LoadedMedium& medium : media) medium_bounds_add(medium, scene.bounds);
  const Bounds size = scene.bounds.empty() ? view_bounds(desc.camera) : scene.bounds;
  if (!std::isfinite(size.longest_side()))
    throw InputError(scene.name + ": what its transforms make of shapes and media is larger than any number");
  scene.origin = origin_choose(size);
  scene.unit = unit_choose(size);

  flatten_lights(desc, scene);
  flatten_materials(desc, loaded, shapes, scene);
  flatten_shapes(shapes, scene);
  flatten_meshes(shapes, scene);
  flatten_shape_bvh(shapes, scene);
  flatten_emitters(desc, scene);
  flatten_media(media, shapes.isosurfaces, loaded.needed_again, scene);
  return scene;
}

}  // namespace brume
