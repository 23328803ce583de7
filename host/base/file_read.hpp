// Files that the user names, read whole or looked at: regular files of a bounded size only. A pipe would be waited for,
// a device read without end. Throws InputError "file: cause, and what is allowed", at once.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

namespace brume {

// The whole of a text file: one that holds zero bytes is refused where the first stands. `kind` is what was expected:
// "a scene file".
std::string file_read_text(const std::filesystem::path& file, std::size_t bytes_max, const std::string& kind);

// Its first bytes, `count` of them or all that there are, for readers that open the file by themselves.
std::string file_head(const std::filesystem::path& file, std::size_t count, std::size_t bytes_max,
                      const std::string& kind);

// The ending in lower case, with its dot: ".vdb" of SMOKE.VDB; "" for none.
std::string file_ending(const std::filesystem::path& file);

// The same text for the same file, however the path to it is written; links are not followed.
std::string file_key(const std::filesystem::path& file);

}  // namespace brume
