// The loop over requests, and what the library makes of each.
#include "codec/codec.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "base/helper_program.hpp"
#include "codec/jpeg_header.hpp"
#include "codec/memory.hpp"
#include "image/image_protocol.hpp"

namespace brume {

namespace {

struct Peer {
  int socket;
  void send(const void* data, std::size_t bytes) const {
    if (!helper_send(socket, data, bytes)) ::_exit(0);  // nobody waits any more
  }
};

Samples samples_of(const OIIO::TypeDesc& format) {
  if (format == OIIO::TypeDesc::UINT8) return Samples::UINT8;
  if (format == OIIO::TypeDesc::UINT16) return Samples::UINT16;
  return format.is_floating_point() ? Samples::FLOATING : Samples::OTHER_INTEGER;
}

std::unique_ptr<OIIO::ImageInput> open_file(const std::string& plugin, const std::string& file) {
  auto input = OIIO::ImageInput::create(plugin);
  if (!input) throw std::runtime_error("this build of the image library cannot read " + plugin);
  OIIO::ImageSpec spec, config;
  config["oiio:UnassociatedAlpha"] = 1;  // colours as stored, not multiplied by alpha
  if (!input->open(file, spec, config)) throw std::runtime_error(input->geterror());
  return input;
}

void check_size(int width, int height, int channels) {
  const std::string problem = image_size_problem(width, height, channels);
  if (!problem.empty()) throw std::runtime_error(problem);
}

struct Pixels {
  int width, height;
  std::vector<float> values;
};

Pixels decode(OIIO::ImageInput& input, const OIIO::ImageSpec& spec) {
  Pixels pixels{spec.width, spec.height, {}};
  pixels.values.resize(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  if (!input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.values.data()))
    throw std::runtime_error(input.geterror());
  return pixels;
}

// The display window of an OpenEXR file is the picture: what is stored beyond it is cut off, what is not stored in it
// is 0. (Other formats place their pixels on a page or a canvas, which is not part of the picture.)
Pixels display_window(Pixels&& stored, const OIIO::ImageSpec& spec) {
  check_size(spec.full_width, spec.full_height, spec.nchannels);
  const std::ptrdiff_t dx = std::ptrdiff_t(spec.x) - spec.full_x, dy = std::ptrdiff_t(spec.y) - spec.full_y;
  if (dx == 0 && dy == 0 && spec.width == spec.full_width && spec.height == spec.full_height) return std::move(stored);
  const std::ptrdiff_t channels = spec.nchannels, width = spec.full_width, height = spec.full_height;
  Pixels window{spec.full_width, spec.full_height, {}};
  window.values.resize(std::size_t(width * height * channels));
  const std::ptrdiff_t x0 = std::max<std::ptrdiff_t>(dx, 0), x1 = std::min(dx + spec.width, width);
  for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(dy, 0); y < std::min(dy + spec.height, height) && x0 < x1; ++y) {
    const auto from = stored.values.begin() + ((y - dy) * spec.width + x0 - dx) * channels;
    std::copy(from, from + (x1 - x0) * channels, window.values.begin() + (y * width + x0) * channels);
  }
  return window;
}

// Few and short, so that no file fills the answer with them.
void add_metadata(std::vector<std::string>& texts, const OIIO::ImageSpec& spec) {
  constexpr int COUNT_MAX = 64;
  int count = 0;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    const std::string key = attribute.name().c_str();
    if (attribute.type() != OIIO::TypeDesc::STRING || key.rfind(METADATA_PREFIX, 0) != 0) continue;
    const std::string value = attribute.get_ustring().c_str();
    if (key.size() + value.size() > METADATA_VALUE_MAX || ++count > COUNT_MAX) continue;
    texts.insert(texts.end(), {key, value});
  }
}

void read(const Peer& peer, const std::vector<std::string>& texts) {
  if (texts.at(0) == "jpeg") {
    const JpegSize size = jpeg_size(texts.at(1));
    if (size.channels > 0) check_size(size.width, size.height, size.channels);
  }
  const auto input = open_file(texts.at(0), texts.at(1));
  const OIIO::ImageSpec spec = input->spec();
  if (spec.deep) throw std::runtime_error("deep images are not read");
  if (spec.depth > 1) throw std::runtime_error("volumetric images are not read");
  check_size(spec.width, spec.height, spec.nchannels);
  Pixels pixels = decode(*input, spec);
  if (texts.at(0) == "openexr") pixels = display_window(std::move(pixels), spec);
  std::vector<std::string> names;
  names.reserve(std::size_t(spec.nchannels));
  for (int c = 0; c < spec.nchannels; ++c) names.push_back(std::string(spec.channel_name(c)));
  add_metadata(names, spec);
  const std::string joined = texts_join(names);
  const std::size_t bytes = pixels.values.size() * sizeof(float);
  const ImageAnswer answer{pixels.width, pixels.height, spec.nchannels, samples_of(spec.format), joined.size(), bytes};
  peer.send(&answer, sizeof answer);
  peer.send(joined.data(), joined.size());
  peer.send(pixels.values.data(), bytes);
}

void write(const Peer& peer, const ImageRequest& request, const std::vector<std::string>& texts,
           const std::vector<char>& values) {
  const OIIO::TypeDesc type = request.samples == Samples::UINT8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
  OIIO::ImageSpec spec(request.width, request.height, request.channels, type);
  spec.x = request.x;
  spec.y = request.y;
  spec.full_width = request.full_width;
  spec.full_height = request.full_height;
  spec.channelnames.clear();
  std::size_t text = 1;
  for (int c = 0; c < request.channels; ++c) spec.channelnames.push_back(texts.at(text++));
  const auto alpha = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
  spec.alpha_channel = alpha == spec.channelnames.end() ? -1 : int(alpha - spec.channelnames.begin());
  for (; text + 1 < texts.size(); text += 2) spec.attribute(texts[text], texts[text + 1]);
  OIIO::Filesystem::IOVecOutput file;
  const auto output = OIIO::ImageOutput::create(texts.at(0));
  if (!output || !output->supports("ioproxy") || !output->set_ioproxy(&file))
    throw std::runtime_error("this build of the image library cannot write " + texts.at(0));
  if (!output->open("memory", spec) || !output->write_image(type, values.data()) || !output->close())
    throw std::runtime_error(output->geterror());
  const std::vector<unsigned char>& bytes = file.buffer();
  const ImageAnswer answer{request.width, request.height, request.channels, request.samples, 0, bytes.size()};
  peer.send(&answer, sizeof answer);
  peer.send(bytes.data(), bytes.size());
}

void refuse(const Peer& peer, std::string message) {
  if (message.empty()) message = "no reason given by the image library";
  const std::string joined = texts_join({message.substr(0, IMAGE_TEXT_MAX - 1)});
  const ImageAnswer answer{0, 0, 0, Samples::FLOATING, joined.size(), 0};
  peer.send(&answer, sizeof answer);
  peer.send(joined.data(), joined.size());
}

void serve(const Peer& peer, const ImageRequest& request, const std::vector<std::string>& texts,
           const std::vector<char>& values) {
  if (request.action == ImageAction::WRITE) return write(peer, request, texts, values);
  memory_limit();
  ::alarm(IMAGE_READ_SECONDS);
  read(peer, texts);
  ::alarm(0);
}

}  // namespace

bool codec_serve(int socket) {
  OIIO::attribute("limits:imagesize_MB", static_cast<int>(IMAGE_BYTES_MAX >> 20));
  OIIO::attribute("limits:channels", IMAGE_CHANNELS_MAX);
  const Peer peer{socket};
  ImageRequest request;
  while (helper_receive(socket, &request, sizeof request)) {
    if (request.protocol != IMAGE_PROTOCOL || request.text_bytes > IMAGE_TEXT_MAX) {
      refuse(peer, "brume-image is of another version than brume");
      return false;
    }
    try {
      std::string joined(request.text_bytes, '\0');
      std::vector<char> values(request.value_bytes);
      if (!helper_receive(socket, joined.data(), joined.size()) ||
          !helper_receive(socket, values.data(), values.size()))
        return false;
      serve(peer, request, texts_split(joined), values);
    } catch (const std::bad_alloc&) {
      refuse(peer, "decoding it needs more memory than the " + std::to_string(IMAGE_WORK_BYTES_MAX >> 20) +
                       " MB that it may take");
    } catch (const std::exception& error) {
      refuse(peer, error.what());
    }
  }
  return true;
}

}  // namespace brume
