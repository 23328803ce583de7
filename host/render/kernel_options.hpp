// What a scene needs → -D options. The only place that writes them; their meaning is in kernels/lib/options.cl.
#pragma once
#include <string>

#include "cl/device.hpp"
#include "plan/render_plan.hpp"

namespace brume {

// Some material reflects or refracts.
bool scene_is_specular(const FlatScene& scene);

// Options for kernels specialised to a plan of `scene`; `generic`: every feature on, as for any scene.
std::string kernel_options(const FlatScene& scene, const RenderPlan& plan, const DeviceInfo& device, int lanes,
                           bool generic);

}  // namespace brume
