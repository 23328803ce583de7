// Both images are first brought to the channels and the scale on which they are compared; everything else is sums in
// double.
#include "film/film_compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "film/film_display.hpp"

namespace brume {

namespace {

std::vector<int> layer_channels(const Image& image, const std::string& layer) {
  std::vector<int> channels;
  for (int c = 0; c < image.channels; ++c)
    if (image.channel_names[std::size_t(c)].rfind(layer + ".", 0) == 0) channels.push_back(c);
  if (!channels.empty()) return channels;
  constexpr std::size_t NAMES_MAX = 24;  // of the 1024 that a file may have
  const std::size_t count = image.channel_names.size(), shown = std::min(count, NAMES_MAX);
  std::string names;
  for (std::size_t i = 0; i < shown; ++i) names += (i == 0 ? "" : ", ") + image.channel_names[i];
  if (shown < count) names += " and " + std::to_string(count - shown) + " more";
  throw InputError(image.source + ": has no layer '" + layer + "'; channels: " + names);
}

std::vector<int> compared_channels(const Image& image, const std::string& layer) {
  if (!layer.empty()) return layer_channels(image, layer);
  const std::vector<int> rgb = {image_channel(image, "R"), image_channel(image, "G"), image_channel(image, "B")};
  if (*std::min_element(rgb.begin(), rgb.end()) >= 0) return rgb;
  return image.channels >= 3 ? std::vector<int>{0, 1, 2} : std::vector<int>{0};
}

Image chosen(const Image& image, const std::string& layer, bool to_display) {
  const std::vector<int> channels = compared_channels(image, layer);
  Image part{image.width, image.height, static_cast<int>(channels.size()), {}, {}, image.from_integers,
             0,           image.source};
  for (int c : channels) part.channel_names.push_back(image.channel_names[std::size_t(c)]);
  const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
  part.values.reserve(pixels * channels.size());
  for (std::size_t i = 0; i < pixels; ++i)
    for (int c : channels) part.values.push_back(image.values[i * std::size_t(image.channels) + std::size_t(c)]);
  if (to_display && !image.from_integers) part.values = film_display(part.values, 0);
  return part;
}

std::string size_text(const Image& image) { return std::to_string(image.width) + " x " + std::to_string(image.height); }

struct Pair {
  Image a, b;
  bool on_display;
};

Pair matched(const Image& a, const Image& b, const std::string& layer) {
  if (a.width != b.width || a.height != b.height)
    throw InputError(a.source + ": is " + size_text(a) + ", but " + b.source + " is " + size_text(b));
  const bool on_display = a.from_integers || b.from_integers;
  Pair pair{chosen(a, layer, on_display), chosen(b, layer, on_display), on_display};
  if (pair.a.channels != pair.b.channels)
    throw InputError(a.source + ": has " + std::to_string(pair.a.channels) + " channels to compare, but " + b.source +
                     " has " + std::to_string(pair.b.channels));
  return pair;
}

// Equal infinities differ by 0, not by NaN.
double difference(float a, float b) { return a == b ? 0 : std::fabs(double(a) - double(b)); }

// Of `errors`, the value that 99 % do not exceed.
double percentile_99(std::vector<float>& errors) {
  if (errors.empty()) return 0;
  const std::size_t rank = (errors.size() * 99 + 99) / 100 - 1;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank), errors.end());
  return errors[rank];
}

void compare_display(CompareResult& result, const Pair& pair) {
  std::vector<float> errors;
  double squares = 0;
  for (std::size_t i = 0; i < pair.a.values.size(); ++i) {
    float a = pair.a.values[i], b = pair.b.values[i];
    if (std::isnan(a) || std::isnan(b)) continue;
    if (!pair.on_display) a = film_display(a, 0), b = film_display(b, 0);
    const double error = difference(a, b);
    squares += error * error;
    errors.push_back(static_cast<float>(error));
  }
  result.display_rmse = errors.empty() ? 0 : std::sqrt(squares / double(errors.size()));
  result.display_p99 = percentile_99(errors);
}

void note_maximum(CompareResult& result, const Image& image, std::size_t value, double error) {
  if (error <= result.max_abs) return;
  const std::size_t pixel = value / std::size_t(image.channels), width = std::size_t(image.width);
  result.max_abs = error;
  result.max_x = static_cast<int>(pixel % width);
  result.max_y = static_cast<int>(pixel / width);
  result.max_channel = image.channel_names[value % std::size_t(image.channels)];
}

void compare_values(CompareResult& result, const Pair& pair) {
  double squares = 0, sum_a = 0, sum_b = 0;
  std::size_t compared = 0, averaged = 0, last_different = std::numeric_limits<std::size_t>::max();
  for (std::size_t i = 0; i < pair.a.values.size(); ++i) {
    const float a = pair.a.values[i], b = pair.b.values[i];
    const bool is_nan = std::isnan(a) || std::isnan(b);
    const double error = difference(a, b);
    if (is_nan || error > 1e-4 * std::fabs(double(std::isinf(b) ? 0 : b)) + 1e-6) {
      const std::size_t pixel = i / std::size_t(result.channels);
      result.different += pixel != last_different;
      last_different = pixel;
    }
    result.nan += is_nan;
    if (is_nan) continue;
    squares += error * error;
    ++compared;
    note_maximum(result, pair.a, i, error);
    if (a == b && std::isinf(a)) continue;
    sum_a += a;
    sum_b += b;
    ++averaged;
  }
  if (compared > 0) result.rmse = std::sqrt(squares / double(compared));
  if (averaged > 0) result.mean_a = sum_a / double(averaged), result.mean_b = sum_b / double(averaged);
  result.rel_rmse = result.rmse > 0 ? result.rmse / std::fabs(result.mean_b) : 0;
}

}  // namespace

CompareResult image_compare(const Image& a, const Image& b, const std::string& layer) {
  const Pair pair = matched(a, b, layer);
  CompareResult result;
  result.width = a.width;
  result.height = a.height;
  result.channels = pair.a.channels;
  result.on_display = pair.on_display;
  result.max_channel = pair.a.channel_names.front();
  compare_values(result, pair);
  compare_display(result, pair);
  return result;
}

Image image_difference(const Image& a, const Image& b, const std::string& layer) {
  const Pair pair = matched(a, b, layer);
  const std::size_t channels = std::size_t(pair.a.channels), pixels = std::size_t(a.width) * std::size_t(a.height);
  std::vector<double> errors(pair.a.values.size());
  double largest = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    errors[i] = difference(pair.a.values[i], pair.b.values[i]);
    if (std::isfinite(errors[i])) largest = std::fmax(largest, errors[i]);
  }
  Image picture{a.width, a.height, 3, {}, {"R", "G", "B"}, true, 0, "difference"};
  picture.values.reserve(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = errors[i * channels + std::min(c, channels - 1)];
      picture.values.push_back(!std::isfinite(error) ? 1.0f : largest > 0 ? static_cast<float>(error / largest) : 0.0f);
    }
  return picture;
}

Image block_means(const Image& image, int n) {
  Image means{(image.width + n - 1) / n,
              (image.height + n - 1) / n,
              image.channels,
              {},
              image.channel_names,
              image.from_integers,
              0,
              image.source};
  means.values.reserve(std::size_t(means.width) * std::size_t(means.height) * std::size_t(means.channels));
  for (int by = 0; by < means.height; ++by)
    for (int bx = 0; bx < means.width; ++bx)
      for (int c = 0; c < image.channels; ++c) {
        const int x1 = std::min((bx + 1) * n, image.width), y1 = std::min((by + 1) * n, image.height);
        double sum = 0;
        for (int y = by * n; y < y1; ++y)
          for (int x = bx * n; x < x1; ++x)
            sum +=
                image
                    .values[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * std::size_t(image.channels) +
                            std::size_t(c)];
        means.values.push_back(static_cast<float>(sum / ((x1 - bx * n) * (y1 - by * n))));
      }
  return means;
}

}  // namespace brume
