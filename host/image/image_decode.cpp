// Asks brume-image for the values of a file and checks what comes back: a damaged process may send anything.
#include "image/image_decode.hpp"

#include <csignal>

#include "base/error.hpp"
#include "base/text_printable.hpp"
#include "image/image_format.hpp"
#include "image/image_program.hpp"

namespace brume {

namespace {

// What the library says, on one line and without the file's name, which stands before it already.
std::string reason(std::string said, const std::string& absolute) {
  const std::pair<std::string, std::string> changes[] = {
      {" \"" + absolute + "\"", ""}, {" '" + absolute + "'", ""}, {absolute, "the file"}};
  for (const auto& [name, instead] : changes)
    for (std::size_t at; (at = said.find(name)) != std::string::npos;) said.replace(at, name.size(), instead);
  while (!said.empty() && static_cast<unsigned char>(said.back()) <= ' ') said.pop_back();
  return text_printable(said);
}

[[noreturn]] void fail_dead(const std::string& file, const std::string& how) {
  if (how == "signal " + std::to_string(SIGALRM))
    throw InputError(file + ": is not read within " + std::to_string(IMAGE_READ_SECONDS) + " s");
  if (ImageProgram::killed(how)) throw RuntimeError(file + ": cannot be read: brume-image was ended by " + how);
  throw InputError(file + ": the file makes the image library crash (" + (how.empty() ? "no result" : how) + ")");
}

[[noreturn]] void fail(const std::string& message) {
  ImageProgram::reader().stop();  // whatever the file has done in there
  throw InputError(message);
}

// False where the program died.
bool decode(const std::string& name, const std::vector<std::string>& texts, DecodedImage& decoded) {
  ImageProgram& program = ImageProgram::reader();
  ImageAnswer answer{};
  std::vector<std::string> said;
  if (!program.ask({0, ImageAction::READ, 0, 0, 0, Samples::FLOATING, 0, 0, 0, 0, 0, 0}, texts, nullptr, answer, said))
    return false;
  if (answer.width == 0) fail(name + ": cannot be read: " + (said.empty() ? "" : reason(said[0], texts[1])));
  const std::string problem = image_size_problem(answer.width, answer.height, answer.channels);
  if (!problem.empty()) fail(name + ": " + problem);
  decoded = {{answer.width, answer.height, answer.channels, {}, said, false, 0, name}, answer.samples};
  decoded.image.from_integers = answer.samples != Samples::FLOATING;
  decoded.image.channel_names.resize(std::size_t(answer.channels));
  for (std::size_t i = std::size_t(answer.channels); i + 1 < said.size(); i += 2)
    decoded.image.metadata.emplace_back(said[i], said[i + 1]);
  std::vector<float>& values = decoded.image.values;
  values.resize(std::size_t(answer.width) * std::size_t(answer.height) * std::size_t(answer.channels));
  return program.receive(values.data(), values.size() * sizeof(float));
}

}  // namespace

DecodedImage image_decode(const std::filesystem::path& file) {
  const std::vector<std::string> texts = {std::string(image_format_of_content(file).plugin),
                                          std::filesystem::absolute(file).string()};
  DecodedImage decoded{};
  for (int attempt = 0;; ++attempt) {  // a program that was killed from outside is started once more
    if (decode(file.string(), texts, decoded)) return decoded;
    const std::string how = ImageProgram::reader().stop();
    if (attempt > 0 || !ImageProgram::killed(how)) fail_dead(file.string(), how);
  }
}

}  // namespace brume
