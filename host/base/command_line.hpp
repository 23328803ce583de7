// Commands of the shell whose end is waited for.
#pragma once
#include <string>

namespace brume {

// The text as one word of the shell's.
std::string shell_quoted(const std::string& text);

// Whether it ended with exit code 0. Throws Interrupted on Ctrl-C, after ending it and all that it started.
bool command_succeeds(const std::string& command);

}  // namespace brume
