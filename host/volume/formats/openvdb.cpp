// OpenVDB grid -> Grid: which grid of a file is taken, what is refused, how its voxels are copied.
#include "volume/formats/openvdb.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <sstream>

#include "base/error.hpp"
#include "volume/formats/openvdb_file.hpp"

namespace brume {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::GridBase;

using DensityGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid>;
constexpr const char* ALLOWED_TYPES = "float, double, int32 and int64 grids of class fog volume or unknown";

ivec3 vec(const Coord& c) { return {c.x(), c.y(), c.z()}; }
std::string text(const Coord& c) {
  return "[" + std::to_string(c.x()) + ", " + std::to_string(c.y()) + ", " + std::to_string(c.z()) + "]";
}

// Why a grid can never be a density, by its type, class and transform; "" if it can.
std::string refusal_by_kind(const GridBase& grid) {
  const std::string allowed = std::string("; allowed are ") + ALLOWED_TYPES;
  if (!grid.apply<DensityGrids>([](const auto&) {})) return "holds " + grid.valueType() + " values" + allowed;
  const openvdb::GridClass kind = grid.getGridClass();
  if (kind != openvdb::GRID_FOG_VOLUME && kind != openvdb::GRID_UNKNOWN)
    return "is a " + GridBase::gridClassToString(kind) + allowed;
  if (!grid.transform().isLinear()) return "has a " + grid.transform().mapType() + "; allowed are linear transforms";
  return "";
}

// And by its tree: what the topology tells.
std::string refusal_by_tree(const GridBase& grid) {
  std::string reason;
  grid.apply<DensityGrids>([&](const auto& g) {
    if (g.background() == 0) return;
    std::ostringstream value;
    value << g.background();
    reason = "has the background " + value.str() + "; allowed is 0, since a medium ends somewhere";
  });
  if (reason.empty() && grid.baseTree().activeVoxelCount() == 0) reason = "is empty: it has no active voxel";
  return reason;
}

std::string listing(VdbFile& file) {
  std::string names;
  for (std::size_t i = 0; i < file.count(); ++i) {
    const GridBase::Ptr grid = file.read(i, VdbDepth::METADATA);
    names += (i ? ", '" : "'") + vdb_printable(file.name(i)) + "' (" + grid->valueType() + ", " +
             GridBase::gridClassToString(grid->getGridClass()) + ")";
  }
  return names;
}

std::size_t find_named(VdbFile& file, const std::string& path, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < file.count(); ++i) {
    if (file.name(i) == name) return i;
    if (file.plain_name(i) == name) found.push_back(i);
  }
  if (found.size() == 1) return found[0];
  throw InputError(path + ": " + (found.empty() ? "no grid '" : "several grids '") + vdb_printable(name) +
                   "'; the file holds " + listing(file));
}

// "density" if that can be one, else the first grid that can.
std::size_t find_density(VdbFile& file, const std::string& path) {
  std::optional<std::size_t> found;
  std::string refused;
  for (std::size_t i = 0; i < file.count(); ++i) {
    refused = refusal_by_kind(*file.read(i, VdbDepth::METADATA));
    if (!refused.empty()) continue;
    if (!found || (file.plain_name(i) == "density" && file.plain_name(*found) != "density")) found = i;
  }
  if (found) return *found;
  if (file.count() == 1) throw InputError(file.place(0) + ": " + refused);
  throw InputError(path + ": none of its grids can be a density: " + listing(file) + "; allowed are " + ALLOWED_TYPES);
}

// What the writer noted down about a grid must be what was read: this is how flipped bytes in its topology show.
void check_metadata(const GridBase& grid, const CoordBBox& box, std::uint64_t active, const std::string& place) {
  const auto lo = grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MIN);
  const auto hi = grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MAX);
  const auto count = grid.getMetadata<openvdb::Int64Metadata>(GridBase::META_FILE_VOXEL_COUNT);
  if (count && static_cast<std::uint64_t>(count->value()) != active)
    throw InputError(place + ": has " + std::to_string(active) + " active voxels where its metadata promises " +
                     std::to_string(count->value()) + "; the file is damaged");
  if ((lo && Coord(lo->value()) != box.min()) || (hi && Coord(hi->value()) != box.max()))
    throw InputError(place + ": its active voxels fill " + text(box.min()) + " to " + text(box.max()) +
                     ", which is not what its metadata promises; the file is damaged");
}

// Calls visit(box, value) for every active tile and every active voxel.
template <class Tree, class Visit>
void visit_active(const Tree& tree, Visit visit) {
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
    for (auto v = leaf->cbeginValueOn(); v; ++v) visit(CoordBBox(v.getCoord(), v.getCoord()), static_cast<float>(*v));
  auto tile = tree.cbeginValueOn();
  tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    CoordBBox box;
    tile.getBoundingBox(box);
    visit(box, static_cast<float>(*tile));
  }
}

template <class Tree>
void check_values(const Tree& tree, const std::string& place) {
  std::uint64_t bad = 0;
  Coord first;
  float value = 0;
  visit_active(tree, [&](const CoordBBox& box, float v) {
    if (v >= 0 && std::isfinite(v)) return;
    if (bad == 0) {
      first = box.min();
      value = v;
    }
    bad += box.volume();
  });
  if (bad == 0) return;
  throw InputError(place + ": " + std::to_string(bad) + " voxels are NaN, infinite or negative, the first at index " +
                   text(first) + " with " + std::to_string(value) + "; allowed are finite densities >= 0");
}

template <class Tree>
void copy_values(const Tree& tree, const Coord& origin, Grid& grid) {
  visit_active(tree, [&](const CoordBBox& box, float v) {
    if (v == 0) return;
    const ivec3 lo = vec(box.min() - origin), hi = vec(box.max() - origin);
    for (ivec3 i = lo; i.z <= hi.z; ++i.z)
      for (i.y = lo.y; i.y <= hi.y; ++i.y)
        for (i.x = lo.x; i.x <= hi.x; ++i.x) grid.set(i, v);
  });
}

// OpenVDB multiplies row vectors from the left; sample i of our lattice, at i + 0.5, is voxel i + origin.
dmat4 world_from_lattice(const GridBase& grid, const Coord& origin, const std::string& place) {
  const openvdb::Mat4R rows = grid.transform().baseMap()->getAffineMap()->getMat4();
  dmat4 world_from_index;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) world_from_index[i][j] = rows(i, j);
  const double volume = glm::determinant(glm::dmat3(world_from_index));
  if (!std::isfinite(volume) || volume == 0 || !std::isfinite(glm::determinant(world_from_index)))
    throw InputError(place + ": its transform is singular or not finite; the file is damaged");
  return glm::translate(world_from_index, dvec3(vec(origin)) - 0.5);
}

Grid grid_convert(const GridBase& grid, const std::string& place) {
  const CoordBBox box = grid.evalActiveVoxelBoundingBox();
  const std::uint64_t active = grid.baseTree().activeVoxelCount();
  check_metadata(grid, box, active, place);
  const Coord lo = box.min(), hi = box.max();
  const glm::i64vec3 size(std::int64_t{hi.x()} - lo.x() + 1, std::int64_t{hi.y()} - lo.y() + 1,
                          std::int64_t{hi.z()} - lo.z() + 1);
  grid_expect_fits(place, size, static_cast<double>(active));
  Grid result{ivec3(size)};
  result.source = place;
  result.border = Border::ZERO;
  result.world_from_lattice = world_from_lattice(grid, lo, place);
  grid.apply<DensityGrids>([&](const auto& g) {
    check_values(g.tree(), place);
    copy_values(g.tree(), lo, result);
  });
  return result;
}

VolumeGridInfo grid_describe(VdbFile& file, std::size_t i) {
  const GridBase::Ptr grid = file.read(i, VdbDepth::TOPOLOGY);
  VolumeGridInfo info;
  info.name = file.name(i);
  info.type = grid->valueType();
  info.grid_class = GridBase::gridClassToString(grid->getGridClass());
  info.active_voxels = grid->baseTree().activeVoxelCount();
  if (info.active_voxels > 0) {
    const CoordBBox box = grid->evalActiveVoxelBoundingBox();
    info.index_min = vec(box.min());
    info.index_max = vec(box.max());
  }
  const openvdb::Vec3d voxel = grid->voxelSize();
  info.voxel_size = {voxel.x(), voxel.y(), voxel.z()};
  if (const openvdb::Metadata::Ptr background = grid->baseTree().getBackgroundValue())
    info.background = background->str();
  info.refusal = refusal_by_kind(*grid);
  if (info.refusal.empty()) info.refusal = refusal_by_tree(*grid);
  return info;
}

}  // namespace

std::vector<VolumeGridInfo> vdb_list(const std::filesystem::path& path) {
  std::vector<VolumeGridInfo> infos;
  vdb_guard(path, [&] {
    VdbFile file(path);
    for (std::size_t i = 0; i < file.count(); ++i) infos.push_back(grid_describe(file, i));
  });
  return infos;
}

Grid vdb_read(const std::filesystem::path& path, const std::string& grid_name) {
  Grid result(ivec3(1));
  vdb_guard(path, [&] {
    VdbFile file(path);
    const std::size_t i =
        grid_name.empty() ? find_density(file, path.string()) : find_named(file, path.string(), grid_name);
    const std::string place = file.place(i);
    std::string refused = refusal_by_kind(*file.read(i, VdbDepth::METADATA));
    if (!refused.empty()) throw InputError(place + ": " + refused);
    const GridBase::Ptr grid = file.read(i, VdbDepth::ALL);
    refused = refusal_by_tree(*grid);
    if (!refused.empty()) throw InputError(place + ": " + refused);
    result = grid_convert(*grid, place);
    result.name = file.name(i);
    result.source = path.string();
  });
  return result;
}

}  // namespace brume
