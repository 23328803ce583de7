// Work done in a forked child whose death does no harm, and the pipe through which its result comes back. Not a general
// process library: the child cannot be talked to.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>

namespace brume {

class ChildPipe {
 public:
  // The child runs work(descriptor to write to) and ends; exceptions that leave `work` end it with exit code 1. Its
  // standard error goes nowhere, it leaves no core file, and it is ended after CHILD_SECONDS. RuntimeError if fork
  // fails.
  explicit ChildPipe(const std::function<void(int)>& work);
  ~ChildPipe();  // ends the child if it still runs
  ChildPipe(const ChildPipe&) = delete;
  ChildPipe& operator=(const ChildPipe&) = delete;

  // False where the child ended before it had sent that much.
  bool read(void* data, std::size_t bytes);
  // Waits for the end of the child; "" if it ended well, else "signal 6" or "exit code 1".
  std::string wait();

 private:
  pid_t child_ = -1;
  int descriptor_ = -1;
};

inline constexpr unsigned CHILD_SECONDS = 120;

// For the child. Throws std::runtime_error if the parent is gone.
void pipe_write(int descriptor, const void* data, std::size_t bytes);

}  // namespace brume
