// The text of every file of kernels/, compiled into the program (cmake/embed_kernels.cmake): brume runs without its
// source folder. Not the loader: includes are resolved in program.hpp.
#pragma once
#include <string_view>
#include <vector>

namespace brume {

struct KernelFile {
  std::string_view path;  // relative to kernels/, e.g. "density/dda.cl"
  std::string_view text;
};

// All of them, in order of path.
const std::vector<KernelFile>& kernel_files();

}  // namespace brume
