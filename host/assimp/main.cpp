// brume-mesh: reads PLY and glTF files for brume, which starts it and talks to it on standard input
// (mesh/mesh_protocol.hpp).
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>

#include "assimp/mesh_serve.hpp"

int main() {
  int type = 0;
  socklen_t size = sizeof type;
  if (::getsockopt(STDIN_FILENO, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
    std::fputs("brume-mesh: a part of brume, which starts it to read meshes; there is nothing to do by hand\n", stderr);
    return 2;
  }
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::_exit(brume::mesh_serve(STDIN_FILENO) ? 0 : 1);  // nothing that a damaged file has left in memory is taken apart
}
