// See witnesses.hpp. Random numbers are those of pictures, so that a chart says the same of itself every time.
#include "chart/witnesses.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <thread>

#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "reference/render.hpp"
#include "reference/sampling.hpp"

namespace brume {

namespace {

using reference::rng_bits;
using reference::rng_uniform;

// Of `draws` means of as many witnesses, drawn with repetition: what 2.5 and 97.5 % of them are not above [Efron79].
std::array<double, 2> interval_of(const std::vector<double>& squares, unsigned draws) {
  std::vector<double> means;
  const unsigned count = static_cast<unsigned>(squares.size());
  for (unsigned draw = 0; draw < draws; ++draw) {
    double sum = 0;
    for (unsigned i = 0; i < count; ++i) sum += squares[rng_bits(i, draw, 0, 1) % count];
    means.push_back(sum / count);
  }
  std::sort(means.begin(), means.end());
  return {std::sqrt(means[means.size() / 40]), std::sqrt(means[means.size() - 1 - means.size() / 40])};
}

}  // namespace

std::vector<std::array<int, 2>> witness_places(const std::array<int, 4>& box, int count, unsigned seed) {
  const int width = box[2] - box[0], height = box[3] - box[1];
  const double side = std::max(1.0, std::sqrt(double(width) * height / count));
  const int nx = std::clamp(static_cast<int>(width / side), 1, count), ny = std::min(height, std::max(1, count / nx));
  std::vector<std::array<int, 2>> places;
  for (int ty = 0; ty < ny; ++ty)
    for (int tx = 0; tx < nx; ++tx) {
      const unsigned tile = static_cast<unsigned>(ty * nx + tx);
      const auto place = [&](int from, int extent, int n, int i, unsigned dimension) {
        const int lo = extent * i / n, hi = extent * (i + 1) / n;
        return from + lo + static_cast<int>(rng_uniform(tile, 0, dimension, seed) * (hi - lo));
      };
      places.push_back({place(box[0], width, nx, tx, 0), place(box[1], height, ny, ty, 1)});
    }
  for (std::size_t i = places.size(); i > 1; --i)
    std::swap(places[i - 1], places[rng_bits(unsigned(i), 1, 2, seed) % i]);
  return places;
}

Witnesses witnesses_ask(const PlannedScene& scene, const WitnessOptions& options) {
  const reference::Context context(scene, {options.order, 0});
  const Frame& frame = scene.frame;
  const auto places = witness_places({frame.crop_x0, frame.crop_y0, frame.crop_x1, frame.crop_y1}, options.pixels, 1);
  std::vector<std::optional<std::array<double, 3>>> all(places.size());
  const Stopwatch watch;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < places.size() && !interrupt_requested(); i = next++) {
      if (i >= WITNESSES_LEAST && watch.seconds() > options.seconds) return;
      const reference::PixelD pixel = reference::pixel_render(context, places[i][0], places[i][1]);
      const auto mean = pixel.radiance / std::max(pixel.samples, 1.0);
      all[i] = {mean.x, mean.y, mean.z};
    }
  };
  std::vector<std::thread> helpers;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  interrupt_check();
  Witnesses asked;
  asked.order = options.order;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i]) continue;  // there was no time for it
    asked.places.push_back(places[i]);
    asked.radiance.push_back(*all[i]);
  }
  return asked;
}

void witnesses_compare(const Witnesses& witnesses, const Frame& frame, const Image& picture, ChartExact& exact) {
  std::vector<double> squares;
  exact.max_abs = 0;
  for (std::size_t i = 0; i < witnesses.places.size(); ++i) {
    const auto [x, y] = witnesses.places[i];
    const std::size_t at =
        3 * (std::size_t(y - frame.crop_y0) * std::size_t(picture.width) + std::size_t(x - frame.crop_x0));
    squares.push_back(0);
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::abs(picture.values[at + c] - witnesses.radiance[i][c]);
      squares.back() += error * error / 3;
      exact.max_abs = std::max(exact.max_abs, error);
    }
  }
  double mean = 0;
  for (const float value : picture.values) mean += std::abs(value) / double(picture.values.size());
  const auto relative = [&](double error) { return error > 0 ? error / mean : 0; };
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  exact.witnesses = static_cast<int>(squares.size());
  exact.order = witnesses.order;
  exact.rel_rmse = relative(std::sqrt(sum / double(squares.size())));
  const std::array<double, 2> interval = interval_of(squares, 1000);
  exact.interval = {relative(interval[0]), relative(interval[1])};
}

}  // namespace brume
