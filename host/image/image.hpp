// Image files in and out through OpenImageIO (in host/codec): what is read, what is refused, what is written. No tone
// curve (host/film), no texture lookup, no comparison.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace brume {

using ImageMetadata = std::vector<std::pair<std::string, std::string>>;  // key, value

// values[(y * width + x) * channels + c]; row 0 is the TOP row of the picture, whatever the file's own order.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;
  std::vector<std::string> channel_names;
  bool from_integers = false;  // the file stores integers: display values, not radiance
  std::size_t cleaned =
      0;  // texels with a channel that was NaN, infinite or negative and became 0 (image_read_texture only)
  std::string source;        // the file, for messages
  ImageMetadata metadata{};  // string attributes that brume wrote, "brume:..."; image_read only
};

// The value of that key, or nullptr.
const std::string* metadata_find(const ImageMetadata& metadata, const std::string& key);

// Reading. Formats are told by content (see image_format.hpp), not by extension; of a multi-part file the first part is
// read, of a mip-mapped one the finest level; the Exif orientation is not applied. An OpenEXR file is its display
// window: 0 where nothing is stored, without what is stored beyond it.
//
// The library runs in a program of its own, brume-image (image_program.hpp): some damaged files kill it from within
// (abort, stack overflow). One thread at a time.
//
// Errors: InputError for a file that is missing, of no known format, too large (the message gives size and limit),
// damaged, deep or volumetric, or that crashes the library ("... makes the image library crash (signal 6)").

// Linear RGB for texturing: 3 channels, grey repeated, alpha dropped (and never multiplied in). Samples of 8 and 16
// bits are sRGB-decoded, half and float are linear already; other sample types are InputErrors. All values finite and
// >= 0. Row 0 is the top row: a texture whose v = 0 is the bottom row has to be flipped by the caller.
Image image_read_texture(const std::filesystem::path& file);

// All channels under their names ("R", "depth.Z", ...), as stored: integers scaled to [0,1] without any decoding,
// floats untouched, NaN and infinity included.
Image image_read(const std::filesystem::path& file);

// The exact sRGB curve [IEC 61966-2-1] from [0,1] to linear [0,1].
double srgb_decode(double encoded);

// Index of a channel of that name, or -1.
int image_channel(const Image& image, const std::string& name);

// Writing, always through an AtomicFile: the target is untouched or complete. Errors: InputError for an extension
// without a writer (lists those that exist); RuntimeError naming the folder or the cause where the file cannot be
// written.

// One channel of a picture to write: values[i * stride] is pixel i, row 0 at the top.
struct ImageChannel {
  std::string name;
  const float* values;
  std::size_t stride = 1;
};

// The pixels [x0, x1) x [y0, y1) of a picture; all 0: the whole of it.
struct ImageWindow {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

// 32-bit float OpenEXR, zip compression, string attributes. Channel names with a dot are layers ("normal.X"). Stored
// are the pixels of `window`, OpenEXR's data window, of a picture of that width and height.
void image_write_exr(const std::filesystem::path& file, int width, int height,
                     const std::vector<ImageChannel>& channels, const ImageMetadata& metadata, ImageWindow window = {});

// 8-bit PNG or JPEG (quality 95, no chroma subsampling) from 3 display values in [0,1] per pixel; NaN is written as 0.
// With `alpha` 4 values, the last one alpha, not multiplied into the others: PNG only.
void image_write_display(const std::filesystem::path& file, int width, int height, const std::vector<float>& values,
                         bool alpha = false);

// To be called BEFORE a long rendering: throws what writing to that path would throw for its extension, folder or
// target, and has the image library loaded meanwhile where it is needed.
void image_check_writable(const std::filesystem::path& file);

}  // namespace brume
