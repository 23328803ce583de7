// An OpenVDB file opened strictly: what openvdb::io::File reads, but a file that ends early is an error instead of
// zeros. Messages leave out the file, which the other side knows. Private to host/vdb.
#pragma once
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vdb/mapped_file.hpp"

namespace brume {

// A name out of a file, fit for a line of text: control and non-ASCII bytes become '?', long ones are cut.
std::string vdb_printable(const std::string& text);

// Runs `work`; says what it threw: "cannot be read: ...", "" if nothing.
std::string vdb_guard(const std::function<void()>& work);

// How much of a grid to read: without the voxels' values a grid still has its background, tiles and active voxels.
enum class VdbDepth { METADATA, TOPOLOGY, ALL };

class VdbFile : private openvdb::io::Archive {
 public:
  // Reads the header and checks that every grid lies within the file. Throws InputError and what OpenVDB throws.
  explicit VdbFile(const std::filesystem::path& file);

  std::size_t count() const { return entries_.size(); }
  std::string name(std::size_t i) const;        // readable and unique: "density[1]" where several share a name
  std::string plain_name(std::size_t i) const;  // "density"
  const std::string& type(std::size_t i) const { return entries_[i].type; }
  openvdb::GridBase::Ptr read(std::size_t i, VdbDepth depth);

 private:
  struct Entry {
    openvdb::io::GridDescriptor descriptor;
    std::string type;
  };
  void entries_read();
  openvdb::GridBase::Ptr read_own(const Entry& entry, VdbDepth depth);

  MappedFile bytes_;
  std::istream in_;
  openvdb::io::StreamMetadata::Ptr stream_metadata_;
  std::vector<Entry> entries_;
};

}  // namespace brume
