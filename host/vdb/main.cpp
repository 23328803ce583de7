// brume-volume: reads and writes OpenVDB files for brume, which starts it and talks to it on standard input
// (volume/volume_protocol.hpp).
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>

#include "vdb/vdb_serve.hpp"

int main() {
  int type = 0;
  socklen_t size = sizeof type;
  if (::getsockopt(STDIN_FILENO, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
    std::fputs("brume-volume: a part of brume, which starts it to read volumes; there is nothing to do by hand\n",
               stderr);
    return 2;
  }
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const bool served = brume::vdb_serve(STDIN_FILENO);
  ::_exit(served ? 0 : 1);  // nothing that a damaged file has left in memory is taken apart
}
