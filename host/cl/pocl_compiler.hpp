// What PoCL 3.1 does for nothing where it compiles. It reads all of its library of built-in functions, 10 MB of
// bitcode, for the few that a program calls: 0.4 s of every process that builds one. And it has a program optimised
// three times: by the front end, then each kernel by the same list of passes before and after it has made a loop over
// work-items of it. Where this program stands in for functions of LLVM's (pocl_compiler.cpp), the few are read alone,
// the front end makes functions small and inlines them, and kernels are optimised once, with their loop: 0.35 s of 1.3
// less. Numbers stay the same bits, since no pass may change them.
#pragma once

namespace brume {

// Before programs are built: that is done where the version is known to look functions up by their names and to ask for
// passes twice.
void pocl_compiler_choose(bool pocl_3_1);

}  // namespace brume
