// See check_images.hpp.
#include "check/check_images.hpp"

#include "base/interrupt.hpp"
#include "check/check_parts.hpp"
#include "reference/render.hpp"
#include "render/renderer.hpp"

namespace brume {

Film render_film(Context& context, const PlannedScene& scene, int lanes) {
  Film film({scene.frame.camera.width, scene.frame.camera.height});
  Renderer renderer(context, scene, {lanes, false, 0});
  if (!renderer.render(film, [](double) { return !interrupt_requested(); })) interrupt_check();
  return film;
}

CheckRow film_check(const std::string& name, int lanes, const Film& kernel, const Film& reference) {
  ErrorSum sum(name, lanes, "image");
  for (std::size_t i = 0; i < kernel.pixels().size(); ++i) {
    const FilmPixel &k = kernel.pixels()[i], &r = reference.pixels()[i];
    const float values[][2] = {{k.radiance.x / k.samples, r.radiance.x / r.samples},
                               {k.radiance.y / k.samples, r.radiance.y / r.samples},
                               {k.radiance.z / k.samples, r.radiance.z / r.samples},
                               {k.transmittance.x / k.samples, r.transmittance.x / r.samples},
                               {k.clear / k.samples, r.clear / r.samples}};
    bool agree = true;
    for (const auto& v : values) agree = agree && sum.agrees(v[0], v[1]);
    if (!agree && k.key != r.key) {
      sum.add_edge();
      continue;
    }
    for (const auto& v : values) sum.add(v[0], v[1]);
  }
  CheckRow row = sum.row();
  row.items = kernel.pixels().size();
  return row;
}

std::vector<CheckRow> check_image(Context& context, const std::string& scene, int size, const std::vector<int>& lanes) {
  std::vector<CheckRow> rows;
  Film reference({size, size});
  reference::render(check_scene(scene, size, 4), reference);
  for (const int w : lanes) {
    const Film kernel = render_film(context, check_scene(scene, size, bvh_width_for(w)), w);
    rows.push_back(film_check("image/" + scene, w, kernel, reference));
  }
  return rows;
}

}  // namespace brume
