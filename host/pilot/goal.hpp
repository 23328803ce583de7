// An error in the metric of a goal.
#pragma once
#include "scene/scene_desc.hpp"
#include "witness/witnesses.hpp"

namespace brume {

double error_in(const WitnessError& error, int metric);
// The error that it is hardly above: the upper end of the interval where there is one.
double error_at_most(const WitnessError& error, int metric);

}  // namespace brume
