// What a finished render says of itself: the --stats file, the metadata of an EXR, one line for the terminal.
#pragma once
#include <string>

#include "cl/device.hpp"
#include "cli/picture_error.hpp"
#include "image/image.hpp"
#include "plan/render_plan.hpp"
#include "render/renderer.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

struct RunTimes {
  double load_s = 0;   // reading the scene and its files, flattening
  double pilot_s = 0;  // choosing settings for a goal
  double total_s = 0;  // process start to last file written
};

std::string render_stats_json(const SceneDesc& desc, const PlannedScene& flat, const DeviceInfo& device,
                              const RenderStats& stats, const PictureError& error, const RunTimes& times);
ImageMetadata render_metadata(const SceneDesc& desc, const PlannedScene& flat, const DeviceInfo& device,
                              const RenderStats& stats, const PictureError& error);
// What is told where reflected and refracted rays were dropped.
// Whether the dropped rays together weigh more than a thousandth of a sample; what is told of them then.
bool dropped_count(const RenderStats& stats);
std::string dropped_note(const RenderStats& stats, double cutoff);
// What is told where samples were left out.
std::string invalid_note(const RenderStats& stats);
std::string render_summary(const SceneDesc& desc, const PlannedScene& flat, const DeviceInfo& device,
                           const RenderStats& stats, const PictureError& error, const RunTimes& times);

}  // namespace brume
