// See render_report.hpp. Programs read the JSON keys: they stay as they are.
#include "cli/render_report.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "scene/families.hpp"
#include "shared/ray.h"
#include "version.hpp"

namespace brume {

namespace {

std::string method_of(const MediumWalk& walk) { return std::string(family_name(method_family(), walk.method)); }

// That of all media, or of each: "dda_gauss2 (/media/0), homogeneous (/media/1)".
std::string method_names(const PlannedScene& flat) {
  if (flat.walks.empty()) return "none";
  const auto same = [&](const MediumWalk& walk) { return walk.method == flat.walks.front().method; };
  if (std::all_of(flat.walks.begin(), flat.walks.end(), same)) return method_of(flat.walks.front());
  std::string names;
  for (std::size_t i = 0; i < flat.walks.size(); ++i)
    names += (i > 0 ? ", " : "") + method_of(flat.walks[i]) + " (" + flat.sizes[i].place + ")";
  return names;
}

// The method of each medium, and its step in world units where it has one.
nlohmann::ordered_json media_json(const PlannedScene& flat) {
  nlohmann::ordered_json media = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < flat.walks.size(); ++i) {
    media.push_back({{"place", flat.sizes[i].place}, {"method", method_of(flat.walks[i])}});
    if (method_has_tolerance(flat.walks[i].method)) media.back()["tolerance"] = flat.walks[i].tolerance;
    if (method_has_step(flat.walks[i].method)) media.back()["step"] = flat.walks[i].step * flat.unit;
  }
  return media;
}

}  // namespace

std::string render_stats_json(const SceneDesc& desc, const PlannedScene& flat, const DeviceInfo& device,
                              const RenderStats& stats, const PictureError& error, const RunTimes& times) {
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const PassStats& pass : stats.passes)
    passes.push_back({{"name", pass.name}, {"s", pass.seconds}, {"items", pass.items}});
  const nlohmann::ordered_json json = {
      {"scene", desc.file.string()},
      {"version", VERSION},
      {"device", device.title()},
      {"lanes", stats.lanes},
      {"generic_kernels", stats.generic},
      {"method", method_names(flat)},
      {"step", desc.render.step},
      {"level", desc.render.level},
      {"media", media_json(flat)},
      {"size", {desc.film.size.x, desc.film.size.y}},
      {"spp", desc.film.spp},
      {"kernel_build_s", stats.kernel_build_s},
      {"load_s", times.load_s},
      {"pilot_s", times.pilot_s},
      {"upload_s", stats.upload_s},
      {"render_s", stats.render_s},
      {"total_s", times.total_s},
      {"rays",
       {{"primary", stats.primary_rays},
        {"secondary", stats.secondary_rays},
        {"shadow", stats.shadow_rays},
        {"dropped", stats.dropped_rays}}},
      {"lookups", stats.lookups},
      {"dropped_weight", stats.primary_rays > 0 ? stats.dropped_weight / stats.primary_rays : 0},
      {"invalid_samples", stats.invalid_samples},
      {"passes", passes},
      {"memory",
       {{"device_bytes", stats.device_bytes}, {"voxel_bytes", stats.voxel_bytes}, {"bvh_bytes", stats.bvh_bytes}}},
      {"error", picture_error_json(error, desc.render)}};
  return json_line(json, 2) + "\n";
}

ImageMetadata render_metadata(const SceneDesc& desc, const PlannedScene& flat, const DeviceInfo& device,
                              const RenderStats& stats, const PictureError& error) {
  ImageMetadata all = {
      {"scene", desc.file.string()}, {"method", method_names(flat)},         {"device", device.title()},
      {"driver", device.driver},     {"lanes", std::to_string(stats.lanes)}, {"spp", std::to_string(desc.film.spp)},
      {"version", VERSION}};
  if (desc.render.level > 0) all.push_back({"level", std::to_string(desc.render.level)});
  if (const std::string text = picture_error_text(error); !text.empty()) all.push_back({"error", text});
  return all;
}

bool dropped_count(const RenderStats& stats) { return stats.dropped_weight > 1e-3 * stats.primary_rays; }

std::string dropped_note(const RenderStats& stats, double cutoff) {
  char text[256];
  std::snprintf(
      text, sizeof text,
      "%.0f reflected and refracted rays were dropped, a sample may send on %d, none that weighs less than %g; "
      "together they weigh %.2g %% of a sample in the mean",
      stats.dropped_rays, SECONDARY_RAYS_MAX, cutoff, 100 * stats.dropped_weight / stats.primary_rays);
  return text;
}

std::string invalid_note(const RenderStats& stats) {
  char text[256];
  std::snprintf(text, sizeof text,
                "%.0f of %.0f samples are no number or brighter than %g and left out, the first at pixel %d,%d",
                stats.invalid_samples, stats.primary_rays, double(SAMPLE_MAX), stats.first_invalid.x,
                stats.first_invalid.y);
  return text;
}

std::string render_summary(const SceneDesc& desc, const PlannedScene& flat, const DeviceInfo& device,
                           const RenderStats& stats, const PictureError& error, const RunTimes& times) {
  char film[64], rest[512];
  std::snprintf(film, sizeof film, "%dx%d, %d spp, method ", desc.film.size.x, desc.film.size.y, desc.film.spp);
  std::snprintf(rest, sizeof rest,
                ", %d lanes on %s: load %.2f s, kernels %.2f s, upload %.2f s, render %.2f s, total %.2f s",
                stats.lanes, device.name.c_str(), times.load_s, stats.kernel_build_s, stats.upload_s, stats.render_s,
                times.total_s);
  const std::string known = picture_error_text(error);
  const std::string level = desc.render.level > 0 ? ", level " + std::to_string(desc.render.level) : "";
  return film + method_names(flat) + level + rest + (known.empty() ? "" : "; " + known);
}

}  // namespace brume
