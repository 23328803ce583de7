// The kinds of files that commands take, by their endings in any case.
#pragma once
#include <filesystem>

namespace brume {

enum class FileKind { SCENE, VOLUME, MESH };

// Throws InputError for a folder, for what is not there, and for another ending, naming those that are known.
FileKind file_kind(const std::filesystem::path& file);

}  // namespace brume
