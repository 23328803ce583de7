// See witnesses.hpp. Random numbers are those of pictures, so that a picture is told the same error every time.
#include "witness/witnesses.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
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

using reference::rng_uniform;

// Standard errors on either side: 1.96 of normal values. The spread of a hundred of which a few are large comes out too
// small: never less than this (tests/kernel/test_witness_coverage.cpp), and Student's where few make up the mean.
constexpr double ERRORS_95 = 2.2;
constexpr double BRIGHT_SHARE = 0.5;                // of the draws go to pixels by the square of their brightness
constexpr double GOLDEN_RATIO = 0.618033988749895;  // multiples of it are spread over [0, 1], however many

// Student's 97.5 % by the first terms of its expansion in 1 / freedom [AbramowitzStegun64, 26.7.5].
double student_95(double freedom) {
  constexpr double NORMAL = 1.96, FIRST = 2.37, SECOND = 2.82;
  constexpr double LEAST = 2.0;  // less would be wider than a logarithm can bear, and held no more pictures
  const double f = std::max(freedom, LEAST);
  return NORMAL + FIRST / f + SECOND / (f * f);
}

// The mean of positive values lies there in 95 of 100 cases: by its logarithm, whose error is nearer to even than that
// of the mean where a few values are large.
std::array<double, 2> interval_of(const std::vector<double>& values, double mean) {
  const double n = static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double error = n > 1 ? std::sqrt(squares / (n * (n - 1))) : mean;
  if (!(mean > 0)) return {0, 0};
  const double moment = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  const double effective = n * n * mean * mean / moment;  // so many equal ones would spread as much
  const double factor = std::exp(std::max(ERRORS_95, student_95(effective - 1)) * error / mean);
  return {mean / factor, mean * factor};
}

// Of values that stand for as many as their weight says.
double percentile_99(std::vector<std::array<double, 2>>& values) {
  std::sort(values.begin(), values.end());
  double all = 0, below = 0;
  for (const auto& value : values) all += value[1];
  for (const auto& value : values)
    if ((below += value[1]) >= 0.99 * all) return value[0];
  return values.back()[0];
}

}  // namespace

WitnessDraws witnesses_draw(const Image& picture, const Frame& frame, int count, unsigned seed) {
  const std::size_t width = static_cast<std::size_t>(picture.width), pixels = width * std::size_t(picture.height);
  const auto draw_at = [&](std::size_t pixel, double weight) {
    return WitnessDraw{frame.crop_x0 + static_cast<int>(pixel % width), frame.crop_y0 + static_cast<int>(pixel / width),
                       weight};
  };
  WitnessDraws draws;
  if (static_cast<std::size_t>(count) >= pixels) {
    for (std::size_t i = 0; i < pixels; ++i) draws.push_back(draw_at(i, 1));
    return draws;
  }
  std::vector<double> below(pixels + 1, 0);  // Σ of squared brightness
  for (std::size_t i = 0; i < pixels; ++i) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) square += double(picture.values[3 * i + c]) * picture.values[3 * i + c];
    below[i + 1] = below[i] + square;
  }
  const double all = below[pixels];
  for (std::size_t i = 0; i <= pixels; ++i)
    below[i] = (1 - BRIGHT_SHARE) * double(i) / double(pixels) + (all > 0 ? BRIGHT_SHARE * below[i] / all : 0);
  const double first = rng_uniform(0, 0, 0, seed), end = below[pixels];
  for (int k = 0; k < count; ++k) {
    const double u = std::fmod(first + k * GOLDEN_RATIO, 1.0) * end;
    const std::size_t after = std::size_t(std::upper_bound(below.begin(), below.end(), u) - below.begin());
    const std::size_t pixel = std::min(after, pixels) - 1;
    draws.push_back(draw_at(pixel, end / (double(pixels) * (below[pixel + 1] - below[pixel]))));
  }
  return draws;
}

Witnesses witnesses_ask(const PlannedScene& scene, const WitnessDraws& draws, const WitnessOptions& options) {
  const reference::Context context(scene, {options.order, 0});
  std::map<std::array<int, 2>, std::size_t> first;  // draw of each pixel: bright ones are drawn several times
  for (std::size_t i = 0; i < draws.size(); ++i) first.emplace(std::array<int, 2>{draws[i].x, draws[i].y}, i);
  const auto first_of = [&](std::size_t i) { return first.at({draws[i].x, draws[i].y}); };
  std::vector<std::optional<std::array<double, 3>>> all(draws.size());
  const Stopwatch watch;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < draws.size() && !interrupt_requested(); i = next++) {
      if (static_cast<int>(i) >= options.least && watch.seconds() > options.seconds) return;
      if (first_of(i) != i) continue;
      const reference::PixelD pixel = reference::pixel_render(context, draws[i].x, draws[i].y);
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
  for (std::size_t i = 0; i < all.size() && all[first_of(i)]; ++i) {  // up to where time ended
    asked.draws.push_back(draws[i]);
    asked.radiance.push_back(*all[first_of(i)]);
  }
  return asked;
}

WitnessError witnesses_compare(const Witnesses& witnesses, const std::vector<std::array<double, 3>>& shown,
                               double mean) {
  WitnessError error;
  error.pixels = static_cast<int>(witnesses.draws.size());
  error.order = witnesses.order;
  if (error.pixels == 0) return error;
  std::vector<double> squares;
  std::vector<std::array<double, 2>> displayed;  // off by how much, for how many values
  for (std::size_t i = 0; i < witnesses.draws.size(); ++i) {
    const double weight = witnesses.draws[i].weight;
    squares.push_back(0);
    for (std::size_t c = 0; c < 3; ++c) {
      const double is = shown[i][c], should = witnesses.radiance[i][c], off = std::abs(is - should);
      squares.back() += weight * off * off / 3;
      error.max_abs = std::max(error.max_abs, off);
      displayed.push_back({std::abs(film_display(float(is), 0) - film_display(float(should), 0)), weight});
    }
  }
  // Of a black picture the light that is missing is the measure.
  double missing = 0;
  for (const auto& exact : witnesses.radiance)
    for (const double value : exact) missing += std::abs(value) / (3.0 * double(squares.size()));
  const double scale = mean > 0 ? mean : missing;
  const auto relative = [&](double square) { return square > 0 && scale > 0 ? std::sqrt(square) / scale : 0; };
  const double square = std::accumulate(squares.begin(), squares.end(), 0.0) / double(squares.size());
  const std::array<double, 2> interval = interval_of(squares, square);
  error.rel_rmse = relative(square);
  error.interval = {relative(interval[0]), relative(interval[1])};
  error.display = percentile_99(displayed);
  return error;
}

WitnessError witnesses_compare(const Witnesses& witnesses, const Frame& frame, const Image& picture) {
  std::vector<std::array<double, 3>> shown;
  for (const WitnessDraw& draw : witnesses.draws) {
    const float* its = &picture.values[3 * (std::size_t(draw.y - frame.crop_y0) * std::size_t(picture.width) +
                                            std::size_t(draw.x - frame.crop_x0))];
    shown.push_back({its[0], its[1], its[2]});
  }
  double mean = 0;
  for (const float value : picture.values) mean += std::abs(value) / double(picture.values.size());
  return witnesses_compare(witnesses, shown, mean);
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
  return chance != 0 || plan.frame.roulette > 0 || plan.frame.light_picks < plan.frame.light_count ||
         plan_lights_extend(plan);
}

}  // namespace brume
