// Passes of whole renders.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/interrupt.hpp"
#include "base/number_text.hpp"
#include "base/stopwatch.hpp"
#include "film/film_write.hpp"
#include "flat/flatten.hpp"
#include "measure.hpp"
#include "render/device_scene.hpp"
#include "roofline_parts.hpp"
#include "scene/scene_reader.hpp"
#include "shared/method.h"

namespace brume::bench {

namespace {

// Each run with a renderer of its own: one that has rendered has its light grids already.
struct Renders {
  const FlatScene& flat;
  RenderPlan plan;
  std::vector<RenderStats> stats;
  Film film;
};

Renders renders_of(const RooflineBench& bench, const FlatScene& flat, const RenderPlan& plan) {
  const glm::ivec2 size(plan.frame.camera.width, plan.frame.camera.height);
  Renders renders{flat, plan, {}, Film(size)};
  const auto scene = std::make_shared<DeviceScene>(bench.context, flat);
  for (int i = 0; i < bench.options.repetitions; ++i) {
    Renderer renderer(bench.context, scene, plan, {bench.lanes, false, 0});
    renders.film = Film(size);
    if (!renderer.render(renders.film, [](double) { return !interrupt_requested(); })) interrupt_check();
    renders.stats.push_back(renderer.stats());
  }
  return renders;
}

// Seconds of these passes in each run.
std::vector<double> seconds_of(const Renders& renders, const std::vector<std::string>& passes) {
  std::vector<double> seconds;
  for (const RenderStats& stats : renders.stats) {
    double sum = 0;
    for (const PassStats& pass : stats.passes)
      if (std::find(passes.begin(), passes.end(), pass.name) != passes.end()) sum += pass.seconds;
    seconds.push_back(sum);
  }
  return seconds;
}

// The fog as it absorbs alone. Few lookups do not read all voxels.
void add_lookups(const RooflineBench& bench, const std::string& method, int id) {
  SceneDesc desc = scene_of(bench.fog, {"", id, method_has_step(id) ? 1.0 : 0.0, SHADOW_TRACE});
  desc.media[0].sigma_a += desc.media[0].sigma_s;
  desc.media[0].sigma_s = dvec3(0);
  desc.lights.clear();
  const FlatScene flat = scene_flatten(desc, *bench.fog.loaded, bvh_width_for(bench.lanes));
  const Renders renders = renders_of(bench, flat, plan_render(desc, flat, {}));
  const bool nearest = desc.media[0].interpolation == INTERPOLATION_NEAREST;
  const double lookups = renders.stats[0].lookups, voxels = static_cast<double>(flat.voxels.size());
  bench.add("lookups/" + method, "lookup", lookups, seconds_of(renders, {"traverse_dda"}),
            cost_of_reading(cost_of(nearest ? "lookup, nearest" : "lookup, trilinear"),
                            std::min(lookups * (nearest ? 1 : 8), voxels) * sizeof(float), lookups));
}

void add_light_grid_points(const RooflineBench& bench) {
  const Setting setting{"", METHOD_MARCH_MIDPOINT, 1, SHADOW_GRID, 64};
  const FlatScene& flat = flat_scene(bench.fog, setting, bench.lanes);
  const Renders renders = renders_of(bench, flat, plan_of(bench.fog, setting, flat));
  const LightGrid& grid = renders.plan.light_grids[0];
  const double points = static_cast<double>(grid.nu) * grid.nv * grid.nk;
  const double lookups = std::max(grid.column_step / renders.plan.walks[0].step, 1.0f);
  Cost cost = cost_of("light-grid point");
  const Cost lookup = cost_of("lookup, trilinear");
  cost.flops += lookups * lookup.flops;
  cost.loads += lookups * lookup.loads;
  bench.add("light_grid/points", "point", points, seconds_of(renders, {"light_grid"}),
            cost_of_reading(cost, static_cast<double>(flat.voxels.size()) * sizeof(float), points));
}

// A camera and a lamp within a sphere of triangles, each beside its middle. It is one mirror, or none.
std::string sphere_scene(double reflection, int size) {
  const std::string side = std::to_string(size);
  return R"({"camera": {"eye": [0.3, 0.1, 0.2], "target": [-1, 0, 0.1], "vfov": 90},
    "film": {"size": [)" +
         side + ", " + side + R"(], "spp": 1},
    "lights": [{"type": "point", "position": [-0.2, 0.3, -0.1], "intensity": 1}],
    "materials": {"wall": {"diffuse": 0.5, "reflection": )" +
         number_text(reflection) + R"(}},
    "shapes": [{"type": "mesh", "file": "sphere.obj", "material": "wall"}], "render": {"max_depth": 7}})";
}

struct SphereScene {
  SceneDesc desc;
  LoadedScene loaded;
  FlatScene flat;
};

Renders sphere_renders(const RooflineBench& bench, double reflection, SphereScene& scene) {
  scene.desc = scene_read_text(sphere_scene(reflection, bench.options.size), bench.folder / "sphere.json", {});
  scene.flat = scene_flatten(scene.desc, scene.loaded, bvh_width_for(bench.lanes));
  return renders_of(bench, scene.flat, plan_render(scene.desc, scene.flat, {}));
}

// A ball of 5 800 triangles that fills the picture, or so many on a floor that they fill it from above the first rows
// to where they are smaller than pixels.
constexpr int BALL_RINGS = 54;
std::string balls_scene(const std::string& instances, int size) {
  const std::string side = std::to_string(size), vfov = instances.empty() ? "11" : "45";
  return R"({"camera": {"eye": [0, 5, 9], "target": [0, 0, 0], "vfov": )" + vfov + R"(}, "film": {"size": [)" + side +
         ", " + side + R"(]}, "lights": [{"type": "directional", "direction": [-1, -2, -1]}],
    "shapes": [{"type": "mesh", "file": "ball.obj")" +
         instances + R"(}, {"type": "plane", "point": [0, -1, 0]}]})";
}

void balls_write(int count, const std::filesystem::path& file) {
  std::ofstream out(file);
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    const int column = i % side - side / 2, row = i / side;
    const double x = 2.2 * column, z = -2.2 * row, turn = i;
    out << std::cos(turn) << " 0 " << std::sin(turn) << ' ' << x << " 0 1 0 0 " << -std::sin(turn) << " 0 "
        << std::cos(turn) << ' ' << z << '\n';
  }
}

void add_instances(const RooflineBench& bench, const char* name, int count) {
  std::string instances;
  if (count > 1) {
    balls_write(count, bench.folder / "balls.txt");
    instances = R"(, "instances": "balls.txt")";
  }
  const SceneDesc desc = scene_read_text(balls_scene(instances, bench.options.size), bench.folder / "balls.json", {});
  LoadedScene loaded;
  const FlatScene flat = scene_flatten(desc, loaded, bvh_width_for(bench.lanes));
  const Renders renders = renders_of(bench, flat, plan_render(desc, flat, {}));
  bench.add(name, "ray", renders.stats[0].primary_rays + renders.stats[0].shadow_rays,
            seconds_of(renders, {"primary_rays", "shadow_transmittance"}),
            cost_of_ray("camera ray", flat.triangles.size(), flat.bvh_width));
}

}  // namespace

void roofline_lookups(const RooflineBench& bench) {
#define ROW(id, name, fits, placement, rule, share, jitter, draws, exact, help) \
  if ((fits) & (FITS_NEAREST | FITS_TRILINEAR)) add_lookups(bench, name, METHOD_##id);
  BRUME_METHODS(ROW)
#undef ROW
  add_light_grid_points(bench);
}

void roofline_rays(const RooflineBench& bench) {
  SphereScene wall, mirror;
  const Renders plain = sphere_renders(bench, 0, wall), mirrored = sphere_renders(bench, 0.875, mirror);
  const std::size_t triangles = wall.flat.triangles.size();
  const auto cost = [&](const char* name) { return cost_of_ray(name, triangles, wall.flat.bvh_width); };
  bench.add("rays/primary", "ray", plain.stats[0].primary_rays, seconds_of(plain, {"primary_rays"}),
            cost("camera ray"));
  bench.add("rays/shadow", "ray", plain.stats[0].shadow_rays, seconds_of(plain, {"shadow_transmittance"}),
            cost("shadow ray"));
  // Among them one in eight is a camera ray.
  bench.add("rays/secondary", "ray", mirrored.stats[0].primary_rays + mirrored.stats[0].secondary_rays,
            seconds_of(mirrored, {"primary_rays", "secondary_rays"}), cost("secondary ray"));
  bumpy_sphere_write(BALL_RINGS, bench.folder / "ball.obj");
  add_instances(bench, "rays/one_mesh", 1);
  add_instances(bench, "rays/100000_instances", 100000);
}

void roofline_picture(const RooflineBench& bench) {
  SceneDesc desc;
  desc.film.size = {bench.options.size, bench.options.size};
  desc.background = dvec3(0.25);
  LoadedScene loaded;
  const FlatScene flat = scene_flatten(desc, loaded, bvh_width_for(bench.lanes));
  const Renders renders = renders_of(bench, flat, plan_render(desc, flat, {}));
  const double pixels = renders.stats[0].primary_rays;
  std::vector<double> rest;
  for (const RenderStats& stats : renders.stats) {
    rest.push_back(stats.render_s);
    for (const PassStats& pass : stats.passes) rest.back() -= pass.seconds;
  }
  for (const PassStats& pass : renders.stats[0].passes)
    if (pass.items > 0)
      bench.add("picture/" + pass.name, "pixel", pixels, seconds_of(renders, {pass.name}), cost_of(pass.name));
  bench.add("picture/transfer", "pixel", pixels, rest, cost_of("transfer"));
  std::vector<double> written;
  for (int i = 0; i < bench.options.repetitions; ++i) {
    const Stopwatch watch;
    film_write(renders.film, bench.folder / "picture.png", {});
    written.push_back(watch.seconds());
  }
  bench.add("picture/write", "pixel", pixels, written, cost_of("written pixel"));
}

}  // namespace brume::bench
