// See picture_error.hpp.
#include "cli/picture_error.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "film/film_write.hpp"
#include "pilot/goal.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

constexpr unsigned WITNESS_SEED = 1;

// Two digits of it, in percent: "0.31 %".
std::string percent(double share) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * share);
  return text;
}

}  // namespace

PictureError picture_error(const PlannedScene& scene, const Film& film, std::optional<int> asked, double render_seconds,
                           const RenderDesc& goal) {
  PictureError error;
  if (plan_is_random(scene)) error.noise = film_noise(film, scene.frame);
  WitnessOptions options;
  options.seconds = WITNESS_SHARE * render_seconds;
  options.least = asked.value_or(goal.max_error ? WITNESS_GOAL_LEAST : 0);
  if (asked == 0) return error;
  const Frame& frame = scene.frame;
  const Image picture = film_image(film, {frame.crop_x0, frame.crop_y0}, {frame.crop_x1, frame.crop_y1});
  const WitnessDraws draws = witnesses_draw(picture, frame, asked.value_or(WITNESS_PIXELS), WITNESS_SEED);
  const Witnesses witnesses = witnesses_ask(scene, draws, options);
  if (!asked && witnesses.draws.size() < WITNESS_LEAST) return error;
  error.witness = witnesses_compare(witnesses, frame, picture);
  return error;
}

std::string picture_error_text(const PictureError& error) {
  std::string text;
  const WitnessError& w = error.witness;
  if (w.pixels > 0) text = "error " + percent(w.rel_rmse) + " ± " + percent((w.interval[1] - w.interval[0]) / 2);
  if (error.noise > 0) text += std::string(text.empty() ? "" : ", ") + "noise " + percent(error.noise);
  return text;
}

nlohmann::ordered_json picture_error_json(const PictureError& error, const RenderDesc& goal) {
  nlohmann::ordered_json json = {
      {"metric", family_name(error_metric_family(), goal.error_metric)}, {"estimate", nullptr}, {"interval", nullptr}};
  const WitnessError& w = error.witness;
  if (w.pixels > 0) {
    json["estimate"] = error_in(w, goal.error_metric);
    if (goal.error_metric == METRIC_REL_RMSE) json["interval"] = w.interval;
    json["rel_rmse"] = w.rel_rmse;
    json["max_abs"] = w.max_abs;
    json["display_p99"] = w.display;
  }
  json["witnesses"] = w.pixels;
  json["noise"] = error.noise > 0 ? nlohmann::ordered_json(error.noise) : nullptr;
  json["target"] = goal.max_error ? nlohmann::ordered_json(*goal.max_error) : nullptr;
  return json;
}

}  // namespace brume
