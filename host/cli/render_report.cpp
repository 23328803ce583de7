// See render_report.hpp. The JSON keys are those of the design and stay as they are.
#include "cli/render_report.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "scene/families.hpp"
#include "version.hpp"

namespace brume {

namespace {

std::string method_name(const FlatScene& flat) {
  return flat.media.empty() ? "none" : std::string(family_name(method_family(), flat.method));
}

}  // namespace

std::string render_stats_json(const SceneDesc& desc, const FlatScene& flat, const DeviceInfo& device,
                              const RenderStats& stats, const RunTimes& times) {
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const PassStats& pass : stats.passes)
    passes.push_back({{"name", pass.name}, {"s", pass.seconds}, {"items", pass.items}});
  const nlohmann::ordered_json json = {
      {"scene", desc.file.string()},
      {"version", VERSION},
      {"device", device.title()},
      {"lanes", stats.lanes},
      {"method", method_name(flat)},
      {"step", desc.render.step},
      {"size", {desc.film.size.x, desc.film.size.y}},
      {"spp", desc.film.spp},
      {"kernel_build_s", stats.kernel_build_s},
      {"load_s", times.load_s},
      {"upload_s", stats.upload_s},
      {"render_s", stats.render_s},
      {"total_s", times.total_s},
      {"rays", {{"primary", stats.primary_rays}, {"secondary", stats.secondary_rays}, {"shadow", stats.shadow_rays}}},
      {"lookups", stats.lookups},
      {"passes", passes},
      {"memory",
       {{"device_bytes", stats.device_bytes}, {"voxel_bytes", stats.voxel_bytes}, {"bvh_bytes", stats.bvh_bytes}}},
      {"error", {{"estimate", nullptr}, {"target", nullptr}}}};
  return json_line(json, 2) + "\n";
}

ImageMetadata render_metadata(const SceneDesc& desc, const FlatScene& flat, const DeviceInfo& device,
                              const RenderStats& stats) {
  return {{"scene", desc.file.string()}, {"method", method_name(flat)},          {"device", device.title()},
          {"driver", device.driver},     {"lanes", std::to_string(stats.lanes)}, {"spp", std::to_string(desc.film.spp)},
          {"version", VERSION}};
}

std::string render_summary(const SceneDesc& desc, const FlatScene& flat, const DeviceInfo& device,
                           const RenderStats& stats, const RunTimes& times) {
  char text[512];
  std::snprintf(text, sizeof text,
                "%dx%d, %d spp, method %s, %d lanes on %s: load %.2f s, kernels %.2f s, upload %.2f s, render %.2f s, "
                "total %.2f s",
                desc.film.size.x, desc.film.size.y, desc.film.spp, method_name(flat).c_str(), stats.lanes,
                device.name.c_str(), times.load_s, stats.kernel_build_s, stats.upload_s, stats.render_s, times.total_s);
  return text;
}

}  // namespace brume
