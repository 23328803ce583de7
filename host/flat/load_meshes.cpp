// Meshes and triangles as files and scene say: those that stand in one place are taken to the world, those that stand
// in several are held once, each in its own space.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat4x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <tuple>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "flat/flatten_parts.hpp"
#include "flat/mesh_outline.hpp"

namespace brume {

namespace {

constexpr std::size_t SHARED_MIN = 33;  // triangles: of fewer a copy takes no more room than an instance

Mesh mesh_of(const TriangleDesc& t) {
  Mesh mesh;
  mesh.positions.assign(t.vertices.begin(), t.vertices.end());
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.triangles.push_back({{0, 1, 2}, {-1, -1, -1}, {0, 1, 2}, -1});
  return mesh;
}

int shading_of(const MeshDesc& desc) {
  if (desc.shading == MeshShading::FLAT) return TRIANGLE_FLAT;
  return desc.shading == MeshShading::PHONG ? TRIANGLE_PHONG : TRIANGLE_GOURAUD;
}

// With normals for the way in which it is shaded.
Mesh mesh_shaded(const MeshDesc& desc, LoadedScene& loaded, std::vector<std::string>& notes) {
  Mesh mesh = *loaded.mesh(desc.file);
  for (const std::string& note : mesh.notes) note_once(notes, note);  // of a mesh that several shapes show
  if (desc.shading != MeshShading::FLAT) mesh_complete_normals(mesh, desc.crease);
  return mesh;
}

// A mirror turns the faces of a mesh around: its corners then go the other way round, so that it stays closed outwards.
void mesh_transform(Mesh& mesh, const dmat4& m) {
  const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m)));
  for (dvec3& p : mesh.positions) p = transform_point(m, p);
  for (dvec3& n : mesh.normals) n = glm::length(n) > 0 ? glm::normalize(normal_matrix * n) : n;
  if (!(glm::determinant(glm::dmat3(m)) < 0)) return;
  for (MeshTriangle& t : mesh.triangles)
    for (auto* corners : {&t.position, &t.normal, &t.uv}) std::swap((*corners)[1], (*corners)[2]);
}

// All that makes triangles others than those of another shape.
using MeshKey = std::tuple<std::string, MeshShading, std::optional<double>>;
MeshKey key_of(const MeshDesc& desc) { return {file_key(desc.file), desc.shading, desc.crease}; }

class MeshLoader {
 public:
  MeshLoader(const SceneDesc& desc, LoadedScene& loaded, LoadedShapes& shapes, std::vector<std::string>& notes)
      : desc_(desc), loaded_(loaded), shapes_(shapes), notes_(notes) {}

  void run() {
    for (const ShapeDesc& shape : desc_.shapes)
      if (const auto* mesh = std::get_if<MeshDesc>(&shape.geometry)) ++uses_[key_of(*mesh)];
    for (const ShapeDesc& shape : desc_.shapes) {
      if (const auto* triangle = std::get_if<TriangleDesc>(&shape.geometry))
        add_alone(mesh_of(*triangle), TRIANGLE_FLAT, shape.material);
      else if (const auto* mesh = std::get_if<MeshDesc>(&shape.geometry))
        add(shape, *mesh);
    }
    for (auto& [key, shared] : shared_)
      for (LoadedMesh& mesh : shared) shapes_.meshes.push_back(std::move(mesh));
  }

 private:
  void add(const ShapeDesc& shape, const MeshDesc& desc) {
    const dmat4 m = transform_matrix(desc.transform);
    const bool written = !desc.instances.empty() || !desc.instance_file.empty();
    const bool repeated = uses_[key_of(desc)] > 1 && loaded_.mesh(desc.file)->triangles.size() >= SHARED_MIN;
    if (written || (repeated && placement_keeps_volume(MeshPlacement(m)))) {
      add_shared(shape, desc, written ? instances(desc, m) : std::vector<dmat4>{m}, true);
      return;
    }
    if (!loaded_.mesh(desc.file)->parts.empty()) add_shared(shape, desc, {m}, false);
    Mesh mesh = mesh_shaded(desc, loaded_, notes_);
    mesh_transform(mesh, m);
    add_alone(std::move(mesh), shading_of(desc), shape.material);
  }

  // Triangles that stand where the mesh says.
  void add_alone(Mesh mesh, int shading, int material) {
    const std::size_t count = alone_count(mesh);
    if (count == 0) return;
    if (mesh.parts.empty())
      for (const dvec3& p : mesh.positions) shapes_.bounds.add(p);
    else
      mesh_bounds_add(mesh, 0, count, shapes_.bounds);
    shapes_.meshes.push_back(
        {std::make_shared<const Mesh>(std::move(mesh)), 0, count, shading, material, material < 0, {}});
  }

  std::vector<dmat4> instances(const MeshDesc& desc, const dmat4& m) {
    std::vector<dmat4> all;
    if (!desc.instance_file.empty())
      for (const MeshPlacement& placement : *loaded_.placements(desc.instance_file))
        all.push_back(dmat4(placement) * m);
    for (const TransformDesc& instance : desc.instances) all.push_back(transform_matrix(instance) * m);
    return all;
  }

  // The entries of a mesh that is held once: what stands in one place of it, then its parts.
  std::vector<LoadedMesh>& shared_of(const MeshDesc& desc) {
    std::vector<LoadedMesh>& shared = shared_[key_of(desc)];
    if (!shared.empty()) return shared;
    const auto mesh = std::make_shared<const Mesh>(mesh_shaded(desc, loaded_, notes_));
    shared.push_back({mesh, 0, alone_count(*mesh), shading_of(desc), -1, false, {}});
    for (const MeshPart& part : mesh->parts)
      shared.push_back({mesh, part.first, part.count, shading_of(desc), -1, false, {}});
    return shared;
  }

  [[noreturn]] void fail_singular(const ShapeDesc& shape, std::size_t instance) const {
    throw InputError(desc_.file.string() + ": " + shape.place + ": instance " + std::to_string(instance) +
                     ": the transform is singular, it leaves no volume");
  }

  // `whole`: with what stands in one place of it.
  void add_shared(const ShapeDesc& shape, const MeshDesc& desc, const std::vector<dmat4>& where, bool whole) {
    static const std::vector<MeshPlacement> HERE{MeshPlacement(1)};
    std::vector<LoadedMesh>& shared = shared_of(desc);
    for (std::size_t i = whole ? 0 : 1; i < shared.size(); ++i) {
      LoadedMesh& mesh = shared[i];
      if (mesh.count == 0) continue;
      const std::vector<Bounds> outline = outline_make(*mesh.mesh, mesh.first, mesh.count);
      for (std::size_t k = 0; k < where.size(); ++k)
        for (const MeshPlacement& placement : i == 0 ? HERE : mesh.mesh->parts[i - 1].placements) {
          const dmat4 world = where[k] * dmat4(placement);
          if (!placement_keeps_volume(MeshPlacement(world))) fail_singular(shape, k);
          mesh.places.push_back({world, shape.material, outline_bounds(outline, world)});
          shapes_.bounds.add(mesh.places.back().bounds.lo);
          shapes_.bounds.add(mesh.places.back().bounds.hi);
        }
      mesh.shows_own |= shape.material < 0;
    }
  }

  const SceneDesc& desc_;
  LoadedScene& loaded_;
  LoadedShapes& shapes_;
  std::vector<std::string>& notes_;
  std::map<MeshKey, int> uses_;
  std::map<MeshKey, std::vector<LoadedMesh>> shared_;
};

}  // namespace

void load_meshes(const SceneDesc& desc, LoadedScene& loaded, LoadedShapes& shapes, std::vector<std::string>& notes) {
  MeshLoader(desc, loaded, shapes, notes).run();
}

}  // namespace brume
