// A program of brume's own that runs beside it and is asked over a socket: libraries that damaged files can crash live
// in such a one, and kernels are compiled in one.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace brume {

// Where the program `name` is: beside this one, one folder up, or in ../libexec/brume. RuntimeError, naming them, where
// it is in none.
std::filesystem::path helper_program_file(const std::string& name, const std::string& what_needs_it);

// The sockets' two ends, for both programs. All bytes, or false where the other side is gone.
bool helper_send(int socket, const void* data, std::size_t bytes);
bool helper_receive(int socket, void* data, std::size_t bytes);

// Starts a program whose standard input is a socket, with default signals and in a process group of its own: its id and
// our end of the socket. RuntimeError where that cannot be done.
struct HelperChild {
  pid_t id = -1;
  int socket = -1;
};
HelperChild helper_start(const std::filesystem::path& program);
// Closes the socket, which ends a child that nothing else has ended, and waits: "" if it ended well, else "signal 6" or
// "exit code 1".
std::string helper_end(HelperChild& child);

// One running child, for one thread.
class HelperProgram {
 public:
  // Starts it. RuntimeError where that cannot be done.
  explicit HelperProgram(const std::filesystem::path& program);
  ~HelperProgram();  // kills it, if it has not ended
  HelperProgram(const HelperProgram&) = delete;
  HelperProgram& operator=(const HelperProgram&) = delete;

  // False where the child is gone: end() says how. Ctrl-C is answered while they wait: they throw Interrupted.
  bool send(const void* data, std::size_t bytes);
  bool receive(void* data, std::size_t bytes);
  // Waits for its end: "" if it ended well, else "signal 6" or "exit code 1".
  std::string end();

 private:
  bool wait_for(short events) const;
  HelperChild child_;
};

}  // namespace brume
