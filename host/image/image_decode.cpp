// The child's half (open, check, read, send) and the parent's half (receive, check again: a damaged child may send
// anything).
#include "image/image_decode.hpp"

#include <OpenImageIO/imageio.h>

#include <csignal>
#include <memory>

#include "base/error.hpp"
#include "image/child_pipe.hpp"
#include "image/image_format.hpp"

namespace brume {

namespace {

struct Header {
  int width, height, channels;
  Samples samples;
  std::size_t text_bytes;  // channel names, one a line; of an error (width = 0) its message
};
constexpr std::size_t TEXT_BYTES_MAX = 1 << 20;
constexpr int CHANNELS_MAX = 1024;

// "" if fine.
std::string size_problem(int width, int height, int channels) {
  const double bytes = 4.0 * width * height * channels;
  if (width > 0 && height > 0 && channels > 0 && width <= IMAGE_SIDE_MAX && height <= IMAGE_SIDE_MAX &&
      channels <= CHANNELS_MAX && bytes <= static_cast<double>(IMAGE_BYTES_MAX))
    return "";
  const std::string side = std::to_string(IMAGE_SIDE_MAX);
  return std::to_string(width) + " x " + std::to_string(height) + " with " + std::to_string(channels) +
         " channels needs " + std::to_string(static_cast<long long>(bytes / (1 << 20))) + " MB decoded; at most " +
         side + " x " + side + " and " + std::to_string(IMAGE_BYTES_MAX >> 20) + " MB are read";
}

Samples samples_of(const OIIO::TypeDesc& format) {
  if (format == OIIO::TypeDesc::UINT8) return Samples::UINT8;
  if (format == OIIO::TypeDesc::UINT16) return Samples::UINT16;
  return format.is_floating_point() ? Samples::FLOATING : Samples::OTHER_INTEGER;
}

std::unique_ptr<OIIO::ImageInput> open_file(const std::filesystem::path& file, const ImageFormat& format) {
  auto input = OIIO::ImageInput::create(std::string(format.plugin));
  if (!input) throw std::runtime_error("this build of the image library cannot read " + std::string(format.name));
  OIIO::ImageSpec spec, config;
  config["oiio:UnassociatedAlpha"] = 1;  // colours as stored, not multiplied by alpha
  if (!input->open(file.string(), spec, config)) throw std::runtime_error(input->geterror());
  return input;
}

// Runs in the child; its exceptions become the message.
void decode(const std::filesystem::path& file, const ImageFormat& format, int descriptor) {
  const auto input = open_file(file, format);
  const OIIO::ImageSpec spec = input->spec();
  if (spec.deep) throw std::runtime_error("deep images are not read");
  if (spec.depth > 1) throw std::runtime_error("volumetric images are not read");
  const std::string problem = size_problem(spec.width, spec.height, spec.nchannels);
  if (!problem.empty()) throw std::runtime_error(problem);
  std::vector<float> values(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    throw std::runtime_error(input->geterror());
  std::string names;
  for (int c = 0; c < spec.nchannels; ++c) names += std::string(spec.channel_name(c)) + "\n";
  const Header header{spec.width, spec.height, spec.nchannels, samples_of(spec.format), names.size()};
  pipe_write(descriptor, &header, sizeof header);
  pipe_write(descriptor, names.data(), names.size());
  pipe_write(descriptor, values.data(), values.size() * sizeof(float));
}

void decode_or_explain(const std::filesystem::path& file, const ImageFormat& format, int descriptor) {
  std::string message;
  try {
    return decode(file, format, descriptor);
  } catch (const std::bad_alloc&) {
    message = "needs more memory than there is";
  } catch (const std::exception& error) {
    message = error.what();
  }
  if (message.empty()) message = "no reason given by the image library";
  const Header header{0, 0, 0, Samples::FLOATING, std::min(message.size(), TEXT_BYTES_MAX)};
  pipe_write(descriptor, &header, sizeof header);
  pipe_write(descriptor, message.data(), header.text_bytes);
}

// Messages are one line, whatever the library says.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  return lines;
}

[[noreturn]] void fail_dead(const std::string& file, const std::string& how) {
  if (how == "signal " + std::to_string(SIGALRM))
    throw InputError(file + ": is not read within " + std::to_string(CHILD_SECONDS) + " s");
  throw InputError(file + ": the file makes the image library crash (" + (how.empty() ? "no result" : how) + ")");
}

}  // namespace

void image_library_setup() {
  static const bool once = [] {
    // No worker threads in this process: a child forked from it would wait for workers that it does not have.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);  // none beside the caller
    OIIO::attribute("limits:imagesize_MB", static_cast<int>(IMAGE_BYTES_MAX >> 20));
    OIIO::attribute("limits:channels", CHANNELS_MAX);
    return true;
  }();
  static_cast<void>(once);
}

DecodedImage image_decode(const std::filesystem::path& file) {
  const ImageFormat& format = image_format_of_content(file);
  image_library_setup();
  ChildPipe child([&](int descriptor) { decode_or_explain(file, format, descriptor); });
  const std::string name = file.string();
  Header header{};
  if (!child.read(&header, sizeof header) || header.text_bytes > TEXT_BYTES_MAX) fail_dead(name, child.wait());
  std::string text(header.text_bytes, '\0');
  if (!child.read(text.data(), text.size())) fail_dead(name, child.wait());
  if (header.width == 0) throw InputError(name + ": cannot be read: " + one_line(text));

  const std::string problem = size_problem(header.width, header.height, header.channels);
  if (!problem.empty()) throw InputError(name + ": " + problem);
  DecodedImage decoded{{header.width, header.height, header.channels, {}, split_lines(text), false, 0, name},
                       header.samples};
  decoded.image.from_integers = header.samples != Samples::FLOATING;
  std::vector<float>& values = decoded.image.values;
  values.resize(std::size_t(header.width) * std::size_t(header.height) * std::size_t(header.channels));
  if (!child.read(values.data(), values.size() * sizeof(float))) fail_dead(name, child.wait());
  if (const std::string how = child.wait(); !how.empty()) fail_dead(name, how);
  decoded.image.channel_names.resize(std::size_t(header.channels));
  return decoded;
}

}  // namespace brume
