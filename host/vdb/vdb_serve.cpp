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

void open_file(const fs::path& path, std::optional<VdbFile>& file) {
  helper_limits(path, volume_memory_max);
  file.emplace(path);
}

void send_heads(const VdbPeer& peer, std::optional<VdbFile>& file) {
  for (std::size_t i = 0; i < file->count(); ++i) vdb_send_head(peer, *file, i);
  peer.send(VolumeFrame::DONE, nullptr, 0);
}

}  // namespace

bool vdb_serve(int socket, const char* path, const VolumeFrameHead* first, VolumePayload* payload) {
  // Threads would each take address space, and the work that OpenVDB shares among them is small.
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  const VdbPeer peer(socket);
  std::optional<VdbFile> file;
  VolumeFrameHead head = *first;
  do {
    bool known = true;
    const std::string failure = vdb_guard([&] {
      if (!file && *path != '\0') open_file(path, file);
      if (head.kind == VolumeFrame::OPEN && !file) {
        open_file(payload->take_text(), file);
        send_heads(peer, file);
      } else if (head.kind == VolumeFrame::READ && file) {
        vdb_send_grid(peer, *file, payload->take<VolumeReadRequest>());
      } else if (head.kind == VolumeFrame::WRITE) {
        vdb_write(peer, std::move(*payload));
      } else {
        known = false;
      }
    });
    if (!known) return false;
    if (!failure.empty()) peer.send(VolumeFrame::FAILED, nullptr, 0, failure + '\0');
  } while (peer.receive(head, *payload));
  return true;
}

}  // namespace brume
