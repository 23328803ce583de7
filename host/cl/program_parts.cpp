// See program_parts.hpp.
#include "cl/program_parts.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>

#include "base/cores.hpp"
#include "base/error.hpp"
#include "base/hash.hpp"
#include "base/helper_program.hpp"
#include "cl/program.hpp"

namespace brume {

namespace {

constexpr const char* NAME = "passes";       // what #line says of the includes
constexpr std::uint64_t TEXT_MAX = 1 << 20;  // of a request

// What brume-kernels is asked for; the texts follow in this order. It has the files of kernels/ itself, and builds only
// where they give the same source.
struct Request {
  std::uint64_t source_hash;
  std::uint64_t includes, key, options, file;  // bytes
};

std::string part_source(const std::string& includes) { return kernel_source_text(includes, NAME); }

bool both_at_hand(const Context& context, const PartKeys& keys, const std::string& options) {
  return program_at_hand(context, keys.parts[0], options) && program_at_hand(context, keys.parts[1], options);
}

// Whether a core is free: by the load of the last minute, or by what runs now, looked at as often as it takes to pass
// over what runs but shortly, this thread among it.
bool core_is_free() {
  const int cores = cores_usable();
  for (int i = 0; i < 5; ++i, std::this_thread::sleep_for(std::chrono::microseconds(500))) {
    double minute = 0, load = 0;
    int running = 0;
    std::ifstream file("/proc/loadavg");
    if (!(file >> minute >> load >> load >> running)) return false;
    if (minute < cores - 0.5 || running < cores) return cores > 1;
  }
  return false;
}

// brume-kernels at work on the second part; null where it cannot be started.
std::unique_ptr<HelperProgram> part_start(const std::filesystem::path& program, const std::string& includes,
                                          const std::string& key, const std::string& options, const std::string& file) {
  try {
    auto started = std::make_unique<HelperProgram>(program);
    const Request request{hash_bytes(part_source(includes)), includes.size(), key.size(), options.size(), file.size()};
    const std::string texts = includes + key + options + file;
    if (started->send(&request, sizeof request) && started->send(texts.data(), texts.size())) return started;
  } catch (const RuntimeError&) {  // nothing is lost but time
  }
  return nullptr;
}

void part_wait(HelperProgram& program) {
  char kept;
  (void)program.receive(&kept, sizeof kept);  // Ctrl-C is answered meanwhile
}

}  // namespace

PartKeys part_keys(const PartedSource& source) {
  char whole[40];
  std::snprintf(whole, sizeof whole, "%016llx%016llx", static_cast<unsigned long long>(hash_bytes(source.whole)),
                static_cast<unsigned long long>(hash_bytes(source.whole, 1)));
  return {whole, {source.parts[0] + whole, source.parts[1] + whole}};
}

bool parts_at_hand(const Context& context, const PartedSource& source, const std::string& options) {
  const PartKeys keys = part_keys(source);
  return program_at_hand(context, keys.whole, options) || both_at_hand(context, keys, options);
}

std::filesystem::path part_program() {
  if (!core_is_free()) return {};
  try {
    return helper_program_file("brume-kernels", "kernels in two parts");
  } catch (const RuntimeError&) {
    return {};
  }
}

std::vector<cl::Program> parts_build(const Context& context, const PartedSource& source, const std::string& options,
                                     const std::function<std::filesystem::path()>& other) {
  const PartKeys keys = part_keys(source);
  const auto whole = [&] { return program_build(context, keys.whole, options, [&] { return source.whole; }); };
  const auto part = [&](std::size_t i) {
    return program_build(context, keys.parts[i], options, [&] { return part_source(source.parts[i]); });
  };
  if (program_at_hand(context, keys.whole, options)) return {whole()};
  if (both_at_hand(context, keys, options)) return {part(0), part(1)};
  const std::string file = program_kept_file(context, keys.parts[1], options).string();
  const bool possible = !file.empty() && context.device().compute_units > 1;
  const auto started = possible ? part_start(other(), source.parts[1], keys.parts[1], options, file) : nullptr;
  if (!started) return {whole()};
  const cl::Program first = part(0);
  program_used(context, first);  // all of it is compiled by that, while the other is at work
  part_wait(*started);
  return {first, part(1)};
}

bool part_serve(int socket) {
  Request request{};
  if (!helper_receive(socket, &request, sizeof request)) return false;
  std::string includes, key, options, file;
  for (const auto& [text, bytes] : {std::pair{&includes, request.includes}, std::pair{&key, request.key},
                                    std::pair{&options, request.options}, std::pair{&file, request.file}}) {
    if (bytes > TEXT_MAX) return false;
    text->resize(bytes);
    if (!helper_receive(socket, text->data(), bytes)) return false;
  }
  const Context context(device_choose(""));
  if (program_kept_file(context, key, options) != file) return false;  // another device than brume's
  const std::string source = part_source(includes);
  if (hash_bytes(source) != request.source_hash) return false;  // of another version
  program_used(context, program_build(context, key, options, [&] { return source; }));
  return true;
}

}  // namespace brume
