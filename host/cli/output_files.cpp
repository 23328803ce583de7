// See output_files.hpp.
#include "cli/output_files.hpp"

#include <map>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace brume {

void output_files_check(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  std::map<std::filesystem::path, const NamedFile*> taken;
  for (const NamedFile& input : inputs) taken[file_target(input.file)] = &input;
  for (const NamedFile& output : outputs) {
    if (output.file.empty()) continue;
    const auto [other, is_new] = taken.emplace(file_target(output.file), &output);
    if (!is_new)
      throw InputError(output.option + " " + output.file.string() + ": is the same file as " + other->second->option +
                       " " + other->second->file.string() + ", which it would replace");
  }
}

}  // namespace brume
