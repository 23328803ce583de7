// Markers of ITU T.81, annex B, found as libjpeg finds them.
#include "codec/jpeg_header.hpp"

#include <fstream>

namespace brume {

namespace {

int byte_read(std::istream& in) { return in.get(); }  // -1 at the end
int word_read(std::istream& in) {
  const int high = byte_read(in), low = byte_read(in);
  return low < 0 ? -1 : high * 256 + low;
}

// The code after the next 0xFF that is not filling; -1 at the end.
int marker_next(std::istream& in) {
  int code;
  do {
    do code = byte_read(in);
    while (code >= 0 && code != 0xFF);
    while (code == 0xFF) code = byte_read(in);
  } while (code == 0);
  return code;
}

bool is_frame(int code) { return code >= 0xC0 && code <= 0xCF && code != 0xC4 && code != 0xC8 && code != 0xCC; }
bool is_alone(int code) { return code == 0x01 || (code >= 0xD0 && code <= 0xD8); }

}  // namespace

JpegSize jpeg_size(const std::string& file) {
  constexpr int SCAN = 0xDA, END = 0xD9;
  std::ifstream in(file, std::ios::binary);
  for (int code = marker_next(in); code >= 0 && code != SCAN && code != END; code = marker_next(in)) {
    if (is_alone(code)) continue;
    const int length = word_read(in);
    if (length < 2) return {};
    if (!is_frame(code)) {
      in.seekg(length - 2, std::ios::cur);
      continue;
    }
    byte_read(in);  // precision
    const int height = word_read(in), width = word_read(in), channels = byte_read(in);
    return channels < 0 ? JpegSize{} : JpegSize{width, height, channels};
  }
  return {};
}

}  // namespace brume
