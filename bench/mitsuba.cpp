// Mitsuba as a peer, see peer_mitsuba.py.
#include "peer_texts.hpp"
#include "peers.hpp"
#include "python_peer.hpp"

namespace brume::bench {

std::optional<MitsubaRun> mitsuba_run(const Workload& work, const std::filesystem::path& folder) {
  if (!python_has("mitsuba, numpy")) return std::nullopt;
  MitsubaRun run{0, {folder / (work.name + "_mitsuba0.exr"), folder / (work.name + "_mitsuba1.exr")}};
  nlohmann::json json = python_work(work, folder);
  const dvec3 &direction = work.desc.lights[0].direction, &irradiance = work.desc.lights[0].intensity;
  json["direction"] = {direction.x, direction.y, direction.z};
  json["irradiance"] = {irradiance.x, irradiance.y, irradiance.z};
  json["spp"] = 64;
  json["pictures"] = {run.pictures[0].string(), run.pictures[1].string()};
  const std::vector<double> seconds = python_run("mitsuba", PEER_MITSUBA_PY, json, folder);
  if (seconds.empty() || !(seconds.back() > 0)) return std::nullopt;
  run.render_s = seconds.back();
  return run;
}

}  // namespace brume::bench
