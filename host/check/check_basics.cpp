// Struct layout, random numbers, camera, phase functions, lights.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <glm/geometric.hpp>

#include "check/check_parts.hpp"
#include "check/row_scenes.hpp"
#include "reference/light.hpp"
#include "reference/phase.hpp"
#include "reference/sampling.hpp"
#include "render/renderer.hpp"
#include "scene/families.hpp"
#include "shared/aov.h"
#include "shared/layout.h"
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

void push3(std::vector<float>& out, const dvec3& v) {
  for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(v[i]));
}

void add3(ErrorSum& sum, const float* kernel, const dvec3& reference) {
  for (int i = 0; i < 3; ++i) sum.add(kernel[i], reference[i]);
}

namespace {

// A shared struct as this compiler lays it out: its size, then the offsets of its fields.
struct Layout {
  std::string name;
  std::vector<std::size_t> numbers;
};

std::vector<Layout> layouts() {
  std::vector<Layout> all;
#define F(field) +sizeof(Laid::field)
#define STRUCT(type, fields)                                                                                 \
  {                                                                                                          \
    using Laid = type;                                                                                       \
    static_assert(sizeof(Laid) == (0 fields), "shared/layout.h: the row " #type " names every field, once"); \
  }
  BRUME_STRUCTS(STRUCT)
#undef STRUCT
#undef F
#define F(field) , offsetof(Laid, field)
#define STRUCT(type, fields)                       \
  {                                                \
    using Laid = type;                             \
    all.push_back({#type, {sizeof(Laid) fields}}); \
  }
  BRUME_STRUCTS(STRUCT)
#undef STRUCT
#undef F
  return all;
}

Check layout_check(std::size_t index) {
  const std::vector<Layout> all = layouts();
  const auto prepare = [all, index](int) -> CheckCompare {
    return [all, index](Context& context, int lanes, ErrorSum& sum) {
      std::size_t total = 0, first = 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (i == index) first = total;
        total += all[i].numbers.size();
      }
      const PlannedScene scene = check_scene("empty", 8, bvh_width_for(lanes));
      const std::vector<float> found = Probe(context, scene, lanes).run("probe_layout", {0}, 1, total);
      const std::vector<std::size_t>& numbers = all[index].numbers;
      for (std::size_t i = 0; i < numbers.size(); ++i) sum.add(found[first + i], static_cast<double>(numbers[i]));
    };
  };
  return {"layout/" + all[index].name, "layout", prepare};
}

CheckCompare rng_prepare(int size) {
  return [items = size * size](Context& context, int lanes, ErrorSum& sum) {
    const PlannedScene scene = check_scene("empty", 8, bvh_width_for(lanes));
    std::vector<float> in;
    for (int i = 0; i < items; ++i)
      for (const int v : {i * 7919, i % 67, i % 5, i / 3}) in.push_back(bits_as_float(v));
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_rng", in, 4, 1);
    for (int i = 0; i < items; ++i) sum.add(found[i], reference::rng_uniform(i * 7919, i % 67, i % 5, i / 3));
  };
}

CheckCompare camera_prepare(int type, int size) {
  return [type, items = size * size](Context& context, int lanes, ErrorSum& sum) {
    const int samples = 1 << 20;  // as many as a scene may ask for: all bits of their number are seen
    SceneDesc desc = check_scene_desc("surfaces");
    desc.camera.type = type;
    const PlannedScene scene = row_scene(desc, "camera", 64, bvh_width_for(lanes));
    const Camera& camera = scene.frame.camera;
    std::vector<float> in;
    for (int i = 0; i < items; ++i) {
      in.push_back(bits_as_float(i * 37 % (camera.width * camera.height)));
      in.push_back(bits_as_float(i * 7919 % samples));
    }
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_camera", in, 2, 6);
    for (int i = 0; i < items; ++i) {
      const int pixel = i * 37 % (camera.width * camera.height), sample = i * 7919 % samples;
      const auto ray = reference::frame_ray(scene.frame, pixel % camera.width, pixel / camera.width,
                                            reference::pixel_position(pixel, sample, camera.spp, scene.frame.seed))
                           .ray;
      add3(sum, &found[6 * i], ray.origin);
      add3(sum, &found[6 * i + 3], ray.dir);
    }
  };
}

CheckCompare phase_prepare(int phase, double g, int size) {
  CheckRandom random;
  std::vector<float> in;
  std::vector<double> expected;
  for (int i = 0; i < size * size; ++i) {
    const dvec3 before = random.direction();
    // half of the directions close to straight on or straight back, where the lobe is
    const dvec3 after = i % 2 ? random.direction()
                              : dvec3(glm::vec3(glm::normalize((i % 4 ? 1.0 : -1.0) * before + random.in_box(0.1))));
    in.push_back(bits_as_float(phase));
    in.push_back(static_cast<float>(g));
    push3(in, before);
    push3(in, after);
    const double cosine = glm::dot(glm::normalize(before), glm::normalize(after));
    expected.push_back(reference::phase_eval(phase, static_cast<float>(g), cosine));
  }
  return [in, expected](Context& context, int lanes, ErrorSum& sum) {
    const PlannedScene scene = check_scene("empty", 8, bvh_width_for(lanes));
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_phase", in, 8, 1);
    for (std::size_t i = 0; i < expected.size(); ++i) sum.add(found[i], expected[i]);
  };
}

// The lights of a scene of one type, or surfaces that emit, each shape in its turn.
CheckCompare light_prepare(int type, int size) {
  return [type, items = size * size](Context& context, int lanes, ErrorSum& sum) {
    PlannedScene scene = type == LIGHT_SURFACE ? check_scene("area_lights", 8, bvh_width_for(lanes))
                                               : row_scene(lights_desc(type), "light", 8, bvh_width_for(lanes));
    const auto other = [&](const Light& light) { return light.type != type; };
    scene.lights.erase(std::remove_if(scene.lights.begin(), scene.lights.end(), other), scene.lights.end());
    CheckRandom random;
    std::vector<float> in;
    std::vector<dvec3> points;
    for (int i = 0; i < items; ++i) {
      points.push_back(random.in_box(2));
      in.push_back(bits_as_float(i % static_cast<int>(scene.lights.size())));
      push3(in, points.back());
    }
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_light", in, 4, 7);
    for (int i = 0; i < items; ++i) {
      const auto expected = reference::light_at(scene, scene.lights[i % scene.lights.size()], points[i],
                                                {static_cast<uint>(i), 0, scene.frame.seed});
      add3(sum, &found[7 * i], expected.travel);
      add3(sum, &found[7 * i + 3], expected.irradiance);
      sum.add(found[7 * i + 6], expected.distance);
    }
  };
}

}  // namespace

std::vector<Check> basic_checks() {
  std::vector<Check> checks;
  for (std::size_t i = 0; i < layouts().size(); ++i) checks.push_back(layout_check(i));
  checks.push_back({"rng", "rng", rng_prepare});
  for (const FamilyRow& row : camera_family())
    checks.push_back({"camera/" + std::string(row.name), "camera",
                      [type = row.id](int size) { return camera_prepare(type, size); }});
  for (const FamilyRow& row : phase_family())
    for (const double g :
         phase_takes_g(row.id) ? std::vector<double>{0, -0.99, -0.65, 0.3, 0.65, 0.99} : std::vector<double>{0}) {
      char parameter[16] = "";
      if (phase_takes_g(row.id)) std::snprintf(parameter, sizeof parameter, "/g=%g", g);
      checks.push_back({"phase/" + std::string(row.name) + parameter, "phase",
                        [phase = row.id, g](int size) { return phase_prepare(phase, g, size); }});
    }
  for (const FamilyRow& row : light_family())
    checks.push_back(
        {"light/" + std::string(row.name), "light", [type = row.id](int size) { return light_prepare(type, size); }});
  checks.push_back({"light/surface", "light", [](int size) { return light_prepare(LIGHT_SURFACE, size); }});
  return checks;
}

}  // namespace brume
