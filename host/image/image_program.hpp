// The running program brume-image, in which the image library lives: its 250 shared libraries take a third of a second
// to load, which goes on beside other work here, and damaged files that crash it do no harm. Private to host/image.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/helper_program.hpp"
#include "image/image_protocol.hpp"

namespace brume {

class ImageProgram {
 public:
  // One for reading, one for writing: what a damaged file may have done to the first never reaches a picture. Not for
  // several threads.
  static ImageProgram& reader();
  static ImageProgram& writer();
  ~ImageProgram();  // lets it end by itself; nobody waits for that

  // Starts it where it does not run yet and returns at once. RuntimeError where it is not found or cannot be started.
  void start();
  // Sends a request (protocol and text_bytes are filled in) and receives the answer's head and texts. False where the
  // program died: stop() says how. The next request starts it anew.
  bool ask(ImageRequest request, const std::vector<std::string>& texts, const void* values, ImageAnswer& answer,
           std::vector<std::string>& said);
  bool receive(void* data, std::size_t bytes) { return helper_receive(child_.socket, data, bytes); }
  // Ends it: "" if it ended well, else "signal 6" or "exit code 1".
  std::string stop();
  // Of what stop() says: somebody else ended it (kill, the system for want of memory), not a file that it read.
  static bool killed(const std::string& how);

 private:
  ImageProgram() = default;
  HelperChild child_;
};

// Beside this program, one folder up, or in ../libexec/brume. RuntimeError, naming them, where it is in none.
std::filesystem::path image_program_file();

}  // namespace brume
