// A program of brume's own that runs beside it and is asked over a socket: libraries that damaged files can crash live in such a one.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace brume {

// Where the program `name` is: beside this one, one folder up, or in ../libexec/brume. RuntimeError, naming them, where it is in none.
std::filesystem::path helper_program_file(const std::string& name, const std::string& what_needs_it);

// The sockets' two ends, for both programs. All bytes, or false where the other side is gone.
bool helper_send(int socket, const void* data, std::size_t bytes);
bool helper_receive(int socket, void* data, std::size_t bytes);

// One running child, for one thread. Its standard input is the socket.
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
  pid_t child_ = -1;
  int socket_ = -1;
};

}  // namespace brume
