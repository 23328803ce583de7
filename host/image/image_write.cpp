// Images out: EXR with layers, PNG and JPEG. They are encoded in memory, but for PNG by brume-image, and written here.
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "image/image.hpp"
#include "image/image_format.hpp"
#include "image/image_program.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

// The bytes of the file. A program that dies is started once more: it may have been killed from outside, and a finished
// picture is not to be lost for that.
std::string encode(const fs::path& file, const ImageRequest& request, const std::vector<std::string>& texts,
                   const void* values) {
  ImageProgram& program = ImageProgram::writer();
  std::string how;
  for (int attempt = 0; attempt < 2; ++attempt) {
    ImageAnswer answer{};
    std::vector<std::string> said;
    if (program.ask(request, texts, values, answer, said)) {
      if (answer.width == 0) throw RuntimeError(file.string() + ": cannot be written: " + said.at(0));
      std::string bytes(answer.value_bytes, '\0');
      if (program.receive(bytes.data(), bytes.size())) return bytes;
    }
    how = program.stop();
  }
  throw RuntimeError(file.string() + ": cannot be written: the image library crashed (" + how + ")");
}

void write(const fs::path& file, const ImageFormat& format, const ImageRequest& request,
           const std::vector<std::string>& channels, const ImageMetadata& attributes, const void* values) {
  std::vector<std::string> texts{std::string(format.plugin)};
  texts.insert(texts.end(), channels.begin(), channels.end());
  for (const auto& [key, value] : attributes) texts.insert(texts.end(), {key, value});
  atomic_write(file, encode(file, request, texts, values));
}

void write_own(const fs::path& file, const ImageFormat& format, int width, int height, int channels,
               const std::vector<std::uint8_t>& codes) {
  std::string bytes;
  try {
    bytes = format.encode(width, height, channels, codes);
  } catch (const std::runtime_error& error) {
    throw RuntimeError(file.string() + ": cannot be written: " + error.what());
  }
  atomic_write(file, bytes);
}

void check_output(const fs::path& file, const ImageFormat& format, ImageOutput wanted) {
  if (format.output != wanted)
    throw InputError(file.string() + ": " + std::string(format.name) + " does not hold " +
                     (wanted == ImageOutput::LINEAR ? "linear values with layers" : "display values"));
}

std::uint8_t quantise(float display) {
  if (!(display > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::lround(std::fmin(display, 1.0f) * 255.0f));
}

}  // namespace

void image_write_exr(const fs::path& file, int width, int height, const std::vector<ImageChannel>& channels,
                     const ImageMetadata& metadata, ImageWindow window) {
  const ImageFormat& format = image_format_of_output(file);
  check_output(file, format, ImageOutput::LINEAR);
  if (window.width() <= 0) window = {0, 0, width, height};
  const std::size_t count = channels.size();
  std::vector<std::string> names;
  names.reserve(count);
  for (const ImageChannel& channel : channels) names.push_back(channel.name);
  ImageMetadata attributes{{"compression", "zip:1"}};
  attributes.insert(attributes.end(), metadata.begin(), metadata.end());
  std::vector<float> values;
  values.reserve(std::size_t(window.width()) * std::size_t(window.height()) * count);
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x)
      for (const ImageChannel& channel : channels)
        values.push_back(channel.values[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * channel.stride]);
  write(file, format,
        {0, ImageAction::WRITE, window.width(), window.height(), static_cast<int>(count), Samples::FLOATING, 0,
         values.size() * sizeof(float), window.x0, window.y0, width, height},
        names, attributes, values.data());
}

void image_write_display(const fs::path& file, int width, int height, const std::vector<float>& values, bool alpha) {
  const ImageFormat& format = image_format_of_output(file);
  check_output(file, format, ImageOutput::DISPLAY);
  std::vector<std::uint8_t> codes(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) codes[i] = quantise(values[i]);
  if (format.encode) return write_own(file, format, width, height, alpha ? 4 : 3, codes);
  const ImageMetadata attributes{{"Compression", "jpeg:95"}, {"jpeg:subsampling", "4:4:4"}};
  const std::vector<std::string> names{"R", "G", "B"};
  write(file, format,
        {0, ImageAction::WRITE, width, height, static_cast<int>(names.size()), Samples::UINT8, 0, codes.size(), 0, 0,
         width, height},
        names, attributes, codes.data());
}

void image_check_writable(const fs::path& file) {
  const ImageFormat& format = image_format_of_output(file);
  AtomicFile probe(file);
  if (!format.encode) ImageProgram::writer().start();
}

}  // namespace brume
