// What brume and brume-volume (host/vdb) say to each other over a socket: frames, in the machine's own byte order; both
// are built together. The program sees one file and then ends.
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace brume {

inline constexpr std::int32_t VOLUME_PROTOCOL = 1;  // a program left over from another version is told, not guessed at
inline constexpr std::uint64_t VOLUME_FRAME_MAX = 16 << 20;

// brume: OPEN, answered by a GRID for every grid of the file and DONE; then any number of READ, each answered by
// TOPOLOGY, and where the voxels were asked for LEAVES and TILES, and DONE. Or WRITE, LEAVES and DONE, answered by
// DONE. FAILED ends any answer.
enum class VolumeFrame : std::int32_t { OPEN, GRID, READ, TOPOLOGY, LEAVES, TILES, WRITE, DONE, FAILED };

struct VolumeFrameHead {
  std::int32_t protocol;
  VolumeFrame kind;
  std::uint64_t bytes;  // that follow, at most VOLUME_FRAME_MAX: a struct below and texts, each ended by a NUL
};

// OPEN: text path.
// GRID: texts name (unique), name in the file, value type, class, type of map, and why it cannot be read ("" if it
// can).
enum class VolumeScalar : std::int32_t { NONE, FLOATING, INTEGER, MASK };
enum class VolumeClass : std::int32_t { FOG, LEVEL_SET, OTHER };
struct VolumeGridHead {
  VolumeScalar scalar;
  VolumeClass grid_class;
  std::int32_t linear;
  double voxel_size[3];
  double world_from_index[16];  // by columns; where linear
};

struct VolumeReadRequest {
  std::int32_t grid;    // number of its GRID frame
  std::int32_t voxels;  // 0: TOPOLOGY alone
  std::int32_t inside;  // what is negative counts as active: the inside of a level set
};

// TOPOLOGY: text background.
struct VolumeTopology {
  std::uint64_t active;
  std::int32_t lo[3], hi[3];  // box of the active voxels, inclusive; lo > hi where there are none
  double background;          // of scalar grids
  std::int32_t stale;         // what the writer noted down about the grid is not what is in it
  std::int32_t unused;
};

// LEAVES, TILES: as many of these as fit. Values that float cannot hold are infinite.
struct VolumeLeaf {
  std::int32_t origin[3];  // index of the first voxel, a multiple of 8
  std::int32_t unused;
  std::uint64_t active[8];  // bit y * 8 + z of active[x], as values
  float values[512];        // [x][y][z]
};
struct VolumeTile {
  std::int32_t lo[3], hi[3];  // inclusive
  float value;
};

// DONE of a READ.
struct VolumeReadEnd {
  std::uint64_t inactive;  // voxels that are neither active nor background; tiles count as one
};

// WRITE: texts path, name. The leaves' origins are in the lattice, the voxels that are not 0 active.
struct VolumeWriteHead {
  std::int32_t half;
  std::int32_t size[3];
  double world_from_index[16];
};

inline std::string volume_texts(const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts) joined += text + '\0';
  return joined;
}

// What a frame holds, taken apart from its front. Short ones give zeros and empty texts: a damaged process may send
// anything.
class VolumePayload {
 public:
  std::vector<char> bytes;
  // Room for the next frame, in the memory of this one.
  void begin(std::size_t size) {
    bytes.resize(size);
    at_ = 0;
  }
  template <class T>
  T take() {
    T value{};
    if (bytes.size() - at_ >= sizeof value) {
      std::memcpy(&value, bytes.data() + at_, sizeof value);
      at_ += sizeof value;
    }
    return value;
  }
  std::string take_text() {
    std::string text;
    while (at_ < bytes.size() && bytes[at_] != '\0') text += bytes[at_++];
    at_ += at_ < bytes.size();
    return text;
  }
  template <class T>
  std::size_t count() const {
    return (bytes.size() - at_) / sizeof(T);
  }

 private:
  std::size_t at_ = 0;
};

}  // namespace brume
