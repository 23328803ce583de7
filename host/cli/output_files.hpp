// The files that one run writes and reads: no two of them may be one file.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace brume {

struct NamedFile {
  std::string option;  // as in a message: "--stats"
  std::filesystem::path file;
};

// Throws InputError where an output is another output, or an input, however the two are spelled. Empty paths are none.
void output_files_check(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

}  // namespace brume
