// The settings among which a pilot chooses.
#pragma once
#include <vector>

#include "chart/chart_scene.hpp"

namespace brume {

// Settings of one method and rule, light traced, that differ by their step: from coarse to fine.
using KnobFamily = std::vector<Knobs>;

// Of those of `methods` that draw no random numbers and sample the middles of their segments: every family, those first
// whose coarsest member should cost least.
std::vector<KnobFamily> knob_families(ChartScene& scene, const std::vector<int>& methods);

// Light grids that may stand in for tracing in them, coarse ones first.
std::vector<int> family_grids(const KnobFamily& family, const ChartScene& scene);

}  // namespace brume
