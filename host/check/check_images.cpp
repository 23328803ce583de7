// See check_images.hpp.
#include "check/check_images.hpp"

#include <memory>

#include "base/interrupt.hpp"
#include "check/check_parts.hpp"
#include "check/ray_moves.hpp"
#include "check/row_scenes.hpp"
#include "reference/render.hpp"
#include "render/renderer.hpp"
#include "scene/families.hpp"

namespace brume {

Film render_film(Context& context, const PlannedScene& scene, int lanes) {
  Film film({scene.frame.camera.width, scene.frame.camera.height});
  Renderer renderer(context, scene, {lanes, false, 0});
  if (!renderer.render(film, [](double) { return !interrupt_requested(); })) interrupt_check();
  return film;
}

namespace {

std::vector<double> pixel_values(const FilmPixel& p) {
  const double n = p.samples;
  return {p.radiance.x / n, p.radiance.y / n, p.radiance.z / n, p.transmittance.x / n, p.clear / n, p.error / n};
}

std::vector<double> pixel_values(const reference::PixelD& p) {
  return {p.radiance.x / p.samples,      p.radiance.y / p.samples, p.radiance.z / p.samples,
          p.transmittance.x / p.samples, p.clear / p.samples,      p.error / p.samples};
}

using PixelMoved = std::function<std::vector<double>(std::size_t pixel, int move)>;

// Pixels that differ are edges where their keys differ too, or where those of `moved` rays differ as well.
void film_add(ErrorSum& sum, const Film& kernel, const Film& reference, const PixelMoved& moved) {
  for (std::size_t i = 0; i < kernel.pixels().size(); ++i) {
    const FilmPixel &k = kernel.pixels()[i], &r = reference.pixels()[i];
    const std::vector<double> found = pixel_values(k), expected = pixel_values(r);
    if (k.key != r.key && !sum.agree(found, expected)) {
      sum.add_edge();
    } else {
      add_or_edge(sum, found, expected, [&](int move) { return moved ? moved(i, move) : expected; });
    }
  }
  sum.set_items(kernel.pixels().size());
}

}  // namespace

CheckRow film_check(const std::string& name, int lanes, const Film& kernel, const Film& reference) {
  ErrorSum sum(name, lanes, "image");
  film_add(sum, kernel, reference, {});
  return sum.row();
}

namespace {

struct ReferenceScene {
  explicit ReferenceScene(PlannedScene flat) : scene(std::move(flat)), context(scene, {}) {}
  ReferenceScene(const ReferenceScene&) = delete;  // the context refers to the scene

  PlannedScene scene;
  reference::Context context;
};

using SceneMake = std::function<PlannedScene(int size, int bvh_width)>;

Check image_check(const std::string& name, const SceneMake& make) {
  const auto prepare = [make](int size) -> CheckCompare {
    const auto exact = std::make_shared<ReferenceScene>(make(size, 4));
    Film reference({size, size});
    reference::render(exact->scene, reference);
    const PixelMoved moved = [exact, size](std::size_t pixel, int move) {
      const int x = static_cast<int>(pixel) % size, y = static_cast<int>(pixel) / size;
      return pixel_values(reference::pixel_render(exact->context, x, y,
                                                  [move](const reference::RayD& ray) { return ray_moved(ray, move); }));
    };
    return [make, size, reference, moved](Context& device, int lanes, ErrorSum& sum) {
      film_add(sum, render_film(device, make(size, bvh_width_for(lanes)), lanes), reference, moved);
    };
  };
  return {"image/" + name, "image", prepare};
}

PlannedScene shadow_scene(int shadow, int size, int bvh_width) {
  SceneDesc desc = fog_desc(density_kinds().front(), METHOD_AUTO);
  desc.render.shadow = shadow;
  return row_scene(desc, "shadow", size, bvh_width);
}

}  // namespace

std::vector<Check> image_checks() {
  std::vector<Check> checks;
  for (const std::string& name : check_scene_names())
    checks.push_back(image_check(name, [name](int size, int width) { return check_scene(name, size, width); }));
  for (const FamilyRow& row : shadow_family())
    checks.push_back(image_check("shadow_" + std::string(row.name),
                                 [shadow = row.id](int size, int width) { return shadow_scene(shadow, size, width); }));
  return checks;
}

}  // namespace brume
