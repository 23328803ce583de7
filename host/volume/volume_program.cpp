// See volume_program.hpp. What comes back is checked: a damaged process may send anything.
#include "volume/volume_program.hpp"

#include <algorithm>
#include <csignal>
#include <optional>
#include <utility>

namespace brume {

namespace {

constexpr std::size_t TEXT_SHOWN = 400;

// Bytes of the UTF-8 character at `at`, 0 where there is none.
std::size_t character_bytes(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0; };
  const int first = byte(at), second = byte(at + 1);
  const std::size_t bytes = first < 0x80   ? 1
                            : first < 0xc2 ? 0
                            : first < 0xe0 ? 2
                            : first < 0xf0 ? 3
                            : first < 0xf5 ? 4
                                           : 0;
  for (std::size_t i = 1; i < bytes; ++i)
    if ((byte(at + i) & 0xc0) != 0x80) return 0;
  const bool outside = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                       (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return outside ? 0 : bytes;
}

// One line of UTF-8 of bounded length, whatever a file or a library says: what is none becomes '?'.
std::string one_line(const std::string& text) {
  std::string line;
  for (std::size_t i = 0; i < text.size() && line.size() < TEXT_SHOWN;) {
    const std::size_t bytes = character_bytes(text, i);
    const bool shown = bytes > 0 && static_cast<unsigned char>(text[i]) >= ' ' && text[i] != 0x7f;
    line += shown ? text.substr(i, bytes) : "?";
    i += std::max<std::size_t>(bytes, 1);
  }
  return line;
}

void pour(VolumeFrame kind, VolumePayload& payload, const VolumeProgram::Sink& sink) {
  if (kind == VolumeFrame::TOPOLOGY) {
    const auto topology = payload.take<VolumeTopology>();
    sink.topology(topology, one_line(payload.take_text()));
  }
  if (kind == VolumeFrame::LEAVES)
    while (payload.count<VolumeLeaf>() > 0) sink.leaf(payload.take<VolumeLeaf>());
  if (kind == VolumeFrame::TILES)
    while (payload.count<VolumeTile>() > 0) sink.tile(payload.take<VolumeTile>());
}

}  // namespace

std::filesystem::path volume_program_file() { return helper_program_file("brume-volume", "volumes"); }

bool volume_send(HelperProgram& program, VolumeFrame kind, const void* data, std::size_t bytes,
                 const std::string& texts) {
  const VolumeFrameHead head{VOLUME_PROTOCOL, kind, bytes + texts.size()};
  return program.send(&head, sizeof head) && program.send(data, bytes) && program.send(texts.data(), texts.size());
}

VolumeProgram::VolumeProgram(const std::filesystem::path& file)
    : file_(file.string()), program_(volume_program_file()) {
  const std::string absolute = std::filesystem::absolute(file).string();
  if (!volume_send(program_, VolumeFrame::OPEN, nullptr, 0, volume_texts({absolute}))) fail_dead();
  VolumePayload payload;
  while (receive(payload, file_) == VolumeFrame::GRID) {
    GridHead grid{payload.take<VolumeGridHead>(), {}, {}, {}, {}, {}, {}};
    for (std::string* text : {&grid.name, &grid.plain_name, &grid.type, &grid.grid_class, &grid.map, &grid.failure})
      *text = one_line(payload.take_text());
    grids_.push_back(std::move(grid));
  }
  if (grids_.empty()) fail_dead();
}

std::string VolumeProgram::place(std::size_t i) const { return file_ + ": grid '" + grids_[i].name + "'"; }

VolumeFrame VolumeProgram::receive(VolumePayload& payload, const std::string& where) {
  VolumeFrameHead head;
  if (!program_.receive(&head, sizeof head)) fail_dead();
  if (head.protocol != VOLUME_PROTOCOL || head.bytes > VOLUME_FRAME_MAX)
    throw RuntimeError(file_ + ": brume-volume is of another version than brume, or the file has damaged it");
  payload.begin(head.bytes);
  if (!program_.receive(payload.bytes.data(), payload.bytes.size())) fail_dead();
  if (head.kind == VolumeFrame::FAILED) throw InputError(where + ": " + one_line(payload.take_text()));
  return head.kind;
}

VolumeReadEnd VolumeProgram::read(std::size_t i, bool voxels, bool inside, const Sink& sink) {
  const VolumeReadRequest request{static_cast<std::int32_t>(i), voxels, inside};
  if (!volume_send(program_, VolumeFrame::READ, &request, sizeof request)) fail_dead();
  const std::string where = place(i);
  VolumePayload payload;
  VolumeFrame kind;
  std::optional<InputError> refused;  // by the sink; thrown when all is said, so that the program can be asked again
  while ((kind = receive(payload, where)) != VolumeFrame::DONE) {
    if (refused) continue;
    try {
      pour(kind, payload, sink);
    } catch (const InputError& error) {
      refused = error;
    }
  }
  if (refused) throw InputError(*refused);
  return payload.take<VolumeReadEnd>();
}

void VolumeProgram::fail_dead() {
  const std::string how = program_.end();
  for (const int outside : {SIGKILL, SIGTERM})
    if (how == "signal " + std::to_string(outside))
      throw RuntimeError(file_ + ": cannot be read: the reader was killed by " + how);
  throw VolumeCrash(file_ + ": is damaged: the reader ended by " + (how.empty() ? "itself" : how));
}

}  // namespace brume
