// See interrupt.hpp. A signal handler may only touch a lock-free flag, read the clock and _exit.
#include "base/interrupt.hpp"

#include <time.h>
#include <unistd.h>

#include <csignal>

namespace brume {

namespace {
volatile std::sig_atomic_t requested = 0;
volatile double first_s = 0;  // seconds of the monotonic clock

double now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

extern "C" void interrupt_handle(int) {
  if (requested && now() - first_s > INTERRUPT_ECHO_S) _exit(130);
  if (!requested) first_s = now();
  requested = 1;
}
}  // namespace

void interrupt_install() {
  std::signal(SIGINT, interrupt_handle);
  std::signal(SIGTERM, interrupt_handle);
}

bool interrupt_requested() { return requested != 0; }

}  // namespace brume
