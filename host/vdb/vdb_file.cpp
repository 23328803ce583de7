// openvdb::io::File 10.0.1 does not look at its stream: a file cut within its header has no grids, one cut later has
// zeros, both without an error. Here the stream throws at its end, and the offsets in the header are held against the
// size. Out of reach: OpenVDB before 11.0 trusts the sizes inside compressed chunks, so that a changed byte can make
// the decompressor read or write out of bounds. That is why all this runs in a process of its own.
#include "vdb/vdb_file.hpp"

#include <openvdb/io/io.h>

#include "base/error.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t NAME_MAX_SHOWN = 80;
constexpr int GRIDS_MAX = 10000;

std::string name_of(const openvdb::io::GridDescriptor& descriptor) {
  return openvdb::io::GridDescriptor::nameAsString(descriptor.uniqueName());
}

std::string name_quoted(const openvdb::io::GridDescriptor& descriptor) {
  return "grid '" + vdb_printable(name_of(descriptor)) + "': ";
}

}  // namespace

std::string vdb_printable(const std::string& text) {
  std::string shown = text.substr(0, NAME_MAX_SHOWN);
  for (char& c : shown)
    if (c < 0x20 || c == 0x7f) c = '?';
  return text.size() > NAME_MAX_SHOWN ? shown + "..." : shown;
}

std::string vdb_guard(const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const InputError& e) {
    return e.what();
  } catch (const std::ios_base::failure&) {
    return "cannot be read: the file ends too early; it is cut short or damaged";
  } catch (const std::bad_alloc&) {
    return "cannot be read: asks for more memory than 1 GiB and 20 times its size; it is damaged";
  } catch (const std::exception& e) {
    return "cannot be read: OpenVDB says " + vdb_printable(e.what());
  }
}

VdbFile::VdbFile(const fs::path& file) : bytes_(file), in_(&bytes_), stream_metadata_(new openvdb::io::StreamMetadata) {
  static const bool once = (openvdb::initialize(), true);
  static_cast<void>(once);
  in_.exceptions(std::ios::failbit | std::ios::badbit);
  readHeader(in_);
  if (!inputHasGridOffsets())
    throw InputError("was written as a stream; expected a file with grid offsets, as vdb tools write");
  if (fileVersion() < openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING)
    throw InputError("has the old file version " + std::to_string(fileVersion()) + ", expected at least " +
                     std::to_string(openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING));
  stream_metadata_->setSeekable(true);
  openvdb::io::setStreamMetadataPtr(in_, stream_metadata_, /*transfer=*/false);
  setFormatVersion(in_);
  setLibraryVersion(in_);
  setDataCompression(in_);
  openvdb::MetaMap().readMeta(in_);
  entries_read();
}

void VdbFile::entries_read() {
  const auto size = static_cast<std::int64_t>(bytes_.size());
  const int grids = readGridCount(in_);
  if (grids < 1 || grids > GRIDS_MAX)
    throw InputError("holds " + std::to_string(grids) + " grids, expected 1 to " + std::to_string(GRIDS_MAX));
  for (int i = 0; i < grids; ++i) {
    Entry entry;
    entry.type = entry.descriptor.read(in_)->type();
    const std::int64_t here = in_.tellg(), begin = entry.descriptor.getGridPos(), end = entry.descriptor.getEndPos();
    if (end > size)
      throw InputError(name_quoted(entry.descriptor) + "ends at byte " + std::to_string(end) +
                       ", but the file has only " + std::to_string(size) + "; it is cut short or damaged");
    if (begin < here || end < begin)
      throw InputError(name_quoted(entry.descriptor) + "lies at impossible offsets; the file is damaged");
    entry.descriptor.seekToEnd(in_);
    entries_.push_back(std::move(entry));
  }
}

std::string VdbFile::name(std::size_t i) const { return name_of(entries_[i].descriptor); }

std::string VdbFile::plain_name(std::size_t i) const { return entries_[i].descriptor.gridName(); }

openvdb::GridBase::Ptr VdbFile::read(std::size_t i, VdbDepth depth) {
  const Entry& entry = entries_[i];
  openvdb::GridBase::Ptr grid = read_own(entry, depth);
  if (!entry.descriptor.isInstance() || depth == VdbDepth::METADATA) return grid;
  // The tree belongs to another grid of the file.
  NamedGridMap trees;
  for (const Entry& parent : entries_)
    if (parent.descriptor.uniqueName() == entry.descriptor.instanceParentName() && !parent.descriptor.isInstance())
      trees[parent.descriptor.uniqueName()] = read_own(parent, depth);
  trees[entry.descriptor.uniqueName()] = grid;
  connectInstance(entry.descriptor, trees);
  return grid;
}

openvdb::GridBase::Ptr VdbFile::read_own(const Entry& entry, VdbDepth depth) {
  const openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(entry.type);
  grid->setSaveFloatAsHalf(entry.descriptor.saveFloatAsHalf());
  entry.descriptor.seekToGrid(in_);
  if (depth == VdbDepth::ALL) {
    readGrid(grid, entry.descriptor, in_);
    if (in_.tellg() != std::istream::pos_type(entry.descriptor.getEndPos()))
      throw InputError("its data end at byte " + std::to_string(in_.tellg()) + " and not at " +
                       std::to_string(entry.descriptor.getEndPos()) + " as the header says; the file is damaged");
    return grid;
  }
  readGridCompression(in_);
  grid->readMeta(in_);
  openvdb::io::setGridClass(in_, grid->getGridClass());
  grid->readTransform(in_);
  if (depth == VdbDepth::TOPOLOGY && !entry.descriptor.isInstance()) grid->readTopology(in_);
  return grid;
}

}  // namespace brume
