// What brume and brume-image (host/codec) say to each other over a socket: one request, one answer, in the machine's
// own byte order; both are built together.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace brume {

inline constexpr int IMAGE_PROTOCOL = 3;  // a program left over from another version says so instead of guessing

enum class Samples { UINT8, UINT16, OTHER_INTEGER, FLOATING };
enum class ImageAction { READ, WRITE };

// Followed by text_bytes of texts and value_bytes of values.
//   READ: texts plugin, file; no values.
//   WRITE: texts plugin, one name per channel, then key, value pairs; values as `samples` says (UINT8 or FLOATING),
//   channels interleaved.
//     x, y and full_*: the part of the whole picture that the values are, which OpenEXR calls data window and display
//     window.
struct ImageRequest {
  int protocol;
  ImageAction action;
  int width, height, channels;
  Samples samples;
  std::size_t text_bytes, value_bytes;
  int x, y, full_width, full_height;
};

// Followed by text_bytes of texts and value_bytes of values. width 0: it failed, the text says why.
//   READ: one text per channel, its name, then key, value of the string attributes whose key begins with
//   METADATA_PREFIX;
//     the values as float, integers scaled to [0, 1].
//   WRITE: no texts; the bytes of the file. Nothing here touches the disk: brume itself writes, and is told what the
//   system says.
struct ImageAnswer {
  int width, height, channels;
  Samples samples;
  std::size_t text_bytes, value_bytes;
};

// Largest image that is read: per side, and decoded to float with all its channels.
inline constexpr int IMAGE_SIDE_MAX = 16384;
inline constexpr std::size_t IMAGE_BYTES_MAX = std::size_t(1) << 30;
inline constexpr std::size_t IMAGE_WORK_BYTES_MAX =
    3 * IMAGE_BYTES_MAX;  // to decode it: pixels, window, what the library keeps
inline constexpr int IMAGE_CHANNELS_MAX = 1024;
inline constexpr std::size_t IMAGE_TEXT_MAX = 1 << 20;
inline constexpr std::string_view METADATA_PREFIX = "brume:";
inline constexpr std::size_t METADATA_VALUE_MAX = 4096;  // longer attributes are not read
inline constexpr unsigned IMAGE_READ_SECONDS = 120;

// Why an image of that size is not read; "" if it is.
std::string image_size_problem(int width, int height, int channels);

// Texts, each ended by a NUL.
std::string texts_join(const std::vector<std::string>& texts);
std::vector<std::string> texts_split(const std::string& joined);

}  // namespace brume
