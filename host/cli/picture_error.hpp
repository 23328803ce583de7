// The error of the picture that was just made, as `brume render` tells it.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "film/film.hpp"
#include "plan/render_plan.hpp"
#include "scene/scene_desc.hpp"
#include "witness/witnesses.hpp"

namespace brume {

struct PictureError {
  WitnessError witness;  // without pixels: nobody asked, or there was no time
  double noise = 0;      // film_noise where the plan leaves something to chance; 0: nothing is known of it
};

inline constexpr int WITNESS_PIXELS = 256;     // asked where --witness does not say
inline constexpr double WITNESS_SHARE = 0.05;  // of the time of the render, which they may then take
inline constexpr int WITNESS_LEAST = 16;       // fewer say nothing
inline constexpr int WITNESS_GOAL_LEAST = 48;  // whatever time they take, where an error is to be reached

// `asked`: pixels, 0 none; nothing: WITNESS_PIXELS as far as WITNESS_SHARE allows. The scene has its voxels as given.
// Throws Interrupted.
PictureError picture_error(const PlannedScene& scene, const Film& film, std::optional<int> asked, double render_seconds,
                           const RenderDesc& goal);

// "error 0.31 % ± 0.04 %, noise 0.2 %"; empty where neither is known.
std::string picture_error_text(const PictureError& error);
// Of --stats: metric (that of the goal), estimate, interval (of rel_rmse), …; null where it is not known.
nlohmann::ordered_json picture_error_json(const PictureError& error, const RenderDesc& goal);

}  // namespace brume
