// Meshes of `brume check`, computed: no file is read.
#include <array>
#include <cmath>

#include "check/check_parts.hpp"
#include "load/loaded_scene.hpp"

namespace brume {

namespace {

constexpr int AROUND = 20, ACROSS = 12;

// One point of a torus of radius 0.8, 0.3 thick, and the normal there.
dvec3 torus_normal(int i, int j) {
  const double a = 2 * M_PI * i / AROUND, b = 2 * M_PI * j / ACROSS;
  return {std::cos(a) * std::cos(b), std::sin(b), std::sin(a) * std::cos(b)};
}

}  // namespace

Mesh torus_mesh() {
  Mesh mesh;
  for (int i = 0; i <= AROUND; ++i)  // the seams twice: their texture coordinates differ
    for (int j = 0; j <= ACROSS; ++j) {
      const double a = 2 * M_PI * i / AROUND;
      mesh.normals.push_back(torus_normal(i, j));
      mesh.positions.push_back(dvec3(0.8 * std::cos(a), 0, 0.8 * std::sin(a)) + 0.3 * mesh.normals.back());
      mesh.uvs.emplace_back(double(i) / AROUND, double(j) / ACROSS);
    }
  const auto corner = [](int i, int j) { return i * (ACROSS + 1) + j; };
  for (int i = 0; i < AROUND; ++i)
    for (int j = 0; j < ACROSS; ++j)
      for (const auto& t : {std::array<int, 3>{corner(i, j), corner(i, j + 1), corner(i + 1, j + 1)},
                            std::array<int, 3>{corner(i, j), corner(i + 1, j + 1), corner(i + 1, j)}})
        mesh.triangles.push_back({t, t, t, -1});
  return mesh;
}

namespace {

// A tetrahedron, half of which shines by itself.
Mesh rod_mesh() {
  Mesh mesh;
  mesh.positions = {{-0.5, -0.5, -0.5}, {0.5, -0.5, 0.5}, {-0.5, 0.5, 0.5}, {0.5, 0.5, -0.5}};
  mesh.materials.resize(2);
  mesh.materials[1].diffuse = dvec3(0);  // near its edges one face would light another by what rounding leaves
  mesh.materials[1].emission = {1, 2, 4};
  const std::array<int, 3> faces[] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (int i = 0; i < 4; ++i) mesh.triangles.push_back({faces[i], {-1, -1, -1}, {-1, -1, -1}, i % 2});
  return mesh;
}

}  // namespace

LoadedScene check_meshes() {
  LoadedScene loaded;
  loaded.keep("torus.obj", torus_mesh());
  loaded.keep("rod.obj", rod_mesh());
  return loaded;
}

}  // namespace brume
