// See program_cache.hpp. A file is a head and the driver's binary; it appears whole, by renaming.
#include "cl/program_cache.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/foreign_lines.hpp"
#include "base/hash.hpp"
#include "cl/driver_guard.hpp"

extern char** environ;

namespace brume {
namespace fs = std::filesystem;

namespace {

struct Head {
  std::array<char, 16> mark{"brume program 1"};
  std::uint64_t name = 0;  // hash of the file's name: one that was renamed is another program
  std::uint64_t bytes = 0, hash = 0;
};

Head head_of(const fs::path& file, std::string_view binary) {
  Head head;
  head.name = hash_bytes(file.filename().string());
  head.bytes = binary.size();
  head.hash = hash_bytes(binary);
  return head;
}

bool same(const Head& a, const Head& b) {
  return a.mark == b.mark && a.name == b.name && a.bytes == b.bytes && a.hash == b.hash;
}

// Kernels depend on the driver's settings, but not on where it keeps them or which threads run them.
constexpr const char* INDIFFERENT[] = {"POCL_CACHE_DIR=", "POCL_MAX_PTHREAD_COUNT=", "POCL_AFFINITY="};

std::vector<std::string> driver_settings() {
  std::vector<std::string> settings;
  for (char** one = environ; *one != nullptr; ++one) {
    const std::string setting = *one;
    const auto begins = [&](const char* text) { return setting.rfind(text, 0) == 0; };
    if (begins("POCL_") && std::none_of(std::begin(INDIFFERENT), std::end(INDIFFERENT), begins))
      settings.push_back(setting);
  }
  std::sort(settings.begin(), settings.end());
  return settings;
}

void damaged(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
  note_write("the kept program " + file.string() + " was damaged: it is removed, and built again");
}

// The oldest go: those that were not loaded for the longest time.
void folder_limit(const fs::path& folder, std::size_t bytes_max) {
  struct Kept {
    fs::file_time_type used;
    std::size_t bytes;
    fs::path file;
  };
  std::error_code failed;
  std::vector<Kept> all;
  std::size_t bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
    std::error_code gone;  // another process may remove it
    const Kept kept{entry.last_write_time(gone), static_cast<std::size_t>(entry.file_size(gone)), entry.path()};
    if (gone) continue;
    bytes += kept.bytes;
    all.push_back(kept);
  }
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (std::size_t i = 0; i < all.size() && bytes > bytes_max; ++i) {
    fs::remove(all[i].file, failed);
    bytes -= all[i].bytes;
  }
}

}  // namespace

fs::path program_file(const DeviceInfo& device, const std::string& source, const std::string& options) {
  if (device.platform != POCL_PLATFORM || !driver_keeps_generic_kernels()) return {};
  std::string all;
  for (const std::string& part :
       {device.platform, device.platform_version, device.name, device.version, device.driver, options, source})
    all += part + '\0';
  for (const std::string& setting : driver_settings()) all += setting + '\0';
  char name[48];
  std::snprintf(name, sizeof name, "%016llx%016llx.program", static_cast<unsigned long long>(hash_bytes(all)),
                static_cast<unsigned long long>(hash_bytes(all, 1)));
  return fs::path(kernel_cache_folder()) / "brume" / name;
}

std::optional<std::string> program_file_read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  Head head;
  if (bytes.size() >= sizeof head) {
    std::memcpy(&head, bytes.data(), sizeof head);
    bytes.erase(0, sizeof head);
    if (same(head, head_of(file, bytes))) return bytes;
  }
  damaged(file);
  return std::nullopt;
}

void program_file_write(const fs::path& file, std::string_view binary, std::size_t bytes_max) {
  const Head head = head_of(file, binary);
  std::string bytes(sizeof head, '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  bytes += binary;
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  try {
    atomic_write(file, bytes);
    folder_limit(file.parent_path(), bytes_max);
  } catch (const RuntimeError&) {  // nothing is lost but time
  }
}

std::optional<cl::Program> program_load(const Context& context, const fs::path& file, const std::string& options) {
  if (file.empty()) return std::nullopt;
  const std::optional<std::string> binary = program_file_read(file);
  if (!binary) return std::nullopt;
  const cl::Device& device = context.device().device;
  try {
    cl::Program program(context.cl(), {device}, {{binary->begin(), binary->end()}});
    program.build({device}, options.c_str());
    std::error_code ignored;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return program;
  } catch (const cl::Error&) {
    damaged(file);
    return std::nullopt;
  }
}

void program_keep(const Context& context, const cl::Program& program, const fs::path& file) {
  if (file.empty()) return;
  try {
    const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    if (binaries.size() != 1 || binaries[0].empty()) return;
    program_file_write(file, {reinterpret_cast<const char*>(binaries[0].data()), binaries[0].size()});
  } catch (const cl::Error& error) {
    note_write(context.device().title() + " does not hand out a program: " + cl_error_name(error.err()));
  }
}

}  // namespace brume
