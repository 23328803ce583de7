// Kernel text to program: the embedded files of kernels/ with their includes resolved, built with given options.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cl/context.hpp"

namespace brume {

// The text of kernels/`path` with every quoted include inlined once, #line directives naming the original places.
// Resolved here and not by the driver, so that every OpenCL implementation sees one and the same string.
std::string kernel_source(std::string_view path);
// The same for a text that is not one of the embedded files (tests' kernels); `name` is what #line says.
std::string kernel_source_text(std::string_view text, std::string_view name);

// A kernel of a program that has it: where the driver cannot find it, its cache is damaged (driver_failed).
cl::Kernel kernel_create(const cl::Program& program, const char* name);

// Builds the program, once in a context, or loads it as program_used() kept it. On failure throws RuntimeError with the
// build log and keeps the source in the temporary folder.
cl::Program program_build(const Context& context, const std::string& source, const std::string& options);
// The same of a source that is put together only where it has to be compiled: `key` tells it from all others.
cl::Program program_build(const Context& context, const std::string& key, const std::string& options,
                          const std::function<std::string()>& source);

// Where program_build() looks for it and program_used() keeps it; empty where programs are not kept.
std::filesystem::path program_kept_file(const Context& context, const std::string& key, const std::string& options);

// Whether program_build() would find it: built already, or kept in a file. Drivers that keep programs themselves do not
// tell.
bool program_at_hand(const Context& context, const std::string& key, const std::string& options);

// To be called when all kernels of a program have been launched: keeps it for the next start (program_cache.hpp).
void program_used(const Context& context, const cl::Program& program);

}  // namespace brume
