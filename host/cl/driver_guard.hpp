// Drivers that end the process: PoCL aborts, or dies by SIGBUS or SIGSEGV, where its kernel cache is damaged or its
// disk full, with no call that would say so beforehand. brume then starts once more with a fresh cache beside the
// damaged one, and if that ends the same way, says what to delete and exits with 1.
#pragma once
#include <string>

namespace brume {

// While one lives, a deadly signal is taken for the driver's.
class DriverGuard {
 public:
  DriverGuard();
  ~DriverGuard();
  DriverGuard(const DriverGuard&) = delete;
  DriverGuard& operator=(const DriverGuard&) = delete;
};

// The same for a failure that is no signal, after a guard: starts again, else throws RuntimeError.
[[noreturn]] void driver_failed(const std::string& what);

// Before the first guard, in a program that another one has started: where the driver dies, it dies with it.
void driver_start_once();

// Before the first call of a driver: PoCL would abort over an empty POCL_CACHE_DIR, which is none, and fail where its
// cache cannot be written, which then is kept in the temporary folder, with a note. And unless somebody has set it
// otherwise, PoCL compiles a kernel once, for work-groups and grids of any size: pictures take as long, a grid of
// another size never waits for the compiler, and a program can be handed out without compiling it again. Also unless
// somebody has, each of its threads stays on a core of its own, where all cores of the machine may be used: the k-th on
// the k-th, whatever else runs there, which with fewer threads would put those of two processes on the same cores.
void driver_environment();
bool driver_keeps_generic_kernels();  // whether it does so

// Where PoCL keeps compiled kernels, and what is wrong with that: "" where it can be written.
std::string kernel_cache_folder();
std::string kernel_cache_problem();

}  // namespace brume
