// The side of brume-volume of the socket. Private to host/vdb.
#pragma once
#include <unistd.h>

#include <vector>

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

constexpr std::size_t LEAVES_PER_FRAME = 128, TILES_PER_FRAME = 4096;

// Structs gathered into frames.
template <class T, std::size_t PER_FRAME>
class VdbBatch {
 public:
  VdbBatch(const VdbPeer& peer, VolumeFrame kind) : peer_(peer), kind_(kind) { items_.reserve(PER_FRAME); }
  T& add() {
    if (items_.size() == PER_FRAME) flush();
    return items_.emplace_back();
  }
  void flush() {
    if (!items_.empty()) peer_.send(kind_, items_.data(), items_.size() * sizeof(T));
    items_.clear();
  }

 private:
  const VdbPeer& peer_;
  VolumeFrame kind_;
  std::vector<T> items_;
};

}  // namespace brume
