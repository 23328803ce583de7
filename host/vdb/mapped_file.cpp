// See mapped_file.hpp. A file that becomes shorter meanwhile ends this program by SIGBUS: brume says it is damaged.
#include "vdb/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.hpp"

namespace brume {

MappedFile::MappedFile(const std::filesystem::path& file) {
  const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat found {};
  const bool there = handle >= 0 && ::fstat(handle, &found) == 0;
  void* bytes = nullptr;
  if (there && found.st_size > 0)
    bytes = ::mmap(nullptr, static_cast<std::size_t>(found.st_size), PROT_READ, MAP_PRIVATE, handle, 0);
  const int failure = errno;
  if (handle >= 0) ::close(handle);
  if (!there || bytes == MAP_FAILED) throw InputError(std::string("cannot be opened: ") + std::strerror(failure));
  if (bytes == nullptr) return;
  bytes_ = static_cast<char*>(bytes);
  size_ = static_cast<std::size_t>(found.st_size);
  setg(bytes_, bytes_, bytes_ + size_);
}

MappedFile::~MappedFile() {
  if (bytes_ != nullptr) ::munmap(bytes_, size_);
}

MappedFile::pos_type MappedFile::seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) {
  const off_type base = from == std::ios_base::beg   ? 0
                        : from == std::ios_base::cur ? gptr() - eback()
                                                     : off_type(size_);
  const off_type place = base + offset;
  if (place < 0 || place > off_type(size_)) return pos_type(off_type(-1));
  setg(bytes_, bytes_ + place, bytes_ + size_);
  return pos_type(place);
}

MappedFile::pos_type MappedFile::seekpos(pos_type place, std::ios_base::openmode which) {
  return seekoff(off_type(place), std::ios_base::beg, which);
}

}  // namespace brume
