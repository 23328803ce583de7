// OpenVDB files as they mostly are, read without OpenVDB: to load the library takes three times as long as to read a
// small file. It knows grids of floats in the tree of 5, 4 and 3 bits that are scaled and shifted, of the file versions
// since 2013. Whatever else it finds, and whatever is wrong with a file, is left to the library, which says it better.
// Private to host/vdb.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vdb/mapped_file.hpp"
#include "volume/volume_protocol.hpp"

namespace brume {

// Thrown where the library has to do it.
struct NotPlain {};

// Bytes taken from the front. NotPlain where there are no more.
class PlainBytes {
 public:
  PlainBytes(const char* begin, const char* end) : at_(begin), end_(end) {}
  const char* at() const { return at_; }
  const char* skip(std::uint64_t bytes) {
    if (bytes > static_cast<std::uint64_t>(end_ - at_)) throw NotPlain();
    at_ += bytes;
    return at_ - bytes;
  }
  template <class T>
  T take() {
    T value;
    std::memcpy(&value, skip(sizeof value), sizeof value);
    return value;
  }
  std::string take_text() {
    const auto bytes = take<std::uint32_t>();
    return {skip(bytes), bytes};
  }

 private:
  const char *at_, *end_;
};

// What a file says of a grid before its voxels.
struct PlainGrid {
  std::string name, grid_class, map;
  VolumeGridHead head;
  bool half = false;               // voxels are stored in 2 bytes
  std::uint32_t compression = 0;   // openvdb::io's bits
  const char *tree, *end;          // where it lies
  bool counted = false, boxed[2];  // the writer noted down
  std::int64_t count = 0;          // how many voxels are active,
  std::int32_t box[2][3] = {};     // and between which they lie
};

class PlainFile {
 public:
  // NotPlain, too, where the file cannot be opened.
  explicit PlainFile(const std::filesystem::path& file);
  const std::vector<PlainGrid>& grids() const { return grids_; }

 private:
  MappedFile bytes_;
  std::vector<PlainGrid> grids_;
};

// What READ asks for.
struct PlainVoxels {
  VolumeTopology topology;
  std::vector<VolumeLeaf> leaves;
  std::vector<VolumeTile> tiles;
  VolumeReadEnd end;
};
PlainVoxels plain_read(const PlainGrid& grid, const VolumeReadRequest& request);

}  // namespace brume
