// See image_protocol.hpp.
#include "image/image_protocol.hpp"

namespace brume {

std::string image_size_problem(int width, int height, int channels) {
  const double bytes = 4.0 * width * height * channels;
  if (width > 0 && height > 0 && channels > 0 && width <= IMAGE_SIDE_MAX && height <= IMAGE_SIDE_MAX &&
      channels <= IMAGE_CHANNELS_MAX && bytes <= static_cast<double>(IMAGE_BYTES_MAX))
    return "";
  const std::string side = std::to_string(IMAGE_SIDE_MAX);
  return std::to_string(width) + " x " + std::to_string(height) + " with " + std::to_string(channels) +
         " channels needs " + std::to_string(static_cast<long long>(bytes / (1 << 20))) + " MB decoded; at most " +
         side + " x " + side + " and " + std::to_string(IMAGE_BYTES_MAX >> 20) + " MB are read";
}

std::string texts_join(const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts) joined += text + '\0';
  return joined;
}

std::vector<std::string> texts_split(const std::string& joined) {
  std::vector<std::string> texts;
  for (std::size_t begin = 0, end; (end = joined.find('\0', begin)) != std::string::npos; begin = end + 1)
    texts.push_back(joined.substr(begin, end - begin));
  return texts;
}

}  // namespace brume
