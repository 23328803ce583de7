// The text of an OBJ file made ready for the parser: whatever the parser would drop, guess at or read as 0 is mended or refused.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace brume {

struct ObjText {
  std::string text;
  std::vector<std::size_t> corners;  // of every face with at least three, in their order
};

// Continued lines are joined and comments behind vertices and faces cut off. Throws InputError "file: line N: cause" for a vertex,
// normal or texture coordinate that is not numbers, and for a corner of a face that is not indices, or one out of range.
ObjText obj_text_read(const std::filesystem::path& file);

}  // namespace brume
