// The three standard streams, which a caller may have closed, or which may lead to a pipe without a reader or to a full
// disk.
#pragma once

namespace brume {

// First thing in main: descriptors 0 to 2 that are closed are opened on /dev/null, so that no file of ours is taken for
// one of them; writing to a closed pipe, or beyond the limit of a file's size, fails instead of ending the program.
void streams_open();

// Writes out what stands in stdout's buffer. Throws RuntimeError where any of it could not be written since the
// program began.
void stdout_flush();

}  // namespace brume
