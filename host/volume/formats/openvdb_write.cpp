// Grid -> OpenVDB file, written by brume-volume.
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "volume/formats/openvdb.hpp"
#include "volume/volume_program.hpp"

namespace brume {

namespace {

VolumeLeaf leaf_of(ivec3 block, const float* samples) {
  VolumeLeaf leaf{};
  for (int axis = 0; axis < 3; ++axis) leaf.origin[axis] = block[axis] * GRID_BLOCK;
  for (int z = 0; z < GRID_BLOCK; ++z)
    for (int y = 0; y < GRID_BLOCK; ++y)
      for (int x = 0; x < GRID_BLOCK; ++x) leaf.values[(x << 6) | (y << 3) | z] = *samples++;
  return leaf;
}

bool send_grid(HelperProgram& program, const Grid& grid, const std::string& path, bool half) {
  VolumeWriteHead head{half, {grid.size().x, grid.size().y, grid.size().z}, {}};
  const dmat4 world_from_index = glm::translate(grid.world_from_lattice, dvec3(0.5));
  std::memcpy(head.world_from_index, glm::value_ptr(world_from_index), sizeof head.world_from_index);
  const std::string name = grid.name.empty() ? "density" : grid.name;
  if (!volume_send(program, VolumeFrame::WRITE, &head, sizeof head, volume_texts({path, name}))) return false;
  bool sent = true;
  grid_visit_blocks(grid, [&](ivec3 b) {
    if (!sent) return;
    const VolumeLeaf leaf = leaf_of(b, grid.block(b));
    sent = volume_send(program, VolumeFrame::LEAVES, &leaf, sizeof leaf);
  });
  if (!sent) return false;
  return volume_send(program, VolumeFrame::DONE, nullptr, 0);
}

}  // namespace

void vdb_write(const Grid& grid, const std::filesystem::path& file, VdbPrecision precision) {
  AtomicFile target(file);
  HelperProgram program(volume_program_file());
  VolumeFrameHead answer{};
  VolumePayload payload;
  bool answered = send_grid(program, grid, std::filesystem::absolute(target.temporary()).string(),
                            precision == VdbPrecision::HALF) &&
                  program.receive(&answer, sizeof answer) && answer.bytes <= VOLUME_FRAME_MAX;
  if (answered) {
    payload.bytes.resize(answer.bytes);
    answered = program.receive(payload.bytes.data(), payload.bytes.size());
  }
  if (!answered || answer.kind != VolumeFrame::DONE)
    throw RuntimeError(file.string() + ": cannot be written: " +
                       (answered ? payload.take_text() : "brume-volume ended by " + program.end()));
  target.commit();
}

}  // namespace brume
