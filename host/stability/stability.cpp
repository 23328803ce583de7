// See stability.hpp: the judgement, and the order of cases and methods.
#include "stability/stability.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/number_text.hpp"
#include "plan/planned_scene.hpp"
#include "reference/medium.hpp"
#include "reference/scatter.hpp"
#include "render/renderer.hpp"
#include "scene/families.hpp"
#include "scene/scene_reader.hpp"
#include "shared/method.h"
#include "stability/stability_parts.hpp"

namespace brume {

namespace {

constexpr double TRANSMITTANCE_ABOVE_ONE = 1e-6;  // a rounding of exp

bool light_valid(const dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

std::string text(const dvec3& v) { return "(" + number(v.x) + " " + number(v.y) + " " + number(v.z) + ")"; }

dvec3 float_exact(const dvec3& v) { return dvec3(glm::vec3(v)); }

}  // namespace

std::string number(double value) { return number_text(value, 3); }

void StabilityRays::add(const dvec3& origin, const dvec3& dir, double t_max) {
  rays.push_back({float_exact(origin), float_exact(dir)});
  ends.push_back(t_max);
}

void StabilityRays::through(const dvec3& point, const dvec3& dir, double back) {
  const dvec3 unit = glm::normalize(dir);
  add(point - back * unit, unit);
}

bool StabilityRun::tracks() const { return method_tracks(method_); }
bool StabilityRun::steps() const { return method_has_step(method_) && method_ != METHOD_HOMOGENEOUS; }
bool StabilityRun::exact() const { return !tracks() && !steps() && method_exact_for(method_) != 0; }

PlannedScene StabilityRun::cube(const std::string& density, const std::string& medium,
                                const std::string& render) const {
  const std::string interpolation = method_fits(method_) == FITS_NEAREST ? "nearest" : "trilinear";
  // what fits constant densities takes none as voxels
  const std::string even =
      method_fits(method_) & FITS_CONSTANT && method_ != METHOD_HOMOGENEOUS ? "linear" : "constant";
  const std::string text =
      R"({"film": {"size": [4, 4]}, "background": [0.1, 0.1, 0.1],
      "lights": [{"type": "directional", "direction": [-0.3, -0.4, -1], "irradiance": [3, 2, 1]}],
      "media": [{"interpolation": ")" +
      interpolation + R"(", "density": )" +
      (density.empty() ? R"({"type": ")" + even + R"(", "resolution": [8, 8, 8]})" : density) + R"(, "sigma_a": 0.3)" +
      (is_for_liquids(method_) ? R"(, "type": "liquid")" : R"(, "sigma_s": 0.9)") +
      (medium.empty() ? "" : ", " + medium) + R"(}],
      "render": {"method": ")" +
      std::string(family_name(method_family(), method_)) + "\"" + (render.empty() ? "" : ", " + render) + "}}";
  return flatten(scene_read_text(text, "stability.json", {}), {bvh_width_for(lanes_), {}});
}

void StabilityRun::record(const std::string& remark) { row_.remark += (row_.remark.empty() ? "" : "; ") + remark; }

void StabilityRun::expect(bool holds, const std::string& remark) {
  if (holds) return;
  if (row_.holds) record(remark);  // the first is enough
  row_.holds = false;
}

std::vector<StabilityRun::Sent> StabilityRun::shoot(const PlannedScene& scene, const StabilityRays& rays) {
  std::vector<float> in;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    for (int k = 0; k < 3; ++k) in.push_back(static_cast<float>(rays.rays[i].origin[k]));
    for (int k = 0; k < 3; ++k) in.push_back(static_cast<float>(rays.rays[i].dir[k]));
    in.push_back(static_cast<float>(rays.ends[i]));
  }
  const std::vector<float> out = Probe(context_, scene, lanes_).run("probe_scatter", in, 7, 6);
  std::vector<Sent> sent;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const float* o = &out[6 * i];
    sent.push_back({{o[0], o[1], o[2]}, {o[3], o[4], o[5]}});
    const Sent& s = sent.back();
    const std::string where = "ray from " + text(rays.rays[i].origin) + " along " + text(rays.rays[i].dir);
    expect(light_valid(s.radiance), where + ": radiance " + text(s.radiance));
    expect(light_valid(s.transmittance) &&
               std::max({s.transmittance.x, s.transmittance.y, s.transmittance.z}) <= 1 + TRANSMITTANCE_ABOVE_ONE,
           where + ": transmittance " + text(s.transmittance));
  }
  return sent;
}

void StabilityRun::compare(const PlannedScene& scene, const StabilityRays& rays, double limit, bool all_exact) {
  const std::vector<Sent> sent = shoot(scene, rays);
  const Medium medium = scene.medium(0);
  double worst = 0, mean = 0;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    const double depth =
        reference::optical_depth(scene, 0, rays.rays[i], rays.ends[i], reference::method_exact(medium));
    const double difference = sent[i].transmittance.x - std::exp(-reference::sigma_t_of(medium).x * depth);
    worst = std::max(worst, std::abs(difference));
    mean += difference / static_cast<double>(sent.size());
  }
  if (tracks()) {
    record("transmittance off by " + number(mean) + " in the mean");
    return;
  }
  expect(worst <= limit || !(exact() || all_exact), "more than " + number(limit));
  record("transmittance off by " + number(worst));
}

std::vector<StabilityCase> stability_cases() {
  std::vector<StabilityCase> cases;
  for (const auto* table : {&STABILITY_RAYS, &STABILITY_MEDIA})
    for (const StabilityEntry& entry : *table) cases.push_back({entry.name, entry.what});
  return cases;
}

std::vector<StabilityRow> check_stability(Context& context, const StabilityOptions& options,
                                          const std::function<void(const StabilityRow&)>& report) {
  std::vector<StabilityRow> rows;
  for (const auto* table : {&STABILITY_RAYS, &STABILITY_MEDIA})
    for (const StabilityEntry& entry : *table) {
      if (std::string(entry.name).find(options.filter) == std::string::npos) continue;
      for (const FamilyRow& method : method_family()) {
        if (!entry.fits(method.id)) continue;
        for (const int lanes : options.lanes) {
          interrupt_check();
          StabilityRun run(context, method.id, lanes);
          entry.run(run);
          StabilityRow row = run.row();
          row.name = entry.name;
          row.method = method.name;
          row.lanes = lanes;
          rows.push_back(row);
          report(row);
        }
      }
    }
  return rows;
}

}  // namespace brume
