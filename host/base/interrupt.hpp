// Ctrl-C and SIGTERM. The first is acknowledged at once and answered within a second wherever brume is: loops that can
// stop do so, and where none does (a driver compiles, a file is read), a thread that watches writes what is done and
// ends the program. A second one ends it at once; one within INTERRUPT_ECHO_S is the first again: `timeout` and shells
// signal both the process and its group.
#pragma once
#include <filesystem>
#include <functional>

namespace brume {

inline constexpr double INTERRUPT_ECHO_S = 0.2;
inline constexpr double INTERRUPT_GRACE_S = 0.5;  // after which the program is ended from outside

void interrupt_install();  // once, before anything else: from here on signals are noted
void interrupt_watch();    // once, from main: starts the thread that ends brume where nothing else answers
void interrupt_listen();   // again, where a library may have taken the signals for itself
bool interrupt_requested();
void interrupt_check();  // throws Interrupted where it was requested

// While one lives, `rescue` writes what is done before the program is ended: by the thread that watches, while the one
// that works does not answer. It must not throw.
class InterruptRescue {
 public:
  explicit InterruptRescue(std::function<void()> rescue);
  ~InterruptRescue();
  InterruptRescue(const InterruptRescue&) = delete;
  InterruptRescue& operator=(const InterruptRescue&) = delete;
};

// From here on the caller's thread writes what there is and ends the program; does not return where it is being ended
// already.
void interrupt_claim();

// A folder that is removed where the program is ended from outside.
void interrupt_removes(const std::filesystem::path& folder);

// Claims, the last line and exit code 130.
[[noreturn]] void interrupt_leave(const char* message);

}  // namespace brume
