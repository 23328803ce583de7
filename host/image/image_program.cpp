// What is asked of the running program, and when it is started and ended.
#include "image/image_program.hpp"

#include <unistd.h>

#include <csignal>

namespace brume {
namespace fs = std::filesystem;

fs::path image_program_file() { return helper_program_file("brume-image", "images"); }

ImageProgram& ImageProgram::reader() {
  static ImageProgram program;
  return program;
}

ImageProgram& ImageProgram::writer() {
  static ImageProgram program;
  return program;
}

ImageProgram::~ImageProgram() {
  if (child_.socket >= 0) ::close(child_.socket);
}

void ImageProgram::start() {
  if (child_.id <= 0) child_ = helper_start(image_program_file());
}

bool ImageProgram::ask(ImageRequest request, const std::vector<std::string>& texts, const void* values,
                       ImageAnswer& answer, std::vector<std::string>& said) {
  start();
  const std::string joined = texts_join(texts);
  request.protocol = IMAGE_PROTOCOL;
  request.text_bytes = joined.size();
  if (!helper_send(child_.socket, &request, sizeof request) ||
      !helper_send(child_.socket, joined.data(), joined.size()) ||
      !helper_send(child_.socket, values, request.value_bytes) || !receive(&answer, sizeof answer) ||
      answer.text_bytes > IMAGE_TEXT_MAX)
    return false;
  std::string answered(answer.text_bytes, '\0');
  if (!receive(answered.data(), answered.size())) return false;
  said = texts_split(answered);
  return true;
}

std::string ImageProgram::stop() { return helper_end(child_); }

bool ImageProgram::killed(const std::string& how) {
  for (int signal : {SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT})
    if (how == "signal " + std::to_string(signal)) return true;
  return false;
}

}  // namespace brume
