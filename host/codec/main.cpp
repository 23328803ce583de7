// brume-image: reads and writes image files for brume, which starts it and talks to it on standard input (image/image_protocol.hpp).
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>

#include "codec/codec.hpp"

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
  const bool served = brume::codec_serve(STDIN_FILENO);
  ::_exit(served ? 0 : 1);  // without the destructors of 250 libraries
}
