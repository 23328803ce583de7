// A file as a stream over its bytes in memory. OpenVDB looks for a place before every leaf, and a std::filebuf reads
// its 8 KiB again each time: 5 MB of a file of 0.84 MB. Private to host/vdb.
#pragma once
#include <cstddef>
#include <filesystem>
#include <streambuf>

namespace brume {

class MappedFile : public std::streambuf {
 public:
  // Throws InputError where the file cannot be opened.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile() override;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const char* data() const { return bytes_; }
  std::size_t size() const { return size_; }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override;
  pos_type seekpos(pos_type place, std::ios_base::openmode which) override;

 private:
  char* bytes_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace brume
