// Meshes and rays of the ray benchmarks. Private to bench/.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cl/context.hpp"
#include "plan/render_plan.hpp"
#include "ray_file.hpp"

namespace brume::bench {

struct RayMesh {
  const char* name;  // permanent
  int rings;         // of a bumpy sphere seen from within; 0: spot
};
const std::vector<RayMesh>& ray_meshes();  // those that can be made here

// A mesh with its rays, as brume sees them and as a peer reads them from `file`.
struct RayWork {
  PlannedScene scene;
  RayFile rays;
  std::filesystem::path file;
};
RayWork ray_work_make(Context& context, const RayMesh& mesh, const std::filesystem::path& folder, int lanes);

// Runs a kernel of rays.cl over rays: two floats a ray.
class RayKernels {
 public:
  RayKernels(Context& context, const PlannedScene& scene, int lanes);
  // Seconds of `runs` runs, after one that warms up.
  std::vector<double> run(const char* name, const std::vector<float>& rays, int runs, std::vector<float>& out) const;

 private:
  Context& context_;
  const PlannedScene& scene_;
  int lanes_;
};

}  // namespace brume::bench
