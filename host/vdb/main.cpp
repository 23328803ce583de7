// brume-volume: reads and writes OpenVDB files for brume, which starts it and talks to it on standard input
// (volume/volume_protocol.hpp).
#include <unistd.h>

#include "base/helper_serve.hpp"
#include "vdb/vdb_serve.hpp"

int main() {
  if (!brume::helper_begin("brume-volume", "read volumes")) return 2;
  ::_exit(brume::vdb_serve(STDIN_FILENO) ? 0 : 1);  // nothing that a damaged file has left in memory is taken apart
}
