// Ctrl-C and SIGTERM: the first asks the render loop to stop after the current batch, a second ends the program at once. One that follows
// within INTERRUPT_ECHO_S is the first again: `timeout` and shells signal both the process and its group.
#pragma once

namespace brume {

inline constexpr double INTERRUPT_ECHO_S = 0.5;

void interrupt_install();  // once, from main
bool interrupt_requested();

}  // namespace brume
