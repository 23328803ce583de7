// brume-mesh: reads PLY and glTF files for brume, which starts it and talks to it on standard input
// (mesh/mesh_protocol.hpp).
#include <unistd.h>

#include "assimp/mesh_serve.hpp"
#include "base/helper_serve.hpp"

int main() {
  if (!brume::helper_begin("brume-mesh", "read meshes")) return 2;
  ::_exit(brume::mesh_serve(STDIN_FILENO) ? 0 : 1);  // nothing that a damaged file has left in memory is taken apart
}
