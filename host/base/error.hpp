// The three ways brume fails. What main() prints is what().
#pragma once
#include <stdexcept>
#include <string>

namespace brume {

// Bad input or usage: exit 2. The message is one line "file: place: cause, and what is allowed".
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Device, memory or I/O failure: exit 1.
struct RuntimeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Ctrl-C: exit 130, thrown after what is done has been written.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace brume
