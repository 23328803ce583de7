// The kinds of files that commands take, by their endings in any case.
#pragma once
#include <filesystem>
#include <string>

namespace brume {

enum class FileKind { SCENE, VOLUME, MESH };

// "scene (.json), volume (.vdb) or mesh (.obj)": for help texts.
std::string file_kinds_text();

// Throws InputError for a folder, for what is not there, and for another ending, naming those that are known.
FileKind file_kind(const std::filesystem::path& file);

}  // namespace brume
