// What the helper programs (helper_program.hpp) that read files have in common, on their side of the socket.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>

namespace brume {

// Called first: without core dumps from here on. False, and a line to stderr, where the program was started by hand:
// its standard input is no socket then. `works`: what brume starts it for, "read volumes".
bool helper_begin(const char* name, const char* works);

// Limits memory to what the program takes by itself, libraries included, and memory_max(bytes of the file), time of the
// processor to ten seconds and one for every MiB. Of a file that cannot be opened nothing: opening it will say why.
void helper_limits(const std::filesystem::path& file, const std::function<std::uint64_t(std::uint64_t)>& memory_max);

}  // namespace brume
