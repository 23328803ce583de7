// See interrupt.hpp. A signal handler may only touch a lock-free flag and _exit.
#include "base/interrupt.hpp"

#include <unistd.h>

#include <csignal>

namespace brume {

namespace {
volatile std::sig_atomic_t interrupt_count = 0;

extern "C" void interrupt_handle(int) {
  interrupt_count = interrupt_count + 1;
  if (interrupt_count > 1) _exit(130);
}
}  // namespace

void interrupt_install() {
  std::signal(SIGINT, interrupt_handle);
  std::signal(SIGTERM, interrupt_handle);
}

bool interrupt_requested() { return interrupt_count > 0; }

}  // namespace brume
