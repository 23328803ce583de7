// See picture_goal.hpp.
#include "cli/picture_goal.hpp"

#include <cmath>
#include <memory>

#include "base/number_text.hpp"
#include "pilot/goal.hpp"
#include "pilot/pilot.hpp"
#include "pilot/refine.hpp"
#include "render/device_scene.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

std::string metric_name(const RenderDesc& goal) {
  return std::string(family_name(error_metric_family(), goal.error_metric));
}

// "march_midpoint, step 0.0156, gauss2, light grid 64"
std::string knobs_text(const Knobs& knobs) {
  std::string text = knobs_method(knobs);
  if (knobs.step > 0) text += ", step " + number_text(knobs.step, 3);
  if (knobs.level > 0) text += ", level " + std::to_string(knobs.level);
  if (knobs.tolerance > 0)
    text += ", tolerance " + number_text(knobs.tolerance, 3);
  else if (knobs.rule != IN_SCATTERING_SEGMENT)
    text += ", " + std::string(family_name(in_scattering_family(), knobs.rule));
  return text + (knobs.light_grid > 0 ? ", light grid " + std::to_string(knobs.light_grid) : ", light traced");
}

bool goal_missed(const RenderDesc& goal, const WitnessError& error) {
  return goal.max_error && error.pixels > 0 && error_in(error, goal.error_metric) > *goal.max_error;
}

std::string out_of_reach(const RenderDesc& goal, const PilotTrial& trial) {
  if (goal.max_error)
    return "max_error " + number_text(*goal.max_error) + " is out of reach; the closest, " + knobs_text(trial.knobs) +
           ", has a " + metric_name(goal) + " of " + number_text(error_in(trial.error, goal.error_metric), 2);
  return "time_budget " + number_text(*goal.time_budget) + " s is too little; the quickest, " +
         knobs_text(trial.knobs) + ", takes about " + number_text(trial.seconds, 2) + " s";
}

}  // namespace

SceneDesc picture_for_goal(const RenderArguments& arguments, const SceneDesc& desc, LoadedScene& loaded,
                           Context& context, int lanes, std::vector<std::string>& notes,
                           const std::function<void(const std::string&)>& say) {
  if (!desc.render.has_goal()) return desc;
  const std::vector<int> wanted = arguments.method == "auto" ? std::vector<int>{} : methods_parse(arguments.method);
  const std::vector<int> methods = methods_fitting(desc, wanted);
  if (methods.empty()) {
    notes.push_back("the scene has no media that are walked, there is nothing to choose for max_error or time_budget");
    return desc;
  }
  // One program for all candidates, whatever they need.
  ChartScene scene(desc, loaded, context, {lanes, true, arguments.crop_box()});
  const PilotChoice choice = Pilot(scene, methods).choose(desc.render);
  const PilotTrial& trial = choice.trial;
  if (!choice.reached) notes.push_back(out_of_reach(desc.render, trial));
  say("chosen of " + std::to_string(choice.trials) + " settings in " + number_text(choice.seconds, 2) +
      " s: " + knobs_text(trial.knobs) + "; expected " + metric_name(desc.render) + " " +
      number_text(error_in(trial.error, desc.render.error_metric), 2));
  return knobs_apply(desc, trial.knobs);
}

void picture_refine_for_goal(const RenderArguments& arguments, const SceneDesc& desc, const PlannedScene& flat,
                             Context& context, const Renderer& renderer, Film& film, PictureError& error,
                             const std::function<void(const std::string&)>& say) {
  constexpr int REFINEMENTS = 4;
  constexpr double HELPED = 0.9;  // of the error before
  constexpr double HOPED = 4;     // by which one refinement divides the error, where nothing better is known
  const RenderDesc& goal = desc.render;
  std::optional<SceneDesc> finer = desc;
  // With a level of detail, what is finer is the scene of the witnesses.
  const std::shared_ptr<DeviceScene> scene = desc.render.level > 0 && goal_missed(goal, error.witness)
                                                 ? std::make_shared<DeviceScene>(context, flat)
                                                 : renderer.scene();
  bool helped = true;
  double gain = HOPED;
  for (int i = 0; i < REFINEMENTS && goal_missed(goal, error.witness); ++i) {
    if (error_in(error.witness, goal.error_metric) > *goal.max_error * std::pow(gain, REFINEMENTS - i)) return;
    std::optional<SceneDesc> next = helped ? settings_finer(*finer) : std::nullopt;
    if (!next && arguments.method == "auto") next = settings_closest(*finer);
    if (!next) return;
    finer = next;
    const RenderPlan plan = plan_render(*finer, scene->flat(), {arguments.crop_box(), arguments.alpha});
    Renderer by_finer(context, scene, plan, {renderer.stats().lanes, renderer.stats().generic, 0});
    const double before = error_in(error.witness, goal.error_metric);
    const double share = picture_refine(by_finer, plan.frame, goal, film);
    error = picture_error(flat, film, arguments.witness, renderer.stats().render_s, goal);
    const double after = error_in(error.witness, goal.error_metric);
    say("refined " + number_text(100 * share, 2) + " % of the pixels: " + metric_name(goal) + " " +
        number_text(before, 2) + " -> " + number_text(after, 2));
    helped = after < HELPED * before;
    gain = helped ? before / after : HOPED;
  }
}

std::string goal_missed_note(const RenderDesc& goal, const WitnessError& error) {
  if (!goal_missed(goal, error)) return "";
  const double is = error_in(error, goal.error_metric);
  return "max_error " + number_text(*goal.max_error) + " is not reached: witnesses say " + metric_name(goal) + " " +
         number_text(is, 2);
}

}  // namespace brume
