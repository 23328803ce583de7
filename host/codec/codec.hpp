// Image files by OpenImageIO, answering the requests of host/image (image_protocol.hpp). Everything here runs in the
// program brume-image, which loads it as a module.
#pragma once

namespace brume {

// Serves requests until the other side closes the socket; returns false on a request that is none.
extern "C" bool codec_serve(int socket);

}  // namespace brume
