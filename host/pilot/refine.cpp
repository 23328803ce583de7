// See refine.hpp.
#include "pilot/refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "film/film_display.hpp"
#include "flat/media_methods.hpp"

namespace brume {

namespace {

constexpr int TILE = 8;
constexpr glm::ivec2 PROBES[] = {{1, 2}, {5, 1}, {2, 6}, {6, 5}};  // no two in a row or column
constexpr double ALLOWED = 0.5;  // of the goal: a tile that differs by more is rendered anew
constexpr int LIGHT_GRID_FINEST = 256;
constexpr double STEP_FINEST = 1e-4, TOLERANCE_FINEST = 1e-6;

// How far apart two pixels are in the goal's metric, against what it allows.
double difference(const FilmPixel& a, const FilmPixel& b, const RenderDesc& goal, double mean) {
  const auto one = shown_by(a), other = shown_by(b);
  double squares = 0, largest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double off = goal.error_metric == METRIC_DISPLAY
                           ? film_display(float(one[c]), 0) - film_display(float(other[c]), 0)
                           : one[c] - other[c];
    squares += off * off / 3;
    largest = std::max(largest, std::abs(off));
  }
  return (goal.error_metric == METRIC_REL_RMSE ? std::sqrt(squares) / mean : largest) / *goal.max_error;
}

// Of what was rendered.
double film_mean(const Film& film) {
  double sum = 0, pixels = 0;
  for (const FilmPixel& p : film.pixels()) {
    for (const double value : shown_by(p)) sum += std::abs(value) / 3;
    pixels += p.samples > 0;
  }
  return pixels > 0 && sum > 0 ? sum / pixels : 1;
}

void render_pixels(Renderer& renderer, Film& film, const std::set<std::uint32_t>& pixels, int spp) {
  WorkList work;
  for (const std::uint32_t pixel : pixels) work.push_back({pixel, 0, static_cast<std::uint32_t>(spp)});
  if (!renderer.render(film, work, [](double) { return !interrupt_requested(); }))
    throw Interrupted("interrupted; the picture of before is written");
}

}  // namespace

std::optional<SceneDesc> settings_finer(const SceneDesc& desc) {
  SceneDesc finer = desc;
  if (desc.render.level > 0) {  // the voxels themselves first
    finer.render.level = 0;
    return finer;
  }
  bool changed = false;
  const auto halve = [&](double& step) {
    changed = changed || step > STEP_FINEST;
    step = std::max(step / 2, std::min(step, STEP_FINEST));
  };
  if (method_has_tolerance(desc.render.method)) {
    changed = changed || desc.render.tolerance > TOLERANCE_FINEST;
    finer.render.tolerance = std::max(desc.render.tolerance / 4, std::min(desc.render.tolerance, TOLERANCE_FINEST));
  }
  if (desc.render.method == METHOD_AUTO || method_has_step(desc.render.method)) halve(finer.render.step);
  for (MediumDesc& medium : finer.media)
    if (medium.step) halve(*medium.step);
  if (desc.render.shadow == SHADOW_GRID && desc.render.light_grid < LIGHT_GRID_FINEST) {
    finer.render.light_grid *= 2;
    changed = true;
  }
  if (desc.render.in_scattering == IN_SCATTERING_SEGMENT) {
    finer.render.in_scattering = IN_SCATTERING_GAUSS2;
    changed = true;
  }
  if (!changed) return std::nullopt;
  return finer;
}

std::optional<SceneDesc> settings_closest(const SceneDesc& desc) {
  SceneDesc closest = desc;
  RenderDesc& render = closest.render;
  render.method = METHOD_AUTO;
  render.in_scattering = IN_SCATTERING_GAUSS2;
  render.shadow = SHADOW_TRACE;
  render.level = 0;
  const RenderDesc& is = desc.render;
  const bool same_light = is.in_scattering == render.in_scattering && is.shadow != SHADOW_GRID && is.level == 0;
  const auto methods = [](const SceneDesc& of) {
    std::vector<int> found;
    for (const MediumRow& medium : media_rows(of)) found.push_back(method_resolve(of, *medium.desc));
    return found;
  };
  if (same_light && methods(desc) == methods(closest)) return std::nullopt;
  return closest;
}

double picture_refine(Renderer& finer, const Frame& frame, const RenderDesc& goal, Film& film) {
  const double mean = film_mean(film);
  Film refined(film.size());
  const auto tiles = [&](const auto& visit) {
    for (int y = frame.crop_y0; y < frame.crop_y1; y += TILE)
      for (int x = frame.crop_x0; x < frame.crop_x1; x += TILE) visit(glm::ivec2(x, y));
  };
  const auto pixel_at = [&](glm::ivec2 p) { return static_cast<std::uint32_t>(p.y * film.size().x + p.x); };
  const auto inside = [&](glm::ivec2 p) { return p.x < frame.crop_x1 && p.y < frame.crop_y1; };
  std::set<std::uint32_t> probed, rest;
  tiles([&](glm::ivec2 corner) {
    for (const glm::ivec2 probe : PROBES)
      if (inside(corner + probe)) probed.insert(pixel_at(corner + probe));
  });
  render_pixels(finer, refined, probed, frame.camera.spp);
  tiles([&](glm::ivec2 corner) {
    bool off = !inside(corner + PROBES[0]);  // a sliver at the border, of which nothing is known
    for (const glm::ivec2 probe : PROBES) {
      if (!inside(corner + probe)) continue;
      const std::uint32_t pixel = pixel_at(corner + probe);
      off = off || difference(film.pixels()[pixel], refined.pixels()[pixel], goal, mean) > ALLOWED;
    }
    for (int y = 0; off && y < TILE; ++y)
      for (int x = 0; x < TILE; ++x)
        if (inside(corner + glm::ivec2(x, y))) rest.insert(pixel_at(corner + glm::ivec2(x, y)));
  });
  for (const std::uint32_t pixel : probed) rest.erase(pixel);
  render_pixels(finer, refined, rest, frame.camera.spp);
  for (const auto* pixels : {&probed, &rest})
    for (const std::uint32_t pixel : *pixels) film.pixels()[pixel] = refined.pixels()[pixel];
  const double all = double(frame.crop_x1 - frame.crop_x0) * (frame.crop_y1 - frame.crop_y0);
  return double(probed.size() + rest.size()) / all;
}

}  // namespace brume
