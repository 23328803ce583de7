// What the kernels of a scene hold and what they were spared, in words.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "plan/render_plan.hpp"

namespace brume {

// needs, left_out: lists of words; options: what the compiler is told of it.
nlohmann::ordered_json kernels_json(const PlannedScene& scene);

}  // namespace brume
