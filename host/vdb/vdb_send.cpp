// Grids as frames: heads without their voxels, topology, and what is active.
#include "vdb/vdb_send.hpp"

#include <cmath>
#include <limits>

namespace brume {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::GridBase;

// Bool and mask grids hold 0 and 1.
using ScalarGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid,
                                      openvdb::BoolGrid, openvdb::MaskGrid>;

VolumeScalar scalar_of(const GridBase& grid) {
  if (grid.isType<openvdb::BoolGrid>() || grid.isType<openvdb::MaskGrid>()) return VolumeScalar::MASK;
  if (grid.isType<openvdb::Int32Grid>() || grid.isType<openvdb::Int64Grid>()) return VolumeScalar::INTEGER;
  return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>() ? VolumeScalar::FLOATING
                                                                                 : VolumeScalar::NONE;
}

VolumeClass class_of(const GridBase& grid) {
  const openvdb::GridClass kind = grid.getGridClass();
  if (kind == openvdb::GRID_LEVEL_SET) return VolumeClass::LEVEL_SET;
  return kind == openvdb::GRID_FOG_VOLUME || kind == openvdb::GRID_UNKNOWN ? VolumeClass::FOG : VolumeClass::OTHER;
}

template <class T>
float float_of(T value) {
  const double v = static_cast<double>(value);
  const bool fits = std::abs(v) <= std::numeric_limits<float>::max();
  return fits || std::isnan(v) ? static_cast<float>(v)
                               : std::copysign(std::numeric_limits<float>::infinity(), float(v > 0) - 0.5f);
}

void coord_copy(const Coord& from, std::int32_t* to) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

struct Taken {
  bool inside;                 // negative values too
  std::uint64_t inactive = 0;  // seen that are neither active nor background

  template <class T>
  bool operator()(bool active, const T& value, const T& background) {
    if (!active && value != background) ++inactive;
    return active || (inside && value < T(0));
  }
};

template <class Tree>
void send_leaves(const VdbPeer& peer, const Tree& tree, Taken& taken) {
  VdbBatch<VolumeLeaf, LEAVES_PER_FRAME> batch(peer, VolumeFrame::LEAVES);
  const auto background = tree.background();
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    VolumeLeaf& out = batch.add();
    coord_copy(leaf->origin(), out.origin);
    for (openvdb::Index n = 0; n < 512; ++n) {
      const auto value = leaf->getValue(n);
      if (!taken(leaf->isValueOn(n), value, background)) continue;
      out.active[n >> 6] |= std::uint64_t{1} << (n & 63);
      out.values[n] = float_of(value);
    }
  }
  batch.flush();
}

template <class Tree>
void send_tiles(const VdbPeer& peer, const Tree& tree, Taken& taken) {
  VdbBatch<VolumeTile, TILES_PER_FRAME> batch(peer, VolumeFrame::TILES);
  const auto background = tree.background();
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (!taken(tile.isValueOn(), tile.getValue(), background)) continue;
    CoordBBox box;
    tile.getBoundingBox(box);
    VolumeTile& out = batch.add();
    coord_copy(box.min(), out.lo);
    coord_copy(box.max(), out.hi);
    out.value = float_of(tile.getValue());
  }
  batch.flush();
}

// Is what the writer noted down about the grid what is in it? Tools that change a grid and copy its metadata leave the
// old.
bool metadata_is_stale(const GridBase& grid, const VolumeTopology& t) {
  const auto lo = grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MIN);
  const auto hi = grid.getMetadata<openvdb::Vec3IMetadata>(GridBase::META_FILE_BBOX_MAX);
  const auto count = grid.getMetadata<openvdb::Int64Metadata>(GridBase::META_FILE_VOXEL_COUNT);
  if (count && static_cast<std::uint64_t>(count->value()) != t.active) return true;
  return t.active > 0 && ((lo && Coord(lo->value()) != Coord(t.lo[0], t.lo[1], t.lo[2])) ||
                          (hi && Coord(hi->value()) != Coord(t.hi[0], t.hi[1], t.hi[2])));
}

struct Active {
  std::uint64_t count = 0;
  CoordBBox box;
};

// In this thread: OpenVDB's own functions start TBB first, which takes longer than a small grid.
template <class Tree>
Active active_of(const Tree& tree) {
  Active active;
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    active.count += leaf->onVoxelCount();
    leaf->evalActiveBoundingBox(active.box);
  }
  auto tile = tree.cbeginValueOn();
  tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    CoordBBox box;
    tile.getBoundingBox(box);
    active.count += box.volume();
    active.box.expand(box);
  }
  return active;
}

VolumeTopology topology_of(const GridBase& grid) {
  Active active;
  VolumeTopology t{0, {0, 0, 0}, {-1, -1, -1}, 0, 0, 0};
  const bool scalar = grid.apply<ScalarGrids>([&](const auto& g) {
    active = active_of(g.tree());
    t.background = static_cast<double>(g.background());
  });
  if (!scalar) active = {grid.baseTree().activeVoxelCount(), grid.evalActiveVoxelBoundingBox()};
  t.active = active.count;
  if (t.active > 0) {
    coord_copy(active.box.min(), t.lo);
    coord_copy(active.box.max(), t.hi);
  }
  t.stale = metadata_is_stale(grid, t);
  return t;
}

VolumeGridHead head_of(const GridBase& grid) {
  VolumeGridHead head{scalar_of(grid), class_of(grid), grid.transform().isLinear(), {}, {}};
  const openvdb::Vec3d voxel = grid.voxelSize();
  for (int axis = 0; axis < 3; ++axis) head.voxel_size[axis] = voxel[axis];
  if (!head.linear) return head;
  const openvdb::Mat4R rows = grid.transform().baseMap()->getAffineMap()->getMat4();
  for (int i = 0; i < 16; ++i) head.world_from_index[i] = rows(i / 4, i % 4);  // OpenVDB multiplies row vectors
  return head;
}

}  // namespace

void vdb_send_head(const VdbPeer& peer, VdbFile& file, std::size_t i) {
  VolumeGridHead head{};
  std::vector<std::string> texts{file.name(i), file.plain_name(i), file.type(i), "unknown", "", ""};
  texts[5] = vdb_guard([&] {
    const GridBase::Ptr grid = file.read(i, VdbDepth::METADATA);
    head = head_of(*grid);
    texts[2] = grid->valueType();
    texts[3] = GridBase::gridClassToString(grid->getGridClass());
    texts[4] = grid->transform().mapType();
  });
  for (std::string& text : texts) text = text.substr(0, text.find('\0'));
  peer.send(VolumeFrame::GRID, &head, sizeof head, volume_texts(texts));
}

void vdb_send_grid(const VdbPeer& peer, VdbFile& file, const VolumeReadRequest& request) {
  const GridBase::Ptr grid =
      file.read(static_cast<std::size_t>(request.grid), request.voxels ? VdbDepth::ALL : VdbDepth::TOPOLOGY);
  const VolumeTopology topology = topology_of(*grid);
  std::string background;
  if (const openvdb::Metadata::Ptr value = grid->baseTree().getBackgroundValue()) background = value->str();
  peer.send(VolumeFrame::TOPOLOGY, &topology, sizeof topology, volume_texts({background}));
  Taken taken{request.inside != 0};
  if (request.voxels)
    grid->apply<ScalarGrids>([&](const auto& g) {
      send_leaves(peer, g.tree(), taken);
      send_tiles(peer, g.tree(), taken);
    });
  const VolumeReadEnd end{taken.inactive};
  peer.send(VolumeFrame::DONE, &end, sizeof end);
}

}  // namespace brume
