// Commands of the shell whose end is waited for.
#pragma once
#include <string>

namespace brume {

// Whether it ended with exit code 0. Throws Interrupted on Ctrl-C, after ending it and all that it started.
bool command_succeeds(const std::string& command);

}  // namespace brume
