// See scene_reader.hpp: the whole file, camera, film, render settings, lights. Other parts: read_*.cpp.
#include "scene/scene_reader.hpp"

#include <glm/geometric.hpp>
#include <limits>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "scene/families.hpp"
#include "scene/read_parts.hpp"

namespace brume {

namespace {

constexpr int LIGHT_GRID_MAX = 1024;

constexpr std::size_t FILE_BYTES_MAX = 64u << 20;
constexpr int FILM_SIDE_MAX = 65536;
constexpr int DIRECTIONS_MAX = 1 << 16;
constexpr double STEPS_MAX = 1e5;        // along the medium's longest side
constexpr double INTENSITY_MAX = 1e100;  // W/sr of a light inverse to the square of a distance that may itself be 1e38

static_assert(CAMERA_COUNT == 2 && LIGHT_COUNT == 3, "read_camera and read_light know the keys of all");

CameraDesc read_camera(const JsonValue& camera) {
  CameraDesc c;
  c.type = camera.member("type", c.type, camera_family(), "camera");
  c.eye = camera.vec3("eye", c.eye);
  c.target = camera.vec3("target", c.target);
  c.up = camera.vec3("up", c.up);
  if (c.type == CAMERA_PERSPECTIVE) c.vfov = camera.number("vfov", c.vfov, Range::open(0, 180));
  if (c.type == CAMERA_ORTHOGRAPHIC) c.height = camera.number("height", c.height, Range::positive());
  camera.refuse_unread();
  const dvec3 view = c.target - c.eye;
  if (is_zero(view)) camera.fail("eye and target are the same point; they must differ");
  if (!spans_area(view, c.up))
    camera.fail("up is zero or along the view; it must point away from the line from eye to target");
  return c;
}

FilmDesc read_film(const JsonValue& scene) {
  FilmDesc f;
  if (!scene.has("film")) return f;
  const JsonValue film = scene.get("film");
  if (film.has("size")) {
    const std::vector<JsonValue> size = film.get("size").as_list();
    if (size.size() != 2) film.get("size").fail("expected [width, height]" + film.get("size").got());
    for (int i = 0; i < 2; ++i) f.size[i] = size[i].as_integer(1, FILM_SIDE_MAX);
  }
  f.spp = film.integer("spp", f.spp, 1, 1 << 20);
  f.exposure = film.number("exposure", f.exposure, Range::closed(-100, 100));
  f.transfer = film.member("transfer", f.transfer, transfer_family(), "transfer curve");
  film.refuse_unread();
  return f;
}

RenderDesc read_render(const JsonValue& scene) {
  RenderDesc r;
  if (!scene.has("render")) return r;
  const JsonValue render = scene.get("render");
  r.integrator = render.member("integrator", r.integrator, integrator_family(), "integrator");
  r.directions = render.integer("directions", r.directions, 1, DIRECTIONS_MAX);
  if (render.has("distance")) r.distance = render.get("distance").as_number(Range::positive());
  r.rotate = render.flag("rotate", r.rotate);
  r.method = read_method(render, r.method);
  r.step = read_step(render, r.step);
  r.tolerance = read_tolerance(render, r.tolerance);
  Family shadows = shadow_family();
  shadows.insert(shadows.begin(), {SHADOW_AUTO, "auto", "trace, which is exact"});
  Family rules = in_scattering_family();
  rules.insert(rules.begin(), {IN_SCATTERING_AUTO, "auto", "gauss2 where all else is exact"});
  r.in_scattering = render.member("in_scattering", r.in_scattering, rules, "in-scattering rule");
  r.shadow = render.member("shadow", r.shadow, shadows, "shadow mode");
  r.storage = render.member("storage", r.storage, storage_family(), "storage");
  r.level = render.integer("level", r.level, 0, LEVEL_MAX);
  r.light_grid = render.integer("light_grid", r.light_grid, 1, LIGHT_GRID_MAX);
  r.light_picks = render.integer("light_picks", r.light_picks, 0, LIGHT_PICKS_MAX);
  r.light_samples = render.integer("light_samples", r.light_samples, 1, LIGHT_PICKS_MAX);
  r.light_points = render.member("light_points", r.light_points, light_points_family(), "choice of points");
  r.roulette = render.number("roulette", r.roulette, Range::closed(0, 1));
  r.max_depth = render.integer("max_depth", r.max_depth, 0, 64);
  r.cutoff = render.number("cutoff", r.cutoff, Range::closed(0, 1));
  if (render.has("shadow_of_glass"))
    r.shadow_of_glass = render.get("shadow_of_glass").as_member(glass_shadow_family(), "shadow of glass");
  r.bvh = render.member("bvh", r.bvh, bvh_family(), "rule of the BVH");
  r.seed = render.integer("seed", r.seed, 0, 0x7fffffff);
  const auto goal = [&](const char* key, std::optional<double>& value) {
    if (render.has(key) && !render.get(key).json().is_null()) value = render.get(key).as_number(Range::positive());
  };
  goal("max_error", r.max_error);
  goal("time_budget", r.time_budget);
  r.error_metric = render.member("error_metric", r.error_metric, error_metric_family(), "error metric");
  if (r.max_error && r.time_budget)
    render.get("time_budget").fail("expected without max_error: one of them is reached");
  render.refuse_unread();
  return r;
}

LightDesc read_light(const JsonValue& light) {
  LightDesc l;
  l.type = light.get("type").as_member(light_family(), "light");
  if (l.type == LIGHT_DIRECTIONAL) {
    l.intensity = light.color("irradiance", l.intensity, Range::at_least_0());
  } else {
    l.position = light.get("position").as_vec3(Range::any());
    l.intensity = light.color("intensity", l.intensity, Range::closed(0, INTENSITY_MAX));
    l.falloff = light.member("falloff", l.falloff, falloff_family(), "falloff");
  }
  if (l.type != LIGHT_POINT) {
    l.direction = light.get("direction").as_vec3(Range::any());
    if (is_zero(l.direction)) light.get("direction").fail("the direction must not be zero");
  }
  if (l.type == LIGHT_SPOT) {
    l.angle = light.number("angle", l.angle, Range::open(0, 90));
    l.softness = light.number("softness", l.softness, Range::closed(0, 1));
  }
  light.refuse_unread();
  return l;
}

}  // namespace

int read_method(const JsonValue& owner, int fallback) {
  Family methods = method_family();
  methods.insert(methods.begin(), {METHOD_AUTO, "auto", "the cheapest that is exact for each medium"});
  return owner.member("method", fallback, methods, "method");
}

double read_step(const JsonValue& owner, double fallback) {
  const double step = owner.number("step", fallback, Range::positive());
  if (step >= 1 / STEPS_MAX) return step;
  char cause[160];
  std::snprintf(cause, sizeof cause,
                "%g makes %g steps along the longest side of a medium; at most %g are allowed, steps of %g", step,
                1 / step, STEPS_MAX, 1 / STEPS_MAX);
  owner.get("step").fail(cause);
}

double read_tolerance(const JsonValue& owner, double fallback) {
  constexpr double TOLERANCE_LEAST = 1e-7;  // what single precision leaves
  return owner.number("tolerance", fallback, Range::closed(TOLERANCE_LEAST, 1));
}

bool is_zero(const dvec3& v) { return !(glm::length(v) >= std::numeric_limits<float>::min()); }

bool spans_area(const dvec3& u, const dvec3& v) {
  return !is_zero(u) && !is_zero(v) && glm::length(glm::cross(glm::normalize(u), glm::normalize(v))) > 1e-9;
}

std::filesystem::path read_path(const JsonValue& value, const std::filesystem::path& folder) {
  const std::string text = value.as_string();
  if (text.empty() || text.find('\0') != std::string::npos) value.fail("expected the path of a file" + value.got());
  return (folder / text).lexically_normal();
}

std::vector<LightDesc> read_lights(const JsonValue& scene) {
  std::vector<LightDesc> lights;
  for (const JsonValue& light : scene.list("lights")) lights.push_back(read_light(light));
  return lights;
}

SceneDesc scene_read_text(std::string_view text, const std::filesystem::path& as_file,
                          const std::vector<std::string>& overrides, int frame) {
  nlohmann::json json = json_parse(text, as_file.string());
  for (const std::string& change : overrides) apply_override(json, change);
  if (frame != FRAME_ANY) apply_frame(json, frame, as_file.string(), "");
  const JsonValue scene(json, as_file.string());
  scene.expect_object();
  const std::filesystem::path folder = as_file.parent_path();
  SceneDesc desc;
  desc.file = as_file;
  if (scene.has("camera")) desc.camera = read_camera(scene.get("camera"));
  desc.film = read_film(scene);
  desc.background = scene.color("background", desc.background, Range::closed(0, RADIANCE_MAX));
  desc.ambient = scene.color("ambient", desc.ambient, Range::at_least_0());
  desc.lights = read_lights(scene);
  desc.materials = read_materials(scene, folder);
  desc.shapes = read_shapes(scene, desc.materials, folder);
  desc.media = read_media(scene, desc.materials, folder);
  desc.render = read_render(scene);
  scene.refuse_unread();
  if (desc.render.integrator == INTEGRATOR_AMBIENT_OCCLUSION) {  // it knows neither
    desc.lights.clear();
    desc.media.clear();
  }
  return desc;
}

CameraDesc camera_read(std::string_view text, const std::filesystem::path& as_file) {
  const nlohmann::json json = json_parse(text, as_file.string());
  const JsonValue file(json, as_file.string());
  file.expect_object();
  for (const char* part : {"film", "lights", "materials", "shapes", "media", "render"})
    if (json.contains(part) && !json.contains("camera")) file.fail("is a scene without a camera");
  return read_camera(json.contains("camera") ? file.get("camera") : file);
}

std::string scene_file_text(const std::filesystem::path& file) {
  return file_read_text(file, FILE_BYTES_MAX, "a scene file");
}

SceneDesc scene_read(const std::filesystem::path& file, const std::vector<std::string>& overrides, int frame) {
  return scene_read_text(scene_file_text(file), file, overrides, frame);
}

}  // namespace brume
