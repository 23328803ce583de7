// What `brume chart --peers` asks for: other programs on the scene of a chart.
#include <cmath>
#include <memory>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "chart/point.hpp"
#include "cli/command.hpp"
#include "film/film_compare.hpp"
#include "peers.hpp"

namespace brume {

namespace {

using namespace bench;

// What of a scene the peers cannot be told; "" for one that they can.
std::string peers_problem(const SceneDesc& desc) {
  if (!desc.shapes.empty()) return "it has shapes";
  if (desc.media.size() != 1) return "it has " + std::to_string(desc.media.size()) + " media";
  const MediumDesc& m = desc.media[0];
  if (m.density.type != "file" || file_ending(m.density.file) != ".vdb") return "its density is no .vdb file";
  if (m.bounds || !m.transform.empty()) return "its medium is moved";
  if (m.density.threshold || !m.density.remap.empty() || m.density.factor != 1) return "its densities are changed";
  if (m.emission != dvec3(0) || m.emission_density) return "its medium glows";
  if (m.phase != PHASE_ISOTROPIC) return "its medium does not scatter evenly";
  if (desc.lights.size() != 1 || desc.lights[0].type != LIGHT_DIRECTIONAL)
    return "its light is not one directional one";
  if (desc.camera.type != CAMERA_PERSPECTIVE) return "its camera is orthographic";
  return "";
}

}  // namespace

void chart_peers_check(const SceneDesc& desc) {
  const std::string problem = peers_problem(desc);
  if (!problem.empty())
    throw InputError(desc.file.string() + ": --peers: other programs cannot render it, " + problem +
                     "; allowed: one .vdb file as it is, under one directional light");
}

std::vector<ChartPeer> chart_peers(const SceneDesc& desc, LoadedScene& loaded, const std::filesystem::path& folder) {
  SceneDesc black = desc;  // they know no background
  black.background = dvec3(0);
  const std::shared_ptr<LoadedScene> borrowed(std::shared_ptr<LoadedScene>(), &loaded);
  const Workload work{"scene", desc.media[0].density.file, borrowed, black};
  std::vector<ChartPeer> peers;
  const std::optional<PeerRun> run = vdb_render_run(work, folder, false),
                               converged = vdb_render_run(work, folder, true);
  if (run && converged)
    peers.push_back({"vdb_render", run->render_s,
                     image_compare(image_read(run->picture), image_read(converged->picture)).rel_rmse});
  if (const std::optional<MitsubaRun> mitsuba = mitsuba_run(work, folder)) {
    const CompareResult apart = image_compare(image_read(mitsuba->pictures[0]), image_read(mitsuba->pictures[1]));
    peers.push_back({"Mitsuba, 64 spp", mitsuba->render_s, apart.rel_rmse / std::sqrt(2.0)});  // two of the same size
  }
  return peers;
}

}  // namespace brume
