// The scenes of `brume check`: their texts (check_media_texts.hpp, check_surface_texts.hpp), and meshes that are
// computed.
#include <iterator>

#include "base/error.hpp"
#include "check/check_media_texts.hpp"
#include "check/check_parts.hpp"
#include "check/check_surface_texts.hpp"
#include "check/row_scenes.hpp"
#include "flat/transform.hpp"
#include "scene/scene_reader.hpp"

namespace brume {

namespace {

void torus_add(SceneDesc& desc) {
  const Mesh torus = torus_mesh();
  for (const MeshTriangle& its : torus.triangles) {
    TriangleDesc t;
    for (int k = 0; k < 3; ++k) t.vertices[k] = torus.positions[its.position[k]];
    desc.shapes.push_back({t, 0, "/shapes"});
  }
}

// Smooth normals for half of the torus and light of corners for a quarter; the rest stays flat.
void torus_smooth(PlannedScene& scene) {
  const Mesh torus = torus_mesh();
  const std::size_t count = torus.triangles.size();
  for (std::size_t i = count / 4; i < count; ++i) {
    Triangle& t = scene.triangles[i];
    t.shading = i < count / 2 ? TRIANGLE_GOURAUD : TRIANGLE_PHONG;
    for (int k = 0; k < 3; ++k) t.n[k] = packed(torus.normals[torus.triangles[i].normal[k]]);
  }
}

const std::vector<SceneText>& all_scenes() {
  static const std::vector<SceneText> scenes = [] {
    std::vector<SceneText> all(std::begin(SURFACE_SCENES), std::end(SURFACE_SCENES));
    all.insert(all.end(), std::begin(MEDIA_SCENES), std::end(MEDIA_SCENES));
    all.insert(all.end(), glass_scenes().begin(), glass_scenes().end());
    all.insert(all.end(), liquid_scenes().begin(), liquid_scenes().end());
    all.insert(all.end(), instance_scenes().begin(), instance_scenes().end());
    return all;
  }();
  return scenes;
}

}  // namespace

std::vector<std::string> check_scene_names() {
  std::vector<std::string> names;
  for (const SceneText& scene : all_scenes()) names.emplace_back(scene.name);
  return names;
}

SceneDesc check_scene_desc(const std::string& name) {
  for (const SceneText& scene : all_scenes()) {
    if (name != scene.name) continue;
    SceneDesc desc = scene_read_text(scene.text, name + ".json", {});
    if (name == "mesh") torus_add(desc);
    return desc;
  }
  throw InputError("no check scene is called '" + name + "'");
}

// "surfaces" has an image for the first material, another for the light of the last.
PlannedScene check_scene(const std::string& name, int size, int bvh_width) {
  PlannedScene scene = row_scene(check_scene_desc(name), name, size, bvh_width);
  if (name == "mesh") torus_smooth(scene);
  if (name == "surfaces") {
    scene.materials[0].texture = image_add(scene);
    scene.materials[2].emission_texture = image_add_wrapped(scene, WRAP_ONCE);
  }
  return scene;
}

}  // namespace brume
