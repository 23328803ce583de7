// See plain_serve.hpp.
#include "vdb/plain_serve.hpp"

#include <exception>
#include <sstream>

#include "base/helper_serve.hpp"
#include "volume/volume_memory.hpp"

namespace brume {

namespace {

void open_file(const VdbPeer& peer, const std::string& path, PlainServed& served) {
  helper_limits(path, volume_memory_max);
  served.file.emplace(path);
  served.path = path;
  for (const PlainGrid& grid : served.file->grids())
    peer.send(VolumeFrame::GRID, &grid.head, sizeof grid.head,
              volume_texts({grid.name, grid.name, "float", grid.grid_class, grid.map, ""}));
  peer.send(VolumeFrame::DONE, nullptr, 0);
}

template <class T, std::size_t PER_FRAME>
void send_all(const VdbPeer& peer, VolumeFrame kind, const std::vector<T>& items) {
  for (std::size_t i = 0; i < items.size(); i += PER_FRAME)
    peer.send(kind, items.data() + i, std::min(PER_FRAME, items.size() - i) * sizeof(T));
}

void send_grid(const VdbPeer& peer, const PlainFile& file, const VolumeReadRequest& request) {
  const PlainVoxels voxels = plain_read(file.grids().at(static_cast<std::size_t>(request.grid)), request);
  std::ostringstream background;
  background << static_cast<float>(voxels.topology.background);
  peer.send(VolumeFrame::TOPOLOGY, &voxels.topology, sizeof voxels.topology, volume_texts({background.str()}));
  send_all<VolumeLeaf, LEAVES_PER_FRAME>(peer, VolumeFrame::LEAVES, voxels.leaves);
  send_all<VolumeTile, TILES_PER_FRAME>(peer, VolumeFrame::TILES, voxels.tiles);
  peer.send(VolumeFrame::DONE, &voxels.end, sizeof voxels.end);
}

}  // namespace

bool plain_answer(const VdbPeer& peer, VolumeFrame kind, VolumePayload payload, PlainServed& served) try {
  if (kind == VolumeFrame::OPEN && !served.file)
    open_file(peer, payload.take_text(), served);
  else if (kind == VolumeFrame::READ && served.file)
    send_grid(peer, *served.file, payload.take<VolumeReadRequest>());
  else
    return false;
  return true;
} catch (const NotPlain&) {
  return false;
} catch (const std::exception&) {  // such as too little memory
  return false;
}

}  // namespace brume
