// brume-image: reads and writes image files for brume, which starts it and talks to it on standard input
// (image/image_protocol.hpp).
#include <dlfcn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "codec_libraries.hpp"

namespace {

// The module beside this program that does the work. Linked in the ordinary way, each symbol of its 250
// libraries would be
// looked for in all of them; loaded one by one, those that others need first, each is looked for in its own
// few. A library
// that cannot be loaded alone comes with one that needs it.
void* codec_load() {
  for (const char* library : CODEC_LIBRARIES) ::dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  const auto module = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "brume-codec.so";
  void* const loaded = ::dlopen(module.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (loaded == nullptr) std::fprintf(stderr, "brume-image: %s\n", ::dlerror());
  return loaded;
}

}  // namespace

int main() {
  int type = 0;
  socklen_t size = sizeof type;
  if (::getsockopt(STDIN_FILENO, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
    std::fputs(
        "brume-image: a part of brume, which starts it to read and write images; there is nothing to do by hand\n",
        stderr);
    return 2;
  }
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  void* const codec = codec_load();
  if (codec == nullptr) return 1;
  const auto serve = reinterpret_cast<bool (*)(int)>(::dlsym(codec, "codec_serve"));
  const bool served = serve != nullptr && serve(STDIN_FILENO);
  ::_exit(served ? 0 : 1);  // without the destructors of 250 libraries
}
