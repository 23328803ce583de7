// Frames → OpenVDB file.
#include <openvdb/openvdb.h>

#include "base/error.hpp"
#include "vdb/vdb_send.hpp"

namespace brume {

namespace {

void leaf_set(const VolumeLeaf& leaf, openvdb::FloatGrid::Accessor& accessor) {
  const openvdb::Coord origin(leaf.origin[0], leaf.origin[1], leaf.origin[2]);
  for (int n = 0; n < 512; ++n)
    if (leaf.values[n] != 0) accessor.setValueOn(origin.offsetBy(n >> 6, (n >> 3) & 7, n & 7), leaf.values[n]);
}

openvdb::math::Transform::Ptr transform_of(const VolumeWriteHead& head) {
  openvdb::Mat4R rows;
  for (int i = 0; i < 16; ++i) rows(i / 4, i % 4) = head.world_from_index[i];
  return openvdb::math::Transform::createLinearTransform(rows);
}

}  // namespace

void vdb_write(const VdbPeer& peer, VolumePayload request) {
  const auto head = request.take<VolumeWriteHead>();
  const std::string path = request.take_text(), name = request.take_text();
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr vdb = openvdb::FloatGrid::create(0.0f);
  auto accessor = vdb->getAccessor();
  VolumeFrameHead frame;
  VolumePayload leaves;
  while (peer.receive(frame, leaves) && frame.kind == VolumeFrame::LEAVES)
    while (leaves.count<VolumeLeaf>() > 0) leaf_set(leaves.take<VolumeLeaf>(), accessor);
  if (frame.kind != VolumeFrame::DONE) ::_exit(0);  // the other side has given up
  // the outermost corners, whatever they hold: a reader then finds the same bounds
  accessor.setActiveState(openvdb::Coord(0, 0, 0), true);
  accessor.setActiveState(openvdb::Coord(head.size[0] - 1, head.size[1] - 1, head.size[2] - 1), true);
  vdb->tree().prune();  // blocks of one value become tiles
  vdb->setName(name);
  vdb->setGridClass(openvdb::GRID_FOG_VOLUME);
  vdb->setTransform(transform_of(head));
  vdb->setSaveFloatAsHalf(head.half != 0);
  openvdb::io::File(path).write(openvdb::GridCPtrVec{vdb});
  VdbFile{path};  // OpenVDB does not notice a full disk; its own offsets do
  peer.send(VolumeFrame::DONE, nullptr, 0);
}

}  // namespace brume
