// VTK as a peer, see peer_vtk.py.
#include <fstream>

#include "peer_texts.hpp"
#include "peers.hpp"
#include "python_peer.hpp"

namespace brume::bench {

std::optional<VtkRun> vtk_run(const Workload& work, int threads, int runs, const std::filesystem::path& folder) {
  if (!python_has("vtk, numpy")) return std::nullopt;
  const std::filesystem::path picture = folder / "vtk.raw";
  nlohmann::json json = python_work(work, folder);
  json["threads"] = threads;
  json["runs"] = runs;
  json["step_voxels"] = 1;
  json["picture"] = picture.string();
  VtkRun run{python_run("vtk", PEER_VTK_PY, json, folder), {}};
  const glm::ivec2 size = work.desc.film.size;
  std::vector<float> values(3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  std::ifstream in(picture, std::ios::binary);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(float)));
  if (!in || run.seconds.size() != static_cast<std::size_t>(runs)) return std::nullopt;
  run.transmittance.width = size.x;
  run.transmittance.height = size.y;
  run.transmittance.channels = 3;
  run.transmittance.channel_names = {"R", "G", "B"};
  run.transmittance.values = std::move(values);
  return run;
}

}  // namespace brume::bench
