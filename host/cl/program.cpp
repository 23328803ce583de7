// See program.hpp.
#include "cl/program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "cl/driver_guard.hpp"
#include "cl/kernel_text.hpp"
#include "cl/program_cache.hpp"

namespace brume {

namespace {

std::string_view kernel_file_text(std::string_view path) {
  for (const KernelFile& file : kernel_files())
    if (file.path == path) return file.text;
  throw RuntimeError("kernel file " + std::string(path) + " is not part of this program");
}

// The path of an `#include "path"` line, empty for any other line.
std::string_view include_path(std::string_view line) {
  constexpr std::string_view word = "#include \"";
  if (line.substr(0, word.size()) != word) return {};
  return line.substr(word.size(), line.rfind('"') - word.size());
}

void source_append(std::string_view text, std::string_view name, std::set<std::string>& seen, std::string& out) {
  out += "#line 1 \"" + std::string(name) + "\"\n";
  std::istringstream lines{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string_view path = include_path(line);
    if (path.empty()) {
      out += line + "\n";
    } else if (seen.insert(std::string(path)).second) {
      source_append(kernel_file_text(path), path, seen, out);
      out += "#line " + std::to_string(number + 1) + " \"" + std::string(name) + "\"\n";
    }
  }
}

// Into a file of its own: other builds fail too, and the temporary folder is everybody's. Says where, or that it could
// not.
std::string source_keep(const std::string& source) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  std::string path = (folder / "brume-failed-kernel-XXXXXX.cl").string();
  const int file = error ? -1 : mkstemps(path.data(), 3);
  if (file < 0) return "the source could not be kept: no temporary folder that can be written";
  close(file);
  std::ofstream out(path, std::ios::binary);
  out << source;
  out.close();
  return (out ? "source kept in " : "the source could not be kept whole in ") + path;
}

cl::Program source_build(const Context& context, const std::string& source, const std::string& options) {
  cl::Program program(context.cl(), source);
  try {
    program.build({context.device().device}, options.c_str());
    return program;
  } catch (const cl::Error& error) {
    interrupt_check();  // a compiler that was interrupted is not one that failed
    const std::string log = program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(context.device().device);
    throw RuntimeError("kernel build failed on " + context.device().title() + ", driver " + context.device().driver +
                       ": " + cl_error_name(error.err()) + "\n" + log + "\noptions: " + options + "\n" +
                       source_keep(source));
  }
}

}  // namespace

std::string kernel_source_text(std::string_view text, std::string_view name) {
  std::set<std::string> seen;
  std::string out;
  source_append(text, name, seen, out);
  return out;
}

std::string kernel_source(std::string_view path) { return kernel_source_text(kernel_file_text(path), path); }

cl::Kernel kernel_create(const cl::Program& program, const char* name) {
  try {
    return cl::Kernel(program, name);
  } catch (const cl::Error& error) {
    driver_failed(std::string("no kernel '") + name + "': " + cl_error_name(error.err()));
  }
}

namespace {

std::string all_options(const std::string& options) { return "-cl-std=CL1.2 -w " + options; }

}  // namespace

std::filesystem::path program_kept_file(const Context& context, const std::string& key, const std::string& options) {
  return program_file(context.device(), key, all_options(options));
}

bool program_at_hand(const Context& context, const std::string& key, const std::string& options) {
  if (context.programs().count({key, options}) > 0) return true;
  const std::filesystem::path file = program_kept_file(context, key, options);
  std::error_code ignored;
  return !file.empty() && std::filesystem::exists(file, ignored);
}

cl::Program program_build(const Context& context, const std::string& key, const std::string& options,
                          const std::function<std::string()>& source) {
  const auto known = context.programs().find({key, options});
  if (known != context.programs().end()) return known->second.program;
  const DriverGuard guard;
  const std::string all = all_options(options);
  const std::filesystem::path file = program_file(context.device(), key, all);
  const std::optional<cl::Program> kept = program_load(context, file, all);
  const Context::Built built =
      kept ? Context::Built{*kept, {}} : Context::Built{source_build(context, source(), all), file};
  context.programs()[{key, options}] = built;
  return built.program;
}

cl::Program program_build(const Context& context, const std::string& source, const std::string& options) {
  return program_build(context, source, options, [&] { return source; });
}

void program_used(const Context& context, const cl::Program& program) {
  for (auto& [text, built] : context.programs())
    if (built.program() == program()) program_keep(context, built.program, std::exchange(built.file, {}));
}

}  // namespace brume
