// Media that break methods: thin, thick, sharp, hot, scaled, shifted, refined, larger than memory.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "check/check_images.hpp"
#include "plan/planned_scene.hpp"
#include "reference/medium.hpp"
#include "render/renderer.hpp"
#include "scene/families.hpp"
#include "scene/scene_reader.hpp"
#include "stability/stability_parts.hpp"

namespace brume {

namespace {

bool has_grid(int method) { return method != METHOD_HOMOGENEOUS && for_densities(method); }
bool has_step(int method) { return method_has_step(method); }

StabilityRays some_rays(int count, double half = 0.8) {
  StabilityRays rays;
  CheckRandom random;
  for (int i = 0; i < count; ++i) rays.through(random.in_box(half), random.direction());
  return rays;
}

// A slab of 1e-6, and none at all, which is refused.
void thin_box(StabilityRun& run) {
  StabilityRays rays;
  for (int i = 0; i < 9; ++i) rays.through({0.2 * i - 0.8, 0.1, 0}, {0.05 * i - 0.2, 0.1, -1});
  rays.through({0, 0, 0}, {1, 0, 0});
  run.compare(run.cube("", R"("bounds": [[-1, -1, -0.0000005], [1, 1, 0.0000005]])"), rays, 1e-6, true);
  try {
    run.cube("", R"("bounds": [[-1, -1, 0], [1, 1, 0]])");
    run.expect(false, "a box of zero thickness was accepted");
  } catch (const InputError&) {
  }
}

void step_huge(StabilityRun& run) { run.compare(run.cube("", "", R"("step": 10)"), some_rays(50), 1e-6, true); }

// Two hundred thousand steps a ray; sums of so many floats lose digits.
void step_tiny(StabilityRun& run) {
  StabilityRays rays;
  rays.through({0.1, 0.2, 0.3}, {0.3, 0.2, 1});
  PlannedScene scene = run.cube("", "", R"("step": 1e-5)");
  scene.lights.clear();
  scene.frame.light_count = scene.frame.light_picks = 0;
  run.compare(scene, rays, 2e-3, true);
}

// τ from 1e-6 to 1e6 of a medium that glows as much as it absorbs: what it sends is 1 - T, whatever its density. The
// segment rule stays within [0, 1]; the rectangle rule is seen to over- and undershoot.
void depth_range(StabilityRun& run, const char* rule, bool bounded) {
  PlannedScene scene =
      run.cube(run.method() == METHOD_HOMOGENEOUS ? "" : R"({"type": "linear", "resolution": [8, 8, 8]})", "",
               std::string(R"("in_scattering": ")") + rule + "\"");
  scene.lights.clear();
  scene.frame.light_count = scene.frame.light_picks = 0;
  scene.frame.background = {0, 0, 0};
  MediumBody& medium = scene.media[0];
  medium.sigma_s = {0, 0, 0};
  const StabilityRays rays = some_rays(60);
  double over = 0, under = INFINITY, worst = 0;
  for (double digits = -6; digits <= 6; ++digits) {
    const auto sigma = static_cast<float>(std::pow(10.0, digits));
    medium.sigma_a = medium.emission = {sigma, sigma, sigma};
    scene.walks[0].track_sigma = sigma;
    double mean = 0, exact = 0;
    const auto sent = run.shoot(scene, rays);
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const double depth =
          reference::optical_depth(scene, 0, rays.rays[i], INFINITY, reference::method_exact(scene.medium(0)));
      const double expected = -std::expm1(-sigma * depth);
      mean += sent[i].radiance.x;
      exact += expected;
      if (run.tracks()) continue;
      over = std::max(over, sent[i].radiance.x / expected);
      under = std::min(under, sent[i].radiance.x / expected);
      worst = std::max(worst, sent[i].radiance.x);
    }
    if (!run.tracks()) continue;
    over = std::max(over, mean / exact);
    under = std::min(under, mean / exact);
  }
  if (bounded && !run.tracks()) {
    run.expect(worst <= 1 + 1e-6, "leaves [0, 1]: " + number(worst));
    run.expect(!run.exact() || (over <= 1 + 1e-5 && under >= 1 - 1e-5), "not exact");
  }
  run.record((run.tracks() ? "mean of 60 rays " : "") + number(under) + " to " + number(over) + " of what is right");
}

void depth_segment(StabilityRun& run) { depth_range(run, "segment", true); }
void depth_rectangle(StabilityRun& run) { depth_range(run, "rectangle", false); }

void phase_limits(StabilityRun& run) {
  for (const char* g : {"0.9", "-0.9", "0.99", "-0.99", "0.9999", "-0.9999", "0.999999", "-0.999999"}) {
    StabilityRays rays = some_rays(20);
    rays.through({0, 0, 0}, {-0.3, -0.4, -1});  // straight along the light
    rays.through({0, 0, 0}, {0.3, 0.4, 1});
    run.shoot(run.cube("", std::string(R"("phase": {"type": "henyey_greenstein", "g": )") + g + "}"), rays);
  }
}

// One voxel of 1e4 in a field of about 1.
void hot_voxel(StabilityRun& run) {
  PlannedScene scene = run.cube(R"({"type": "perlin", "resolution": [16, 16, 16], "scale": 2, "seed": 3})");
  const std::size_t sample = (4 * BRICK_SAMPLES + 4) * BRICK_SAMPLES + 4;  // in the first brick, shared with none
  scene.voxels[sample] = 1e4f;
  scene.brick_ranges[1] = 1e4f;
  StabilityRays rays = some_rays(20);
  for (const dvec3& dir : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(1, 1, 1)})
    rays.through({-0.43, -0.44, -0.45}, dir);
  run.compare(scene, rays, 2e-3, false);
}

// 2048 x 1024 x 1024 cells, of which one brick is stored: offsets beyond 2^31.
void huge_grid(StabilityRun& run) {
  PlannedScene scene = run.cube();
  scene.grids[0] = {0, 2048, 1024, 1024, 256, 128, 128};
  PlacedGrid& m = scene.placed[0];
  m.lo = {0, 0, 0};
  m.hi = {2048, 1024, 1024};
  const Affine cells{{1024, 0, 0, 1024, 0, 512, 0, 512, 0, 0, 512, 512}};
  const Affine world{{1.0f / 1024, 0, 0, -1, 0, 1.0f / 512, 0, -1, 0, 0, 1.0f / 512, -1}};
  m.cell_from_world = cells;
  m.world_from_cell = world;
  scene.walks[0].step = 1e-3f;
  // 32 x 16 x 16 blocks of bricks share the entries of an empty one, but for the last.
  const int blocks = 32 * 16 * 16;
  scene.bricks.assign(blocks, blocks);
  scene.bricks.back() += BRICK_BLOCK_ENTRIES;
  scene.bricks.resize(blocks + 2 * BRICK_BLOCK_ENTRIES, BRICK_EMPTY);
  scene.bricks.back() = 0;
  scene.brick_ranges = {0.0f, 100.0f};
  scene.voxels.assign(BRICK_VALUES, 100.0f);
  StabilityRays rays;
  rays.through({0.998, 0.993, 0.995}, {1, 0, 0});
  rays.through({0.996, 0.993, 0.992}, {0.3, 0.2, 1});
  rays.through({0.995, 0.992, 0.996}, {-1, -1, -1});
  rays.through({0, 0, 0}, {1, 0.3, 0.2});
  run.compare(scene, rays, 1e-4, false);
}

// The same small world: scaled with its coefficients, moved, seen from a distance, in other units of density.
struct World {
  double scale = 1;
  dvec3 shift{0};
  double distance = 0;  // of an orthographic camera; 0: a perspective one
  double density = 1;   // else: of an even medium, whose coefficients are divided by it
};

Film world_film(const StabilityRun& run, const World& world) {
  SceneDesc desc = scene_read_text(
      R"({"film": {"size": [24, 24]}, "background": [0.1, 0.2, 0.3],
      "camera": {"eye": [1.5, 1.5, 3.5]},
      "lights": [{"type": "directional", "direction": [-0.3, -0.4, -1], "irradiance": [3, 2, 1]}],
      "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}},
      "shapes": [{"type": "sphere", "center": [0.1, 0, 0.2], "radius": 0.4, "material": "grey"}],
      "media": [{"bounds": [[-1, -1, -1], [1, 1, 1]], "density": {"type": "constant", "resolution": [8, 8, 8]}, "sigma_a": 0.3, "sigma_s": 0.9}]})",
      "world.json", {});
  desc.render.method = run.method();
  MediumDesc& m = desc.media[0];
  if (run.method() != METHOD_HOMOGENEOUS) m.density.type = "linear";
  if (method_fits(run.method()) == FITS_NEAREST) m.interpolation = INTERPOLATION_NEAREST;
  if (is_for_liquids(run.method())) {
    m.type = MEDIUM_LIQUID;
    m.sigma_s = dvec3(0);
    m.density.presence = PRESENCE_REFUSE;
  }
  const auto place = [&](const dvec3& p) { return world.scale * p + world.shift; };
  if (world.distance > 0) {
    desc.camera.type = CAMERA_ORTHOGRAPHIC;
    desc.camera.eye = world.distance * dvec3(0, 0.6, 0.8);
  }
  desc.camera.eye = place(desc.camera.eye);
  desc.camera.target = place(desc.camera.target);
  SphereDesc& ball = std::get<SphereDesc>(desc.shapes[0].geometry);
  ball.center = place(ball.center);
  ball.radius *= world.scale;
  for (dvec3& corner : *m.bounds) corner = place(corner);
  if (world.density != 1) {
    m.density.type = "constant";
    m.density.value = world.density;
  }
  m.sigma_a /= world.scale * world.density;
  m.sigma_s /= world.scale * world.density;
  return render_film(run.context(), flatten(desc, {bvh_width_for(run.lanes()), {}}), run.lanes());
}

// Largest difference of two pictures where both see the same surface: relative, with a floor of 1e-2.
double film_difference(const Film& a, const Film& b, std::size_t* edges) {
  double worst = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const FilmPixel &p = a.pixels()[i], &q = b.pixels()[i];
    const float pairs[][2] = {{p.radiance.x, q.radiance.x}, {p.radiance.y, q.radiance.y}, {p.radiance.z, q.radiance.z}};
    double difference = 0;
    for (const auto& v : pairs) difference = std::max(difference, std::abs(double(v[0]) - v[1]) / (v[1] + 1e-2));
    if (difference > 1e-4 && p.key != q.key) {
      ++*edges;
    } else {
      worst = std::max(worst, difference);
    }
  }
  return worst;
}

// Each world against the first.
void world_compare(StabilityRun& run, const std::vector<World>& worlds, double limit) {
  const Film base = world_film(run, worlds[0]);
  double worst = 0;
  std::size_t edges = 0;
  for (const World& world : worlds) worst = std::max(worst, film_difference(world_film(run, world), base, &edges));
  run.expect(worst <= limit && edges <= 2 * worlds.size(), "more than " + number(limit));
  run.record("picture off by " + number(worst) + ", " + std::to_string(edges) + " edge pixels");
}

void scaled(StabilityRun& run) { world_compare(run, {{}, {1e-25}, {1e-4}, {0.37}, {1e4}, {1e25}}, 1e-4); }

void dense_units(StabilityRun& run) {
  const dvec3 none(0);
  world_compare(run, {{1, none, 0, 2}, {1, none, 0, 1e-37}, {1, none, 0, 1e-10}, {1, none, 0, 1e37}}, 1e-4);
}

void far_camera(StabilityRun& run) {
  const dvec3 none(0);
  world_compare(run, {{1, none, 4}, {1, none, 5e4}, {1, none, 5e7}, {1, none, 1e12}}, 1e-4);
}

// By a multiple of a power of two the scene's own origin takes it up without loss; else by what float rounds.
void shifted(StabilityRun& run) {
  world_compare(run, {{}, {1, {1e5, -1e5, 1e5}}, {1, {65536, 0, 0}}, {1e2, {1e5, 1e5, 0}}}, 1e-4);
}

// The same ramp at twice the resolution: along rays that stay away from its rim by half a coarse voxel.
void refined(StabilityRun& run) {
  StabilityRays rays;
  CheckRandom random;
  for (int i = 0; i < 50; ++i) {
    const dvec3 a = random.in_box(0.85), b = random.in_box(0.85);
    rays.add(a, glm::normalize(b - a), 0.99 * glm::length(b - a));
  }
  const auto coarse = run.shoot(run.cube(R"({"type": "linear", "resolution": [8, 8, 8]})"), rays);
  const auto fine = run.shoot(run.cube(R"({"type": "linear", "resolution": [16, 16, 16]})"), rays);
  double worst = 0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i)
    worst = std::max(worst, std::abs(coarse[i].transmittance.x - fine[i].transmittance.x));
  run.expect(worst <= 2e-6 || run.tracks() || run.method() == METHOD_DDA_NEAREST, "more than 2e-6");
  run.record("transmittance changes by " + number(worst));
}

}  // namespace

const std::vector<StabilityEntry> STABILITY_MEDIA = {
    {"thin_box", "a box 1e-6 thick; one of zero thickness is refused", thin_box, all_methods},
    {"step_huge", "a step ten times the box", step_huge, has_step},
    {"step_tiny", "a step of 1e-5 of the box, the shortest", step_tiny, has_step},
    {"depth_segment", "tau from 1e-6 to 1e6, segment rule: never more than the source", depth_segment, for_densities},
    {"depth_rectangle", "tau from 1e-6 to 1e6, rectangle rule: over- and undershoots", depth_rectangle, for_densities},
    {"phase_limits", "g up to +-0.999999", phase_limits, for_densities},
    {"hot_voxel", "one voxel of 1e4 among voxels of about 1", hot_voxel, has_grid},
    {"huge_grid", "2^31 cells, one brick stored", huge_grid, has_grid},
    {"scaled", "the world scaled by 1e-25 to 1e25: the same picture", scaled, all_methods},
    {"dense_units", "densities of 1e-37 to 1e37 with coefficients by as much smaller: the same picture", dense_units,
     for_densities},
    {"far_camera", "an orthographic camera up to 1e12 away: the same picture", far_camera, all_methods},
    {"shifted", "the world shifted by 1e5: the same picture", shifted, all_methods},
    {"refined", "voxel size halved, the same field", refined, has_grid},
};

}  // namespace brume
