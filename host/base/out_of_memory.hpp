// "Out of memory" alone helps nobody: whoever allocates by what a user asked for says of what.
#pragma once
#include <new>
#include <stdexcept>
#include <string>

#include "base/error.hpp"

namespace brume {

// Runs `work`; where it runs out of memory, throws RuntimeError "what: needs more memory than there is".
template <class Work>
auto with_memory(const std::string& what, Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw RuntimeError(what + ": needs more memory than there is");
  } catch (const std::length_error&) {
    throw RuntimeError(what + ": needs more memory than there is");
  }
}

}  // namespace brume
