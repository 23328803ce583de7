// OpenVDB files, answering the requests of host/volume (volume_protocol.hpp) by the library. A module, which brume-volume
// loads where its own reader does not do (plain_file.hpp).
#pragma once
#include "vdb/vdb_peer.hpp"

namespace brume {

// Goes on from the first request until the other side closes the socket; `path`: a file that has been opened before, ""
// for none. False on a request that is none.
using VdbServe = bool(int socket, const char* path, const VolumeFrameHead* head, VolumePayload* payload);
extern "C" VdbServe vdb_serve;

}  // namespace brume
