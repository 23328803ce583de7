// A program in two parts with entry points of their own, built side by side: PoCL compiles in one thread of a process,
// so the second part is built by a program of brume's own, brume-kernels, which keeps it in the file where it is looked
// for. Whatever that one fails at is built here.
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cl/context.hpp"

namespace brume {

struct PartedSource {
  std::string whole;                 // with all entry points, includes resolved
  std::array<std::string, 2> parts;  // the includes of each part's: a text for kernel_source_text()
};

// By which program_build() knows them: the whole by its hash, a part by that and by what it takes of it.
struct PartKeys {
  std::string whole;
  std::array<std::string, 2> parts;
};
PartKeys part_keys(const PartedSource& source);

// Where brume-kernels is; empty where it is not there, or no core is free for it: two parts are more work than a whole.
std::filesystem::path part_program();

// The whole as one program, or its two parts: in parts where they are kept so, and where `other` gives a program to
// build the second one.
std::vector<cl::Program> parts_build(const Context& context, const PartedSource& source, const std::string& options,
                                     const std::function<std::filesystem::path()>& other = part_program);

// Whether that would find all that it needs.
bool parts_at_hand(const Context& context, const PartedSource& source, const std::string& options);

// What brume-kernels does with what it reads from `socket`; false where the part is not kept.
bool part_serve(int socket);

}  // namespace brume
