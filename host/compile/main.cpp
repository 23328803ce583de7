// brume-kernels: builds a part of a program for brume, which starts it and asks on standard input
// (cl/program_parts.hpp).
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <exception>

#include "base/helper_program.hpp"
#include "base/helper_serve.hpp"
#include "cl/driver_guard.hpp"
#include "cl/program_parts.hpp"

int main() {
  if (!brume::helper_begin("brume-kernels", "build kernels")) return 2;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a compiler does not see that nobody waits for it any more
  brume::driver_start_once();
  bool kept = false;
  try {
    kept = brume::part_serve(STDIN_FILENO);
  } catch (const std::exception&) {  // brume builds it itself, and says what is wrong
  }
  const char done = 1;
  if (kept) (void)brume::helper_send(STDIN_FILENO, &done, sizeof done);
  ::_exit(kept ? 0 : 1);
}
