// See witnesses.hpp. Random numbers are those of pictures, so that a picture is told the same error every time.
#include "witness/witnesses.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <thread>

#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "film/film_display.hpp"
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
      if (static_cast<int>(i) >= options.least && watch.seconds() > options.seconds) return;
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

WitnessError witnesses_compare(const Witnesses& witnesses, const Frame& frame, const Image& picture) {
  WitnessError error;
  std::vector<double> squares, displayed;
  for (std::size_t i = 0; i < witnesses.places.size(); ++i) {
    const auto [x, y] = witnesses.places[i];
    const std::size_t at =
        3 * (std::size_t(y - frame.crop_y0) * std::size_t(picture.width) + std::size_t(x - frame.crop_x0));
    squares.push_back(0);
    for (std::size_t c = 0; c < 3; ++c) {
      const double is = picture.values[at + c], should = witnesses.radiance[i][c], off = std::abs(is - should);
      squares.back() += off * off / 3;
      error.max_abs = std::max(error.max_abs, off);
      displayed.push_back(std::abs(film_display(float(is), 0) - film_display(float(should), 0)));
    }
  }
  error.pixels = static_cast<int>(squares.size());
  error.order = witnesses.order;
  if (squares.empty()) return error;
  double mean = 0;
  for (const float value : picture.values) mean += std::abs(value) / double(picture.values.size());
  const auto relative = [&](double off) { return off > 0 ? off / mean : 0; };
  error.rel_rmse = relative(std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / double(squares.size())));
  const std::array<double, 2> interval = interval_of(squares, 1000);
  error.interval = {relative(interval[0]), relative(interval[1])};
  std::sort(displayed.begin(), displayed.end());
  error.display = displayed[(displayed.size() * 99 + 99) / 100 - 1];
  return error;
}

double film_noise(const Film& film, const Frame& frame) {
  double variance = 0, sum = 0;
  for (int y = frame.crop_y0; y < frame.crop_y1; ++y)
    for (int x = frame.crop_x0; x < frame.crop_x1; ++x) {
      const FilmPixel& p = film.pixels()[std::size_t(y) * std::size_t(film.size().x) + std::size_t(x)];
      const double n = p.samples;
      if (!(n >= 1)) continue;
      sum += (std::abs(double(p.radiance.x)) + std::abs(double(p.radiance.y)) + std::abs(double(p.radiance.z))) / n;
      if (n >= 2) variance += (double(p.squares.x) + double(p.squares.y) + double(p.squares.z)) / (n * (n - 1));
    }
  const double values = 3.0 * (frame.crop_x1 - frame.crop_x0) * (frame.crop_y1 - frame.crop_y0);
  return variance > 0 && sum > 0 ? std::sqrt(variance / values) / (sum / values) : 0;
}

bool plan_is_random(const RenderPlan& plan) {
  const unsigned chance = plan.draws & ~(1u << DRAWS_NOTHING);
  return chance != 0 || plan.frame.roulette > 0 || plan.frame.light_picks < plan.frame.light_count;
}

}  // namespace brume
