// The loop over requests, and the limits under which a file is read.
#include "vdb/vdb_serve.hpp"

#include <sys/resource.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "base/error.hpp"
#include "vdb/vdb_send.hpp"
#include "volume/volume_memory.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

constexpr rlim_t SECONDS_MIN = 10, BYTES_PER_SECOND = 1 << 20;  // of the processor; a file in order takes a hundredth

// What this program takes by itself, libraries included, comes on top of what the file may ask for.
void limits_set(const fs::path& file) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  if (failed) return;  // opening it will say why
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t memory = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + volume_memory_max(size);
  const rlim_t seconds = SECONDS_MIN + size / BYTES_PER_SECOND;
  for (const auto& [resource, value] : {std::pair{RLIMIT_AS, memory}, std::pair{RLIMIT_CPU, seconds}}) {
    rlimit limit{};
    ::getrlimit(resource, &limit);
    limit.rlim_cur = std::min(limit.rlim_max, value);
    ::setrlimit(resource, &limit);
  }
}

void open_file(const VdbPeer& peer, const fs::path& path, std::optional<VdbFile>& file) {
  limits_set(path);
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
