// Ctrl-C and SIGTERM: the first asks the render loop to stop after the current batch, the second ends the program at once.
#pragma once

namespace brume {

void interrupt_install();  // once, from main
bool interrupt_requested();

}  // namespace brume
