// Grid -> OpenVDB file.
#include <openvdb/openvdb.h>

#include <glm/gtc/matrix_transform.hpp>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "volume/formats/openvdb.hpp"
#include "volume/formats/openvdb_file.hpp"

namespace brume {

namespace {

openvdb::math::Transform::Ptr transform_of(const Grid& grid) {
  const dmat4 world_from_index = glm::translate(grid.world_from_lattice, dvec3(0.5));
  openvdb::Mat4R rows;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) rows(i, j) = world_from_index[i][j];
  return openvdb::math::Transform::createLinearTransform(rows);
}

openvdb::FloatGrid::Ptr vdb_of(const Grid& grid) {
  const openvdb::FloatGrid::Ptr vdb = openvdb::FloatGrid::create(0.0f);
  auto accessor = vdb->getAccessor();
  grid_visit_stored(grid, [&](ivec3 i, float value) {
    if (value != 0.0f) accessor.setValueOn(openvdb::Coord(i.x, i.y, i.z), value);
  });
  // the outermost corners, whatever they hold: a reader then finds the same bounds
  const ivec3 last = grid.size() - 1;
  accessor.setActiveState(openvdb::Coord(0, 0, 0), true);
  accessor.setActiveState(openvdb::Coord(last.x, last.y, last.z), true);
  vdb->tree().prune();  // blocks of one value become tiles
  vdb->setName(grid.name.empty() ? "density" : grid.name);
  vdb->setGridClass(openvdb::GRID_FOG_VOLUME);
  vdb->setTransform(transform_of(grid));
  return vdb;
}

}  // namespace

void vdb_write(const Grid& grid, const std::filesystem::path& file, VdbPrecision precision) {
  AtomicFile target(file);
  try {
    openvdb::initialize();
    const openvdb::FloatGrid::Ptr vdb = vdb_of(grid);
    vdb->setSaveFloatAsHalf(precision == VdbPrecision::HALF);
    openvdb::io::File(target.temporary().string()).write(openvdb::GridCPtrVec{vdb});
    VdbFile(target.temporary());  // OpenVDB does not notice a full disk; its own offsets do
  } catch (const std::exception& e) {
    throw RuntimeError(file.string() + ": cannot be written: " + e.what());
  }
  target.commit();
}

}  // namespace brume
