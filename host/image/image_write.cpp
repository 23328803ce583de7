// Images out: EXR with layers, PNG and JPEG. Temporaries end in the target's extension because the library goes by it.
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "image/image.hpp"
#include "image/image_decode.hpp"
#include "image/image_format.hpp"

namespace brume {
namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const ImageFormat& format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
           const void* values) {
  image_library_setup();
  AtomicFile atomic(file, format.extensions.front());
  std::string cause;
  try {
    const auto output = OIIO::ImageOutput::create(std::string(format.plugin));
    if (!output)
      throw RuntimeError(file.string() + ": this build of the image library cannot write " + std::string(format.name));
    // close() flushes: a full disk may show only there.
    if (output->open(atomic.temporary().string(), spec) && output->write_image(type, values) && output->close())
      return atomic.commit();
    cause = output->geterror();
  } catch (const RuntimeError&) {
    throw;
  } catch (const std::exception& error) {
    cause = error.what();
  }
  throw RuntimeError(file.string() +
                     ": cannot be written: " + (cause.empty() ? "no reason given by the image library" : cause));
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
                     const ImageMetadata& metadata) {
  const ImageFormat& format = image_format_of_output(file);
  check_output(file, format, ImageOutput::LINEAR);
  const std::size_t count = channels.size(), pixels = std::size_t(width) * std::size_t(height);
  OIIO::ImageSpec spec(width, height, static_cast<int>(count), OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const ImageChannel& channel : channels) spec.channelnames.push_back(channel.name);
  spec.attribute("compression", "zip");
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
  std::vector<float> values(pixels * count);
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t i = 0; i < pixels; ++i) values[i * count + c] = channels[c].values[i * channels[c].stride];
  write(file, format, spec, OIIO::TypeDesc::FLOAT, values.data());
}

void image_write_display(const fs::path& file, int width, int height, const std::vector<float>& rgb) {
  const ImageFormat& format = image_format_of_output(file);
  check_output(file, format, ImageOutput::DISPLAY);
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:95");  // PNG does not read these two
  spec.attribute("jpeg:subsampling", "4:4:4");
  std::vector<std::uint8_t> codes(rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i) codes[i] = quantise(rgb[i]);
  write(file, format, spec, OIIO::TypeDesc::UINT8, codes.data());
}

void image_check_writable(const fs::path& file) {
  const ImageFormat& format = image_format_of_output(file);
  AtomicFile probe(file, format.extensions.front());
}

}  // namespace brume
