// How far two images are apart: relative error and its like, the difference as a picture, means over blocks. No command
// line.
#pragma once
#include <cstddef>
#include <string>

#include "image/image.hpp"

namespace brume {

// B is the reference. Compared are the channels R, G, B (of images without them the first three, or the only one), or
// all channels of a named layer ("normal": normal.X, normal.Y, normal.Z). On linear radiance where both images store
// floats; where one stores integers, both on display values (the float one through the display curve at exposure 0).
// NaN in either image: left out of every sum, counted, and its pixel is different. Infinities of one sign in both:
// equal, left out of the means (the depth of two misses). One infinity: an infinite error.
struct CompareResult {
  int width = 0, height = 0, channels = 0;
  bool on_display = false;        // compared as display values: at least one file stores integers
  double rmse = 0, rel_rmse = 0;  // rel_rmse = rmse / |mean_b|; infinite where only mean_b is 0
  double max_abs = 0;
  int max_x = 0, max_y = 0;  // where, row 0 at the top
  std::string max_channel;
  double display_p99 = 0, display_rmse = 0;  // of the absolute error of display values
  double mean_a = 0, mean_b = 0;             // over pixels and channels
  std::size_t different = 0;                 // pixels with a channel where |a-b| > 1e-4 |b| + 1e-6
  std::size_t nan = 0;                       // values that are NaN in A or B
};

// InputError where the sizes, the numbers of channels or the layers do not match.
CompareResult image_compare(const Image& a, const Image& b, const std::string& layer = "");

// |a-b| as display-ready RGB, scaled so that the largest finite difference is 1; NaN and infinite differences are 1
// too. Same channels and errors as image_compare. Write it with image_write_display.
Image image_difference(const Image& a, const Image& b, const std::string& layer = "");

// Means over blocks of n x n pixels, all channels; blocks at the right and lower border are means of what they hold.
Image block_means(const Image& image, int n);

}  // namespace brume
