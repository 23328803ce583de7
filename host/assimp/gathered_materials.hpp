// Materials of a file of Assimp's: base colour and emission with their images. Private to host/assimp.
#pragma once
#include "assimp/gathered_mesh.hpp"

namespace brume {

void materials_gather(const aiScene& scene, GatheredMesh& out);

}  // namespace brume
