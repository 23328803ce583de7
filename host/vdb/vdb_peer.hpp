// The side of brume-volume of the socket. Private to host/vdb.
#pragma once
#include <unistd.h>

#include "base/helper_program.hpp"
#include "volume/volume_protocol.hpp"

namespace brume {

class VdbPeer {
 public:
  explicit VdbPeer(int socket) : socket_(socket) {}

  void send(VolumeFrame kind, const void* data, std::size_t bytes, const std::string& texts = {}) const {
    const VolumeFrameHead head{VOLUME_PROTOCOL, kind, bytes + texts.size()};
    if (!helper_send(socket_, &head, sizeof head) || !helper_send(socket_, data, bytes) ||
        !helper_send(socket_, texts.data(), texts.size()))
      ::_exit(0);  // nobody waits any more
  }
  // False at the end, and for what is no frame.
  bool receive(VolumeFrameHead& head, VolumePayload& payload) const {
    if (!helper_receive(socket_, &head, sizeof head) || head.protocol != VOLUME_PROTOCOL ||
        head.bytes > VOLUME_FRAME_MAX)
      return false;
    payload.begin(head.bytes);
    return helper_receive(socket_, payload.bytes.data(), payload.bytes.size());
  }

 private:
  int socket_;
};

}  // namespace brume
