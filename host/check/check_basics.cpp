// Struct layout, random numbers, camera, phase functions, lights, textures.
#include <cmath>
#include <glm/geometric.hpp>

#include "check/check_parts.hpp"
#include "reference/light.hpp"
#include "reference/phase.hpp"
#include "reference/sampling.hpp"
#include "reference/surface.hpp"
#include "shared/aov.h"
#include "shared/ray.h"

namespace brume {

double CheckRandom::uniform(double lo, double hi) {
  state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
  return lo + (hi - lo) * static_cast<double>(state_ >> 11) * 0x1p-53;
}

dvec3 CheckRandom::in_box(double half) {
  const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
  return glm::vec3(x, y, z);
}

dvec3 CheckRandom::direction() {
  for (;;) {
    const dvec3 d = in_box(1);
    const double length = glm::length(d);
    if (length > 0.1 && length < 1) return glm::vec3(d / length);
  }
}

namespace {

void push(std::vector<float>& out, const dvec3& v) {
  for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(v[i]));
}

void add3(ErrorSum& sum, const float* kernel, const dvec3& reference) {
  for (int i = 0; i < 3; ++i) sum.add(kernel[i], reference[i]);
}

}  // namespace

std::vector<CheckRow> check_layout(Context& context, int lanes, int) {
  const FlatScene scene = check_scene("surfaces", 8, std::max(lanes, 4));
  const std::vector<std::size_t> sizes{
      sizeof(Packed3),      sizeof(Affine),        sizeof(Camera),   sizeof(Frame),     sizeof(Light), sizeof(Material),
      sizeof(Texture),      sizeof(Shape),         sizeof(Triangle), sizeof(Medium),    sizeof(Ray),   sizeof(Hit),
      sizeof(MediumResult), sizeof(SurfaceResult), sizeof(Sample),   sizeof(FilmPixel), sizeof(Work)};
  const std::vector<float> found = Probe(context, scene, lanes).run("probe_layout", {0}, 1, sizes.size());
  ErrorSum sum("layout", lanes, "layout");
  for (std::size_t i = 0; i < sizes.size(); ++i) sum.add(found[i], static_cast<double>(sizes[i]));
  return {sum.row()};
}

std::vector<CheckRow> check_rng(Context& context, int lanes, int items) {
  const FlatScene scene = check_scene("surfaces", 8, std::max(lanes, 4));
  std::vector<float> in;
  for (int i = 0; i < items; ++i)
    for (const int v : {i * 7919, i % 67, i % 5, i / 3}) in.push_back(bits_as_float(v));
  const std::vector<float> found = Probe(context, scene, lanes).run("probe_rng", in, 4, 1);
  ErrorSum sum("rng", lanes, "rng");
  for (int i = 0; i < items; ++i) sum.add(found[i], reference::rng_uniform(i * 7919, i % 67, i % 5, i / 3));
  return {sum.row()};
}

std::vector<CheckRow> check_camera(Context& context, int lanes, int items) {
  const int samples = 1 << 20;  // as many as a scene may ask for: all bits of their number are seen
  std::vector<CheckRow> rows;
  for (const char* name : {"surfaces", "mesh"}) {  // perspective, orthographic
    const FlatScene scene = check_scene(name, 64, std::max(lanes, 4));
    const Camera& camera = scene.frame.camera;
    std::vector<float> in;
    for (int i = 0; i < items; ++i) {
      in.push_back(bits_as_float(i * 37 % (camera.width * camera.height)));
      in.push_back(bits_as_float(i * 7919 % samples));
    }
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_camera", in, 2, 6);
    ErrorSum sum(std::string("camera/") + (camera.type == CAMERA_PERSPECTIVE ? "perspective" : "orthographic"), lanes,
                 "camera");
    for (int i = 0; i < items; ++i) {
      const int pixel = i * 37 % (camera.width * camera.height), sample = i * 7919 % samples;
      const auto ray = reference::frame_ray(scene.frame, pixel % camera.width, pixel / camera.width,
                                            reference::pixel_position(pixel, sample, camera.spp, scene.frame.seed))
                           .ray;
      add3(sum, &found[6 * i], ray.origin);
      add3(sum, &found[6 * i + 3], ray.dir);
    }
    rows.push_back(sum.row());
  }
  return rows;
}

std::vector<CheckRow> check_phase(Context& context, int lanes, int items) {
  const FlatScene scene = check_scene("surfaces", 8, std::max(lanes, 4));
  std::vector<CheckRow> rows;
  for (const double g : {0.0, -0.99, -0.65, 0.3, 0.65, 0.99}) {
    CheckRandom random;
    std::vector<float> in;
    std::vector<double> expected;
    const int phase = g == 0 ? PHASE_ISOTROPIC : PHASE_HENYEY_GREENSTEIN;
    for (int i = 0; i < items; ++i) {
      const dvec3 before = random.direction();
      // half of the directions close to straight on or straight back, where the lobe is
      const dvec3 after = i % 2 ? random.direction()
                                : dvec3(glm::vec3(glm::normalize((i % 4 ? 1.0 : -1.0) * before + random.in_box(0.1))));
      in.push_back(bits_as_float(phase));
      in.push_back(static_cast<float>(g));
      push(in, before);
      push(in, after);
      const double cosine = glm::dot(glm::normalize(before), glm::normalize(after));
      expected.push_back(reference::phase_eval(phase, static_cast<float>(g), cosine));
    }
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_phase", in, 8, 1);
    char name[32];
    std::snprintf(name, sizeof name, "phase/g=%g", g);
    ErrorSum sum(name, lanes, "phase");
    for (int i = 0; i < items; ++i) sum.add(found[i], expected[i]);
    rows.push_back(sum.row());
  }
  return rows;
}

std::vector<CheckRow> check_light(Context& context, int lanes, int items) {
  const FlatScene scene = check_scene("surfaces", 8, std::max(lanes, 4));
  CheckRandom random;
  std::vector<float> in;
  std::vector<dvec3> points;
  for (int i = 0; i < items; ++i) {
    points.push_back(random.in_box(2));
    in.push_back(bits_as_float(i % static_cast<int>(scene.lights.size())));
    push(in, points.back());
  }
  const std::vector<float> found = Probe(context, scene, lanes).run("probe_light", in, 4, 7);
  ErrorSum sum("light", lanes, "light");
  for (int i = 0; i < items; ++i) {
    const auto expected = reference::light_at(scene.lights[i % scene.lights.size()], points[i]);
    add3(sum, &found[7 * i], expected.travel);
    add3(sum, &found[7 * i + 3], expected.irradiance);
    sum.add(found[7 * i + 6], expected.distance);
  }
  return {sum.row()};
}

std::vector<CheckRow> check_texture(Context& context, int lanes, int items) {
  const FlatScene scene = check_scene("surfaces", 8, std::max(lanes, 4));
  std::vector<CheckRow> rows;
  for (std::size_t texture = 0; texture < scene.textures.size(); ++texture) {
    CheckRandom random;
    std::vector<float> in;
    for (int i = 0; i < items; ++i) {
      in.push_back(bits_as_float(static_cast<std::int32_t>(texture)));
      for (int k = 0; k < 2; ++k) in.push_back(static_cast<float>(random.uniform(-2, 3)));
    }
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_texture", in, 3, 4);
    const bool image = scene.textures[texture].type == TEXTURE_IMAGE;
    const char* name = !image ? "texture/checker" : scene.textures[texture].clamp ? "texture/clamped" : "texture/image";
    ErrorSum sum(name, lanes, "texture");
    for (int i = 0; i < items; ++i) {
      const glm::dvec2 uv(in[3 * i + 1], in[3 * i + 2]);
      add3(sum, &found[4 * i], reference::texture_lookup(scene, static_cast<int>(texture), uv));
      sum.add(found[4 * i + 3], reference::texture_second(scene.textures[texture], uv));
    }
    rows.push_back(sum.row());
  }
  return rows;
}

const std::vector<FunctionCheckRow>& function_checks() {
  static const std::vector<FunctionCheckRow> rows{
      {"layout", check_layout}, {"rng", check_rng},         {"camera", check_camera},     {"phase", check_phase},
      {"light", check_light},   {"texture", check_texture}, {"surfaces", check_surfaces}, {"media", check_media}};
  return rows;
}

}  // namespace brume
