// OpenVDB files, answering the requests of host/volume (volume_protocol.hpp). Everything here runs in the program
// brume-volume.
#pragma once

namespace brume {

// Serves one file until the other side closes the socket; returns false on a request that is none.
bool vdb_serve(int socket);

}  // namespace brume
