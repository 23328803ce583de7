// One request: the file read by Assimp under limits of memory and time, and sent. Private to host/assimp.
#pragma once

namespace brume {

// False for what is no request.
bool mesh_serve(int socket);

}  // namespace brume
