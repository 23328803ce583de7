// brume info: what a scene, volume or mesh file holds.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <glm/common.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "accel/bvh.hpp"
#include "base/json_text.hpp"
#include "base/out_of_memory.hpp"
#include "base/text_printable.hpp"
#include "cli/command.hpp"
#include "cli/file_kind.hpp"
#include "cli/kernels_describe.hpp"
#include "flat/bricks.hpp"
#include "flat/mesh_outline.hpp"
#include "mesh/mesh.hpp"
#include "plan/planned_scene.hpp"
#include "render/renderer.hpp"
#include "scene/families.hpp"
#include "scene/scene_reader.hpp"
#include "volume/volume_file.hpp"

namespace brume {

namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

template <class V>
Json triple(const V& v) {
  return {v.x, v.y, v.z};
}

Json info_volume(const Path& file) {
  Json grids = Json::array();
  for (const VolumeGridInfo& g : volume_list(file, true)) {
    Json grid{{"name", g.name},
              {"values", g.type},
              {"class", g.grid_class},
              {"active_voxels", g.active_voxels},
              {"index_min", triple(g.index_min)},
              {"index_max", triple(g.index_max)},
              {"voxel_size", triple(g.voxel_size)}};
    if (g.density)
      grid["density"] = {{"min", g.density->min},
                         {"max", g.density->max},
                         {"mean", g.density->mean},
                         {"nonzero_voxels", g.density->nonzero}};
    else
      grid["no_density_because"] = g.refusal;
    if (!g.notes.empty()) grid["notes"] = g.notes;
    grids.push_back(grid);
  }
  return {{"file", file.string()}, {"kind", "volume"}, {"grids", grids}};
}

// Those of a mesh that several nodes have as often as it stands there.
std::size_t triangles_shown(const Mesh& mesh) {
  std::size_t count = mesh.triangles.size();
  for (const MeshPart& part : mesh.parts) count += part.count * (part.placements.size() - 1);
  return count;
}

Json info_mesh(const Path& file) {
  const Mesh mesh = mesh_read(file);
  const Bounds bounds = mesh_bounds(mesh);
  Json materials = Json::array();
  for (const MeshMaterial& m : mesh.materials)
    materials.push_back(
        {{"name", m.name}, {"texture", m.texture.name.empty() ? m.texture.file.string() : m.texture.name}});
  return {{"file", file.string()},
          {"kind", "mesh"},
          {"triangles", mesh.triangles.size()},
          {"triangles_in_all_places", triangles_shown(mesh)},
          {"vertices", mesh.positions.size()},
          {"normals", mesh.normals.size()},
          {"texture_coordinates", mesh.uvs.size()},
          {"min", triple(bounds.lo)},
          {"max", triple(bounds.hi)},
          {"materials", materials},
          {"notes", mesh.notes}};
}

struct BrickCounts {
  std::size_t stored = 0, constant = 0;
};

// Those from brick `first` to before `end`.
BrickCounts bricks_count(const FlatScene& flat, const Medium& m, glm::ivec3 first, glm::ivec3 end) {
  BrickCounts counts;
  for (glm::ivec3 b = first; b.z < end.z; ++b.z)
    for (b.y = first.y; b.y < end.y; ++b.y)
      for (b.x = first.x; b.x < end.x; ++b.x) {
        const std::int32_t entry = brick_entry(flat, m, b);
        if (entry == BRICK_EMPTY) continue;
        ++counts.stored;
        counts.constant += flat.brick_ranges[2 * std::size_t(entry)] == flat.brick_ranges[2 * std::size_t(entry) + 1];
      }
  return counts;
}

// Blocks of bricks that share their entries, as the empty ones of a wide and sparse volume do, are counted once in a
// row.
BrickCounts bricks_count(const FlatScene& flat, const Medium& m) {
  const glm::ivec3 bricks(m.brick_nx, m.brick_ny, m.brick_nz);
  BrickCounts all, last;
  std::int32_t last_entries = -1;
  for (glm::ivec3 at(0); at.z < bricks.z; at.z += BRICK_BLOCK)
    for (at.y = 0; at.y < bricks.y; at.y += BRICK_BLOCK)
      for (at.x = 0; at.x < bricks.x; at.x += BRICK_BLOCK) {
        const glm::ivec3 end = glm::min(at + BRICK_BLOCK, bricks);
        const bool whole = end == at + BRICK_BLOCK;
        const std::int32_t entries = brick_block_entries(flat, m, at / BRICK_BLOCK);
        if (!whole || entries != last_entries) last = bricks_count(flat, m, at, end);
        last_entries = whole ? entries : -1;
        all.stored += last.stored;
        all.constant += last.constant;
      }
  return all;
}

Json medium_info(const FlatScene& flat, const Medium& m) {
  const auto [stored, constant] = bricks_count(flat, m);
  const std::size_t count = std::size_t(m.brick_nx) * m.brick_ny * m.brick_nz;
  return {{"method", family_name(method_family(), m.method)},
          {"interpolation", family_name(interpolation_family(), m.interpolation)},
          {"cells", {m.cells_x, m.cells_y, m.cells_z}},
          {"step", m.step * flat.unit},
          {"bricks", {{"all", count}, {"stored", stored}, {"empty", count - stored}, {"constant", constant}}}};
}

// The tree above the triangles, where there are any; SAH cost: nodes that a ray through its box opens and half of the
// blocks that it looks at. As wide as on a CPU.
Json bvh_info(const SceneDesc& desc, const FlatScene& flat) {
  if (flat.triangles.empty()) return nullptr;
  const BvhMeasure measure = bvh_measure({flat.bvh_nodes, flat.bvh_blocks}, 0, flat.bvh_width);
  const double bytes = static_cast<double>((flat.bvh_nodes.size() + flat.bvh_blocks.size()) * sizeof(float));
  return {{"rule", family_name(bvh_family(), desc.render.bvh)},
          {"width", flat.bvh_width},
          {"sah_cost", measure.sah_cost},
          {"depth", measure.depth},
          {"bytes_a_triangle", bytes / static_cast<double>(flat.triangles.size())}};
}

Json info_scene(const Path& file) {
  const SceneDesc desc = scene_read(file, {});
  const PlannedScene flat = flatten(desc, {bvh_width_for(8), {}});
  Json media = Json::array();
  for (std::size_t i = 0; i < flat.media.size(); ++i) media.push_back(medium_info(flat, flat.medium(i)));
  return {{"file", file.string()},
          {"kind", "scene"},
          {"size", {desc.film.size.x, desc.film.size.y}},
          {"spp", desc.film.spp},
          {"lights", flat.light_sources.size()},
          {"materials", desc.materials.size()},
          {"textures", flat.textures.size()},
          {"shapes", flat.shapes.size()},
          {"triangles", flat.triangles.size()},
          {"bvh", bvh_info(desc, flat)},
          {"instances", flat.instances.size()},
          {"media", media},
          {"bytes",
           {{"voxels", flat.stored ? flat.stored->packed.size() : flat.voxels.size() * sizeof(float)},
            {"brick_ranges", flat.brick_ranges.size() * sizeof(float)},
            {"brick_index", flat.bricks.size() * sizeof(std::int32_t)},
            {"textures", flat.texels.size() * sizeof(float)},
            {"triangles", flat.triangles.size() * sizeof(Triangle)},
            {"instances", flat.instances.size() * sizeof(Instance)},
            {"bvh", (flat.bvh_nodes.size() + flat.bvh_blocks.size()) * sizeof(float)}}},
          {"storage", family_name(storage_family(), flat.storage)},
          {"storage_error", flat.stored ? flat.stored->error : 0},
          {"kernels", kernels_json(flat)},
          {"notes", flat.all_notes()}};
}

Json (*describer(FileKind kind))(const Path&) {
  if (kind == FileKind::VOLUME) return info_volume;
  return kind == FileKind::MESH ? info_mesh : info_scene;
}

// Nested objects as indented lines "key: value", texts of a list as lines.
void print_plain(const Json& json, int indent) {
  for (const auto& [key, value] : json.items()) {
    const bool nested = value.is_object() || (value.is_array() && !value.empty() && !value[0].is_number());
    const std::string text = value.is_string() ? text_printable(value.get<std::string>()) : json_line(value);
    const std::string name = json.is_array() && value.is_string() ? "- " : key + (nested ? ":" : ": ");
    std::printf("%*s%s%s\n", indent, "", name.c_str(), nested ? "" : text.c_str());
    if (nested) print_plain(value, indent + 2);
  }
}

int info_run(const Path& file, bool json) {
  const auto describe = describer(file_kind(file));
  const Json info = with_memory(file.string(), [&] { return describe(file); });
  if (json)
    std::printf("%s\n", json_line(info, 2).c_str());
  else
    print_plain(info, 0);
  return 0;
}

}  // namespace

void command_info(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("info", "Say what a scene, volume or mesh file holds");
  auto file = std::make_shared<Path>();
  auto json = std::make_shared<bool>(false);
  command->add_option("file", *file, "A " + file_kinds_text())->required();
  command->add_flag("--json", *json, "Print JSON");
  command->callback([file, json, &run] { run = [file, json] { return info_run(*file, *json); }; });
}

}  // namespace brume
