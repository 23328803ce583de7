// See python_peer.hpp.
#include "python_peer.hpp"

#include <cstdlib>
#include <fstream>
#include <glm/common.hpp>
#include <sstream>

#include "base/atomic_file.hpp"
#include "base/command_line.hpp"

namespace brume::bench {

namespace {

nlohmann::json triple(const dvec3& v) { return {v.x, v.y, v.z}; }

std::string interpreter() {
  const char* python = std::getenv("BRUME_PYTHON");
  return shell_quoted(python ? python : "python3");
}

// With a layer of zeros around it: beyond, other programs repeat what stands at the border, an OpenVDB grid is 0.
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

std::vector<double> numbers_of_last_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);) last = line;
  std::istringstream words(last);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end == 0) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

bool python_has(const std::string& modules) {
  return command_succeeds(interpreter() + " -c " + shell_quoted("import " + modules) + " >/dev/null 2>&1");
}

nlohmann::json python_work(const Workload& work, const std::filesystem::path& folder) {
  const Grid& grid = work.grid();
  const dvec3 size(grid.size());
  const std::filesystem::path densities = folder / "densities.raw";
  densities_write(grid, densities);
  const SceneDesc& d = work.desc;
  return {{"densities", densities.string()},
          {"size", triple(size + 2.0)},
          {"lo", triple(dvec3(grid.world_from_lattice * glm::dvec4(-1, -1, -1, 1)))},
          {"hi", triple(dvec3(grid.world_from_lattice * glm::dvec4(size + 1.0, 1)))},
          {"eye", triple(d.camera.eye)},
          {"target", triple(d.camera.target)},
          {"up", triple(d.camera.up)},
          {"vfov", d.camera.vfov},
          {"film", {d.film.size.x, d.film.size.y}},
          {"sigma_a", triple(d.media[0].sigma_a)},
          {"sigma_s", triple(d.media[0].sigma_s)}};
}

std::vector<double> python_run(const std::string& name, const char* script, const nlohmann::json& work,
                               const std::filesystem::path& folder) {
  const std::string stem = "peer_" + name;  // beside a vtk.py Python would not look for its own vtk
  const std::filesystem::path json = folder / (stem + ".json"), program = folder / (stem + ".py"),
                              said = folder / (stem + ".log"), complaints = folder / (stem + ".err");
  atomic_write(json, work.dump());
  atomic_write(program, script);
  const bool done = command_succeeds(interpreter() + " " + shell_quoted(program) + " " + shell_quoted(json) + " >" +
                                     shell_quoted(said) + " 2>" + shell_quoted(complaints));
  return done ? numbers_of_last_line(said) : std::vector<double>();
}

}  // namespace brume::bench
