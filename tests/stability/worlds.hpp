// What tests of invariance share: scenes from text, their pictures by kernels and reference, and the comparison.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "check/check_images.hpp"
#include "plan/planned_scene.hpp"
#include "reference/render.hpp"
#include "render/renderer.hpp"
#include "scene/scene_reader.hpp"

namespace brume::test {

inline constexpr int LANES = 8;

inline Context& pocl() {
  static Context context(device_choose("portable computing language"));
  return context;
}

inline std::string number_text(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", v);
  return text;
}

inline PlannedScene scene_of(const std::string& text, const std::filesystem::path& folder = "", int size = 24) {
  SceneDesc desc = scene_read_text(text, folder / "world.json", {});
  desc.film.size = {size, size};
  return flatten(desc, {bvh_width_for(LANES), {}});
}

inline Film film_of(const PlannedScene& scene) { return render_film(pocl(), scene, LANES); }

inline Film reference_of(const PlannedScene& scene) {
  Film film({scene.frame.camera.width, scene.frame.camera.height});
  reference::render(scene, film);
  return film;
}

inline void expect_same(const Film& film, const Film& base, double limit, const std::string& what) {
  const CheckRow row = film_check("", LANES, film, base);
  EXPECT_LE(row.max_error, limit) << what;
  EXPECT_LE(row.edges, 2u) << what;
}

// Something is seen: a black or even picture would be the same at any size.
inline void expect_shows(const Film& film, const std::string& what) {
  float lo = INFINITY, hi = 0;
  for (const FilmPixel& p : film.pixels()) {
    lo = std::min(lo, p.radiance.y / p.samples);
    hi = std::max(hi, p.radiance.y / p.samples);
  }
  EXPECT_GT(hi, lo + 0.05f) << what;
}

}  // namespace brume::test
