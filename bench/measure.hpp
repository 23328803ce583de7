// One measurement by brume: a workload by a method, a shadow mode and their knobs; and how far its picture is off.
#pragma once
#include <string>

#include "cl/context.hpp"
#include "image/image.hpp"
#include "render/renderer.hpp"
#include "workload.hpp"

namespace brume::bench {

struct Setting {
  const char* name;  // permanent: results of years are compared by it
  int method;
  double step_voxels;  // of marchers; 0 for the others
  int shadow, light_grid = 64, storage = STORAGE_F32;
  double tolerance = 0;  // of adaptive
};
const std::vector<Setting>& settings();

SceneDesc scene_of(const Workload& work, const Setting& setting);
// The workload as a setting needs it, flattened once for all that need the same.
const FlatScene& flat_scene(const Workload& work, const Setting& setting, int lanes);
RenderPlan plan_of(const Workload& work, const Setting& setting, const FlatScene& flat);

// The exact picture of a workload: dda_gauss2, light traced. Rendered once and kept.
const Image& exact_picture(Context& context, const Workload& work);

}  // namespace brume::bench
