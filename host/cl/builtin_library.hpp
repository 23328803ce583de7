// PoCL reads all of its library of built-in functions, 10 MB of bitcode, for the few that a program calls: 0.4 s of
// every process that builds one. Where this program stands in for two functions of LLVM's (builtin_library.cpp), those
// few are read alone; the machine code is the same, byte by byte.
#pragma once
#include <string>

namespace brume {

// Before programs are built: that is done where the platform is of a version that is known to look functions up by
// their names.
void builtin_library_choose(const std::string& platform_version);

}  // namespace brume
