// Mitsuba as a peer: the volume as raw floats, the scene as JSON, the rest in peer_mitsuba.py.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/command_line.hpp"
#include "mitsuba_script.hpp"
#include "peers.hpp"

namespace brume::bench {

namespace {

nlohmann::json triple(const dvec3& v) { return {v.x, v.y, v.z}; }

// With a layer of zeros around it: beyond, Mitsuba repeats what stands at the border, an OpenVDB grid is 0.
void densities_write(const Grid& grid, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  const ivec3 size = grid.size();
  for (int z = -1; z <= size.z; ++z)
    for (int y = -1; y <= size.y; ++y)
      for (int x = -1; x <= size.x; ++x) {
        const ivec3 i(x, y, z);
        const float value = glm::clamp(i, ivec3(0), size - 1) == i ? grid.at(i) : 0.0f;
        out.write(reinterpret_cast<const char*>(&value), sizeof value);
      }
}

}  // namespace

std::optional<MitsubaRun> mitsuba_run(const Workload& work, const std::filesystem::path& folder) {
  const char* python = std::getenv("BRUME_PYTHON");
  const std::string interpreter = python ? python : "python3";
  if (!command_succeeds(interpreter + " -c 'import mitsuba, numpy' >/dev/null 2>&1")) return std::nullopt;
  const Grid& grid = work.grid();
  const dvec3 size(grid.size());
  MitsubaRun run{0, {folder / (work.name + "_mitsuba0.exr"), folder / (work.name + "_mitsuba1.exr")}};
  const std::filesystem::path densities = folder / "mitsuba.raw", scene = folder / "mitsuba.json",
                              script = folder / "peer_mitsuba.py", log = folder / "mitsuba.log";
  densities_write(grid, densities);
  const SceneDesc& d = work.desc;
  const nlohmann::json json{{"densities", densities.string()},
                            {"size", triple(size + 2.0)},
                            {"lo", triple(dvec3(grid.world_from_lattice * glm::dvec4(-1, -1, -1, 1)))},
                            {"hi", triple(dvec3(grid.world_from_lattice * glm::dvec4(size + 1.0, 1)))},
                            {"sigma_a", triple(d.media[0].sigma_a)},
                            {"sigma_s", triple(d.media[0].sigma_s)},
                            {"eye", triple(d.camera.eye)},
                            {"target", triple(d.camera.target)},
                            {"up", triple(d.camera.up)},
                            {"vfov", d.camera.vfov},
                            {"film", {d.film.size.x, d.film.size.y}},
                            {"direction", triple(d.lights[0].direction)},
                            {"irradiance", triple(d.lights[0].intensity)},
                            {"spp", 64},
                            {"pictures", {run.pictures[0].string(), run.pictures[1].string()}}};
  atomic_write(scene, json.dump());
  atomic_write(script, MITSUBA_SCRIPT);
  const std::string command =
      interpreter + " '" + script.string() + "' '" + scene.string() + "' >'" + log.string() + "' 2>&1";
  if (!command_succeeds(command)) return std::nullopt;
  std::ifstream in(log);
  std::string word;
  while (in >> word)  // the last word of the log
    if (char* end = nullptr; std::strtod(word.c_str(), &end) > 0 && *end == 0) run.render_s = std::atof(word.c_str());
  if (!(run.render_s > 0)) return std::nullopt;
  return run;
}

}  // namespace brume::bench
