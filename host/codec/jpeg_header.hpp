// The size of a JPEG from its header. The library says it only after it has taken room for all coefficients of a
// progressive one: 25 GB for
// 500 bytes that promise 65500 x 65500.
#pragma once
#include <string>

namespace brume {

struct JpegSize {
  int width = 0, height = 0, channels = 0;
};

// All 0 where there is no frame header: the library says what is wrong with such a file.
JpegSize jpeg_size(const std::string& file);

}  // namespace brume
