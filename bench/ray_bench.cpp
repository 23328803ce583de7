// See ray_bench.hpp.
#include "ray_bench.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "accel/bvh.hpp"
#include "base/command_line.hpp"
#include "base/stopwatch.hpp"
#include "ray_work.hpp"
#include "render/renderer.hpp"

namespace brume::bench {

namespace {

// Which kernel of rays.cl follows a kind as the passes do.
constexpr const char* KERNELS[] = {"rays_together", "rays_occluded_together", "rays_alone"};
static_assert(std::size(KERNELS) == std::size(RAY_KINDS), "one kernel for each kind");

// What Embree said of one mesh: name of a row, its seconds, and what it was the quickest by.
struct PeerRow {
  std::string way;
  double hits = 0;
  std::vector<double> seconds;
};
using PeerRows = std::map<std::string, PeerRow>;

// What benchmarks of a mesh share: made once, gone when another mesh is asked for.
class Meshes {
 public:
  Meshes(const DeviceInfo& device, std::filesystem::path folder, int repetitions)
      : device_(device), lanes_(lanes_choose(device, 0)), folder_(std::move(folder)), repetitions_(repetitions) {}

  const RayWork& work(const RayMesh& mesh) {
    if (name_ != mesh.name) {
      work_.reset();
      peer_.reset();
      if (!context_) context_ = std::make_unique<Context>(device_);
      work_ = std::make_unique<RayWork>(ray_work_make(*context_, mesh, folder_, lanes_));
      name_ = mesh.name;
    }
    return *work_;
  }
  const PeerRows& peer(const RayMesh& mesh);
  std::vector<double> run(const RayMesh& mesh, std::size_t kind, double& hits);
  int repetitions() const { return repetitions_; }

 private:
  const DeviceInfo& device_;
  std::unique_ptr<Context> context_;  // made with the first mesh
  int lanes_;
  std::filesystem::path folder_;
  int repetitions_;
  std::string name_;
  std::unique_ptr<RayWork> work_;
  std::unique_ptr<PeerRows> peer_;
};

// Nothing where the program was not built, for want of Embree.
const PeerRows& Meshes::peer(const RayMesh& mesh) {
  const RayWork& there = work(mesh);
  if (peer_) return *peer_;
  peer_ = std::make_unique<PeerRows>();
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "brume-embree";
  const std::filesystem::path said = folder_ / "embree.txt";
  if (!std::filesystem::exists(program) ||
      !command_succeeds(shell_quoted(program) + " " + shell_quoted(there.file) + " " + std::to_string(repetitions_) +
                        " >" + shell_quoted(said) + " 2>/dev/null"))
    return *peer_;
  std::ifstream in(said);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string name;
    PeerRow row;
    words >> name >> row.way >> row.hits;
    for (double seconds; words >> seconds;) row.seconds.push_back(seconds);
    (*peer_)[name] = row;
  }
  return *peer_;
}

std::vector<double> Meshes::run(const RayMesh& mesh, std::size_t kind, double& hits) {
  const RayWork& there = work(mesh);
  std::vector<float> out;
  const std::vector<double> seconds =
      RayKernels(*context_, there.scene, lanes_).run(KERNELS[kind], there.rays.rays[kind], repetitions_, out);
  hits = 0;
  for (std::size_t i = 0; i < out.size(); i += 2) hits += RAY_KINDS[kind].any ? out[i] : out[i] < INFINITY;
  return seconds;
}

double rays_of(const RayWork& work, std::size_t kind) {
  const std::size_t rays = work.rays.rays[kind].size() / RAY_FLOATS;
  return static_cast<double>(rays);
}

constexpr const char* NO_EMBREE = "no Embree here (libembree-dev when brume was built)";

Bench build_bench(const std::shared_ptr<Meshes>& meshes, const RayMesh& mesh) {
  return bench_of(std::string("rays/") + mesh.name + "/build", "", [=](Counters& counters) {
    const PlannedScene& scene = meshes->work(mesh).scene;
    std::vector<double> seconds;
    for (int run = 0; run < meshes->repetitions(); ++run) {
      const Stopwatch watch;
      bvh_build(scene.triangles, scene.bvh_width);
      seconds.push_back(watch.seconds());
    }
    counters["triangles"] = static_cast<double>(scene.triangles.size());
    return seconds;
  });
}

Bench kind_bench(const std::shared_ptr<Meshes>& meshes, const RayMesh& mesh, std::size_t kind) {
  return bench_of(std::string("rays/") + mesh.name + "/" + RAY_KINDS[kind].name, "", [=](Counters& counters) {
    counters["rays"] = rays_of(meshes->work(mesh), kind);
    return meshes->run(mesh, kind, counters["hits"]);
  });
}

// kind: of RAY_KINDS; beyond them the build.
Bench peer_bench(const std::shared_ptr<Meshes>& meshes, const RayMesh& mesh, std::size_t kind) {
  const bool build = kind == std::size(RAY_KINDS);
  const std::string row = build ? "build" : RAY_KINDS[kind].name;
  return bench_of(std::string("peer/") + mesh.name + "/embree/" + row, NO_EMBREE, [=](Counters& counters) {
    const PeerRows& rows = meshes->peer(mesh);
    const auto found = rows.find(row);
    if (found == rows.end()) return std::vector<double>();
    if (build) return found->second.seconds;
    counters["rays"] = rays_of(meshes->work(mesh), kind);
    counters["hits"] = found->second.hits;
    counters["packet"] = std::stod(found->second.way);
    return found->second.seconds;
  });
}

}  // namespace

std::vector<Bench> ray_benches(const DeviceInfo& device, const std::filesystem::path& folder, int repetitions,
                               bool peers) {
  const auto meshes = std::make_shared<Meshes>(device, folder, repetitions);
  std::vector<Bench> benches;
  for (const RayMesh& mesh : ray_meshes()) {
    benches.push_back(build_bench(meshes, mesh));
    for (std::size_t kind = 0; kind < std::size(RAY_KINDS); ++kind) benches.push_back(kind_bench(meshes, mesh, kind));
    for (std::size_t kind = 0; peers && kind <= std::size(RAY_KINDS); ++kind)
      benches.push_back(peer_bench(meshes, mesh, kind));
  }
  return benches;
}

}  // namespace brume::bench
