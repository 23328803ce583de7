// See peers.hpp.
#include "peers.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

#include "base/atomic_file.hpp"
#include "base/command_line.hpp"
#include "base/stopwatch.hpp"
#include "scene/scene_writer.hpp"

namespace brume::bench {

namespace {

std::string words(const dvec3& v) {
  char text[120];
  std::snprintf(text, sizeof text, "%.9g,%.9g,%.9g", v.x, v.y, v.z);
  return text;
}

std::string vdb_render_command(const Workload& work, const std::filesystem::path& picture, bool converged) {
  const SceneDesc& d = work.desc;
  const MediumDesc& m = d.media[0];
  const dvec3 radiance = d.lights[0].intensity / (4 * M_PI);  // it knows no phase function
  std::ostringstream command;
  command << "vdb_render " << shell_quoted(work.file) << " " << shell_quoted(picture) << " -v -cpus 0 -res "
          << d.film.size.x << "x" << d.film.size.y << " -fov " << d.camera.vfov << " -translate " << words(d.camera.eye)
          << " -lookat " << words(d.camera.target) << " -absorb " << words(m.sigma_a * work.voxel_size())
          << " -scatter " << words(m.sigma_s * work.voxel_size()) << " -gain 1 -light "
          << words(-glm::normalize(d.lights[0].direction)) << "," << words(radiance);
  if (converged) command << " -step 0.5 -shadowstep 1 -cutoff 1e-5";
  return command.str();
}

// The seconds of the line after "ray-tracing".
double seconds_in_log(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string line;
  bool next = false;
  while (std::getline(in, line)) {
    double seconds = 0;
    if (next && std::sscanf(line.c_str(), "vdb_render: ...completed in %lf sec", &seconds) == 1) return seconds;
    next = next || line.find("ray-tracing") != std::string::npos;
  }
  return 0;
}

}  // namespace

std::optional<PeerRun> vdb_render_run(const Workload& work, const std::filesystem::path& folder, bool converged) {
  const std::filesystem::path picture = folder / (work.name + (converged ? "_peer_converged.exr" : "_peer.exr"));
  const std::filesystem::path log = folder / "peer.log";
  const Stopwatch watch;
  const std::string command = vdb_render_command(work, picture, converged) + " >" + shell_quoted(log) + " 2>&1";
  if (!command_succeeds(command) || !std::filesystem::exists(picture)) return std::nullopt;
  return PeerRun{seconds_in_log(log), watch.seconds(), picture};
}

std::optional<double> brume_process_seconds(const SceneDesc& desc, const std::filesystem::path& folder) {
  const std::filesystem::path scene = folder / "process.json",
                              program = std::filesystem::read_symlink("/proc/self/exe");
  atomic_write(scene, scene_write(desc, folder));
  const Stopwatch watch;
  const std::string command = shell_quoted(program) + " render " + shell_quoted(scene) + " --quiet -o " +
                              shell_quoted(folder / "process.exr") + " >/dev/null 2>&1";
  if (!command_succeeds(command)) return std::nullopt;
  return watch.seconds();
}

}  // namespace brume::bench
