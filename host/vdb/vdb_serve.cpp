// The loop over requests.
#include "vdb/vdb_serve.hpp"

#include <tbb/global_control.h>

#include <optional>

#include "base/error.hpp"
#include "base/helper_serve.hpp"
#include "vdb/vdb_send.hpp"
#include "volume/volume_memory.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

void open_file(const VdbPeer& peer, const fs::path& path, std::optional<VdbFile>& file) {
  helper_limits(path, volume_memory_max);
  file.emplace(path);
  for (std::size_t i = 0; i < file->count(); ++i) vdb_send_head(peer, *file, i);
  peer.send(VolumeFrame::DONE, nullptr, 0);
}

}  // namespace

bool vdb_serve(int socket) {
  // Threads would each take address space, and the work that OpenVDB shares among them is small.
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  const VdbPeer peer(socket);
  std::optional<VdbFile> file;
  VolumeFrameHead head;
  VolumePayload payload;
  while (peer.receive(head, payload)) {
    bool known = true;
    const std::string failure = vdb_guard([&] {
      if (head.kind == VolumeFrame::OPEN && !file)
        open_file(peer, payload.take_text(), file);
      else if (head.kind == VolumeFrame::READ && file)
        vdb_send_grid(peer, *file, payload.take<VolumeReadRequest>());
      else if (head.kind == VolumeFrame::WRITE)
        vdb_write(peer, payload);
      else
        known = false;
    });
    if (!known) return false;
    if (!failure.empty()) peer.send(VolumeFrame::FAILED, nullptr, 0, failure + '\0');
  }
  return true;
}

}  // namespace brume
