// The grids of a file as frames. Private to host/vdb.
#pragma once
#include "vdb/vdb_file.hpp"
#include "vdb/vdb_peer.hpp"

namespace brume {

// GRID. What OpenVDB throws about this one grid becomes part of it.
void vdb_send_head(const VdbPeer& peer, VdbFile& file, std::size_t i);

// TOPOLOGY, LEAVES, TILES and DONE.
void vdb_send_grid(const VdbPeer& peer, VdbFile& file, const VolumeReadRequest& request);

// Receives LEAVES up to DONE and writes them.
void vdb_write(const VdbPeer& peer, VolumePayload request);

}  // namespace brume
