// See workload.hpp.
#include "workload.hpp"

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "flat/bare_scene.hpp"
#include "volume/formats/openvdb.hpp"

namespace brume::bench {

namespace {

constexpr int FOG = 128;

// Six soft balls in the unit cube; below 2 % of the peak there is nothing.
double fog_density(const dvec3& p) {
  static const struct {
    dvec3 centre;
    double radius, weight;
  } balls[] = {{{0.5, 0.45, 0.5}, 0.16, 1.0},  {{0.35, 0.5, 0.42}, 0.1, 0.8}, {{0.62, 0.55, 0.6}, 0.12, 0.9},
               {{0.55, 0.68, 0.4}, 0.08, 0.7}, {{0.4, 0.3, 0.62}, 0.09, 0.6}, {{0.66, 0.34, 0.38}, 0.07, 0.9}};
  double sum = 0;
  for (const auto& b : balls) sum += b.weight * std::exp(-glm::dot(p - b.centre, p - b.centre) / (b.radius * b.radius));
  return sum > 0.02 ? sum - 0.02 : 0;
}

// The fog in the low corner of a cube of `side` voxels, the rest of which is empty; world size of a voxel 1/FOG.
void fog_write(int side, const std::filesystem::path& file) {
  Grid grid{ivec3(side)};
  grid.name = "density";
  grid.border = Border::ZERO;
  for (int axis = 0; axis < 3; ++axis) grid.world_from_lattice[axis][axis] = 1.0 / FOG;
  for (int z = 0; z < FOG; ++z)
    for (int y = 0; y < FOG; ++y)
      for (int x = 0; x < FOG; ++x) {
        const double density = fog_density((dvec3(x, y, z) + 0.5) / double(FOG));
        if (density > 0) grid.set({x, y, z}, static_cast<float>(density));
      }
  vdb_write(grid, file);
}

Workload workload(const std::string& name, const std::filesystem::path& file, int size) {
  std::string report;
  const auto loaded = std::make_shared<LoadedScene>();
  Workload w{name, file, loaded, bare_scene(file, *loaded, report)};
  w.desc.background = dvec3(0);
  w.desc.film.size = {size, size};
  return w;
}

}  // namespace

Workload fog_workload(const std::filesystem::path& folder, int size) {
  fog_write(FOG, folder / "fog128.vdb");
  return workload("fog128", folder / "fog128.vdb", size);
}

std::vector<Workload> workloads(const std::filesystem::path& folder, int size) {
  std::vector<Workload> all{fog_workload(folder, size)};
  fog_write(2 * FOG, folder / "fog256_sparse.vdb");
  all.push_back(workload("fog256_sparse", folder / "fog256_sparse.vdb", size));
  all.back().desc.camera = all.front().desc.camera;  // the same view of the same fog
  all.back().desc.media[0].sigma_a = all.front().desc.media[0].sigma_a;
  all.back().desc.media[0].sigma_s = all.front().desc.media[0].sigma_s;
  const char* data = std::getenv("BRUME_TEST_DATA");
  const std::filesystem::path smoke = std::filesystem::path(data ? data : "../shared/data") / "volumes/smoke.vdb";
  if (std::filesystem::exists(smoke)) all.push_back(workload("smoke", smoke, size));
  return all;
}

}  // namespace brume::bench
