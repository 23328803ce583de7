// The scenes of `brume check`: their texts (check_media_texts.hpp, check_surface_texts.hpp), and meshes that are
// computed.
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "base/error.hpp"
#include "check/check_media_texts.hpp"
#include "check/check_parts.hpp"
#include "check/check_surface_texts.hpp"
#include "check/row_scenes.hpp"
#include "scene/scene_reader.hpp"

namespace brume {

namespace {

constexpr int TORUS_AROUND = 20, TORUS_ACROSS = 12;

dvec3 torus_normal(int i, int j) {
  const double a = 2 * M_PI * i / TORUS_AROUND, b = 2 * M_PI * j / TORUS_ACROSS;
  return {std::cos(a) * std::cos(b), std::sin(b), std::sin(a) * std::cos(b)};
}

dvec3 torus_point(int i, int j) {
  const double a = 2 * M_PI * i / TORUS_AROUND;
  return dvec3(0.8 * std::cos(a), 0, 0.8 * std::sin(a)) + 0.3 * torus_normal(i, j);
}

constexpr int TORUS_CORNERS[2][3][2] = {{{0, 0}, {0, 1}, {1, 1}}, {{0, 0}, {1, 1}, {1, 0}}};

template <class Visit>
void torus_triangles(Visit visit) {
  for (int i = 0; i < TORUS_AROUND; ++i)
    for (int j = 0; j < TORUS_ACROSS; ++j)
      for (const auto& corners : TORUS_CORNERS) visit(i, j, corners);
}

void torus_add(SceneDesc& desc) {
  torus_triangles([&](int i, int j, const int(&corners)[3][2]) {
    TriangleDesc t;
    for (int k = 0; k < 3; ++k) t.vertices[k] = torus_point(i + corners[k][0], j + corners[k][1]);
    desc.shapes.push_back({t, 0, "/shapes"});
  });
}

// Smooth normals for half of the torus and light of corners for a quarter; the rest stays flat.
void torus_smooth(PlannedScene& scene) {
  std::size_t index = 0;
  torus_triangles([&](int i, int j, const int(&corners)[3][2]) {
    Triangle& t = scene.triangles[index++];
    if (4 * i < TORUS_AROUND) return;
    t.shading = 4 * i < 2 * TORUS_AROUND ? TRIANGLE_GOURAUD : TRIANGLE_PHONG;
    for (int k = 0; k < 3; ++k) {
      const dvec3 n = torus_normal(i + corners[k][0], j + corners[k][1]);
      t.n[k] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
    }
  });
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
