// brume-volume: reads and writes OpenVDB files for brume, which starts it and talks to it on standard input
// (volume/volume_protocol.hpp). Most files it reads by itself; the library is a module that is loaded for the others.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "base/helper_serve.hpp"
#include "vdb/plain_serve.hpp"
#include "vdb/vdb_serve.hpp"

namespace {

bool library_serve(const std::string& path, const brume::VolumeFrameHead& head, brume::VolumePayload& payload) {
  const auto file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "brume-openvdb.so";
  void* const module = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (module == nullptr) std::fprintf(stderr, "brume-volume: %s\n", ::dlerror());
  const auto serve = module == nullptr ? nullptr : reinterpret_cast<brume::VdbServe*>(::dlsym(module, "vdb_serve"));
  return serve != nullptr && serve(STDIN_FILENO, path.c_str(), &head, &payload);
}

bool serve() {
  const brume::VdbPeer peer(STDIN_FILENO);
  brume::PlainServed served;
  brume::VolumeFrameHead head;
  brume::VolumePayload payload;
  while (peer.receive(head, payload))
    if (!brume::plain_answer(peer, head.kind, payload, served)) return library_serve(served.path, head, payload);
  return true;
}

}  // namespace

int main() {
  if (!brume::helper_begin("brume-volume", "read volumes")) return 2;
  ::_exit(serve() ? 0 : 1);  // nothing that a damaged file has left in memory is taken apart
}
