// Programs as PoCL hands them out when they are built, kept in files within its kernel cache. It finds its own files by
// the preprocessed source, which takes it 0.03 s a start; these are found by the source as it is. Whatever is wrong
// with them, programs are built from their source.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "cl/context.hpp"

namespace brume {

// Where the program would lie: another file for every source, options, device, driver and setting of the driver. Empty
// where programs are not kept: by other drivers than PoCL, which may compile all kernels again to hand them out, and
// where its kernels are specialised, when it does so itself.
std::filesystem::path program_file(const DeviceInfo& device, const std::string& source, const std::string& options);

// Built from its file; none where there is none. One that is damaged is removed, with a note.
std::optional<cl::Program> program_load(const Context& context, const std::filesystem::path& file,
                                        const std::string& options);

// To be called when all kernels of a program have been launched, and with that are compiled. What cannot be written is
// left out; the oldest files go where all are more than PROGRAM_BYTES_MAX.
void program_keep(const Context& context, const cl::Program& program, const std::filesystem::path& file);

// The files themselves: what was written, or nothing.
inline constexpr std::size_t PROGRAM_BYTES_MAX = 64 << 20;  // some 200 programs
std::optional<std::string> program_file_read(const std::filesystem::path& file);
void program_file_write(const std::filesystem::path& file, std::string_view binary,
                        std::size_t bytes_max = PROGRAM_BYTES_MAX);

}  // namespace brume
