// Requests answered without OpenVDB. Private to host/vdb.
#pragma once
#include <optional>

#include "vdb/plain_file.hpp"
#include "vdb/vdb_peer.hpp"

namespace brume {

// The file that is being served.
struct PlainServed {
  std::string path;
  std::optional<PlainFile> file;
};

// Answers the request, or nothing is sent and the library has to do it: false.
bool plain_answer(const VdbPeer& peer, VolumeFrame kind, VolumePayload payload, PlainServed& served);

}  // namespace brume
