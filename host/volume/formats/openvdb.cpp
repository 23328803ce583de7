// OpenVDB grid -> Grid: asked of brume-volume.
#include "volume/formats/openvdb.hpp"

#include <algorithm>
#include <optional>

#include "base/error.hpp"
#include "volume/volume_choice.hpp"
#include "volume/volume_convert.hpp"
#include "volume/volume_memory.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

using TopologySink = std::function<void(const VolumeTopology&, const std::string& background)>;

ivec3 index(const std::int32_t* v) { return {v[0], v[1], v[2]}; }

std::string problem_of(const InputError& error, const std::string& place) {
  const std::string text = error.what();
  return text.rfind(place + ": ", 0) == 0 ? text.substr(place.size() + 2) : text;
}

Grid grid_read(
    VolumeProgram& program, const fs::path& file, std::size_t i, const VolumeValues& values,
    const TopologySink& also = [](const VolumeTopology&, const std::string&) {}) {
  const VolumeProgram::GridHead& head = program.grids()[i];
  const std::string refused = volume_refusal(head, values);
  if (!refused.empty()) throw InputError(program.place(i) + ": " + refused);
  VolumeConvert convert(head, program.place(i), values,
                        std::min(GRID_BYTES_MAX, volume_memory_max(fs::file_size(file))));
  const VolumeReadEnd end = program.read(
      i, true, values.fill,
      {[&](const VolumeTopology& topology, const std::string& background) {
         also(topology, background);
         convert.topology(topology);
       },
       [&](const VolumeLeaf& leaf) { convert.leaf(leaf); }, [&](const VolumeTile& tile) { convert.tile(tile); }});
  Grid grid = convert.take(end);
  grid.name = head.name;
  grid.source = file.string();
  return grid;
}

void grid_inspect(VolumeProgram& program, const fs::path& file, std::size_t i, bool voxels, VolumeGridInfo& info) {
  const auto topology = [&](const VolumeTopology& t, const std::string& background) {
    info.active_voxels = t.active;
    info.index_min = index(t.lo);
    info.index_max = index(t.hi);
    info.background = background;
  };
  info.refusal = volume_refusal(program.grids()[i], {});
  if (!program.grids()[i].failure.empty()) return;
  try {
    if (!voxels || !info.refusal.empty()) {
      program.read(i, false, false, {topology, {}, {}});
      return;
    }
    Grid grid = grid_read(program, file, i, {}, topology);
    info.density = grid_stats(grid);
    for (const std::string& note : grid.notes) info.notes.push_back(problem_of(InputError(note), program.place(i)));
  } catch (const VolumeCrash&) {
    throw;
  } catch (const InputError& error) {
    info.refusal = problem_of(error, program.place(i));
  }
}

}  // namespace

std::vector<VolumeGridInfo> vdb_list(const fs::path& file, bool voxels) {
  VolumeProgram program(file);
  std::vector<VolumeGridInfo> infos;
  for (std::size_t i = 0; i < program.grids().size(); ++i) {
    const VolumeProgram::GridHead& grid = program.grids()[i];
    VolumeGridInfo& info = infos.emplace_back();
    info.name = grid.name;
    info.type = grid.type;
    info.grid_class = grid.grid_class;
    info.voxel_size = {grid.head.voxel_size[0], grid.head.voxel_size[1], grid.head.voxel_size[2]};
    grid_inspect(program, file, i, voxels, info);
  }
  return infos;
}

Grid vdb_read(const fs::path& file, const std::string& grid_name, const VolumeValues& values) {
  VolumeProgram program(file);
  return grid_read(program, file, volume_find(program, file.string(), grid_name, values), values);
}

VolumeFirst vdb_read_first(const fs::path& file) {
  VolumeProgram program(file);
  const std::vector<std::size_t> candidates = volume_candidates(program, file.string());
  std::optional<InputError> first;  // why the likeliest cannot be
  for (const std::size_t i : candidates) {
    VolumeValues values;
    values.fill = program.grids()[i].head.grid_class == VolumeClass::LEVEL_SET;
    try {
      VolumeFirst found{grid_read(program, file, i, values), values.fill, ""};
      if (program.grids().size() > 1) found.why = " of " + volume_listing(program);
      return found;
    } catch (const VolumeCrash&) {
      throw;
    } catch (const InputError& error) {
      if (!first) first = error;
    }
  }
  throw InputError(*first);
}

}  // namespace brume
