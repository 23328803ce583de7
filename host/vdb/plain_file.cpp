// Heads of grids: openvdb::io::File, GridDescriptor, MetaMap and the maps of a transform write what is read here.
#include "vdb/plain_file.hpp"

#include <cmath>

#include "base/error.hpp"

namespace brume {

namespace {

constexpr std::int64_t MAGIC = 0x56444220;                     // "VDB "
constexpr std::uint32_t VERSION_MIN = 222, VERSION_MAX = 224;  // since values are stored by masks
constexpr int GRIDS_MAX = 100, METADATA_MAX = 10000, UUID_BYTES = 36;
constexpr char UNIQUE = 0x1e;  // of a name that several grids share
const std::string TREE = "Tree_float_5_4_3", TREE_HALF = TREE + "_HalfFloat";

void expect(bool plain) {
  if (!plain) throw NotPlain();
}

void box_corner(PlainBytes value, std::uint32_t bytes, PlainGrid& grid, int corner) {
  expect(bytes == sizeof grid.box[corner]);
  std::memcpy(grid.box[corner], value.at(), bytes);
  grid.boxed[corner] = true;
}

// Name, type and value of each; `grid`: what is to be known of it.
void metadata_read(PlainBytes& in, PlainGrid* grid) {
  const auto count = in.take<std::int32_t>();
  expect(count >= 0 && count < METADATA_MAX);
  for (int i = 0; i < count; ++i) {
    const std::string name = in.take_text(), type = in.take_text();
    const auto bytes = in.take<std::uint32_t>();
    const char* const begin = in.skip(bytes);
    if (grid == nullptr) continue;
    PlainBytes value(begin, begin + bytes);
    if (name == "class") {
      expect(type == "string");
      grid->grid_class.assign(begin, bytes);
    } else if (name == "is_saved_as_half_float") {
      expect(type == "bool");
      grid->half = value.take<char>() != 0;
    } else if (name == "file_voxel_count" && type == "int64") {
      grid->counted = true;
      grid->count = value.take<std::int64_t>();
    } else if (name == "file_bbox_min" && type == "vec3i") {
      box_corner(value, bytes, *grid, 0);
    } else if (name == "file_bbox_max" && type == "vec3i") {
      box_corner(value, bytes, *grid, 1);
    }
  }
}

// The map's own numbers come first; what follows from them the library stores too.
void transform_read(PlainBytes& in, PlainGrid& grid) {
  grid.map = in.take_text();
  const bool shifts = grid.map == "ScaleTranslateMap" || grid.map == "UniformScaleTranslateMap";
  expect(shifts || grid.map == "ScaleMap" || grid.map == "UniformScaleMap");
  double shift[3] = {}, scale[3], side[3];
  for (double& x : shift)
    if (shifts) x = in.take<double>();
  for (double& x : scale) x = in.take<double>();
  for (double& x : side) x = in.take<double>();
  in.skip(9 * sizeof(double));  // inverses and squares
  for (int axis = 0; axis < 3; ++axis) {
    expect(std::isfinite(shift[axis]) && std::isfinite(scale[axis]) && scale[axis] != 0);
    grid.head.voxel_size[axis] = side[axis];
    grid.head.world_from_index[5 * axis] = scale[axis];
    grid.head.world_from_index[12 + axis] = shift[axis];
  }
  grid.head.world_from_index[15] = 1;
}

void class_find(PlainGrid& grid) {
  if (grid.grid_class.empty()) grid.grid_class = "unknown";
  const bool levels = grid.grid_class == "level set";
  expect(levels || grid.grid_class == "fog volume" || grid.grid_class == "unknown");
  grid.head.grid_class = levels ? VolumeClass::LEVEL_SET : VolumeClass::FOG;
}

// `file`: where its bytes begin and end. Moves past the grid.
PlainGrid grid_read(PlainBytes& in, const char* file, const char* end) {
  PlainGrid grid{};
  grid.name = in.take_text();
  expect(grid.name.find('\0') == std::string::npos && grid.name.find(UNIQUE) == std::string::npos);
  const std::string type = in.take_text();
  expect((type == TREE || type == TREE_HALF) && in.take_text().empty());  // the tree of another grid
  const auto begin = in.take<std::int64_t>();
  in.take<std::int64_t>();  // where its blocks are
  const auto grid_end = in.take<std::int64_t>();
  expect(in.at() - file <= begin && begin <= grid_end && grid_end <= end - file);
  in = PlainBytes(file + begin, file + grid_end);
  grid.compression = in.take<std::uint32_t>();
  grid.head.scalar = VolumeScalar::FLOATING;
  grid.head.linear = 1;
  metadata_read(in, &grid);
  expect(grid.half == (type == TREE_HALF));
  class_find(grid);
  transform_read(in, grid);
  grid.tree = in.at();
  grid.end = file + grid_end;
  in = PlainBytes(grid.end, end);
  return grid;
}

MappedFile file_open(const std::filesystem::path& file) try { return MappedFile(file); } catch (const InputError&) {
  throw NotPlain();
}

}  // namespace

PlainFile::PlainFile(const std::filesystem::path& file) : bytes_(file_open(file)) {
  const char *const begin = bytes_.data(), *const end = begin + bytes_.size();
  PlainBytes in(begin, end);
  expect(in.take<std::int64_t>() == MAGIC);
  const auto version = in.take<std::uint32_t>();
  expect(version >= VERSION_MIN && version <= VERSION_MAX);
  in.skip(2 * sizeof(std::uint32_t));  // of the library
  expect(in.take<char>() != 0);        // grids say where they lie
  in.skip(UUID_BYTES);
  metadata_read(in, nullptr);
  const auto count = in.take<std::int32_t>();
  expect(count > 0 && count < GRIDS_MAX);
  for (int i = 0; i < count; ++i) grids_.push_back(grid_read(in, begin, end));
}

}  // namespace brume
