// What a scene needs → -D options. The only place that writes them; their meaning is in kernels/lib/options.cl.
#pragma once
#include <string>
#include <vector>

#include "cl/device.hpp"
#include "plan/render_plan.hpp"

namespace brume {

// A row of what is left out of the kernels of a scene: BRUME_<name>.
struct KernelOption {
  const char* name;
  unsigned value;    // what the scene needs
  unsigned generic;  // what any scene may need: a count, 1, or of the *_USED all bits that there are
  const char* what;
};
std::vector<KernelOption> scene_kernel_options(const FlatScene& scene, const RenderPlan& plan);

// " -DBRUME_NAME=value"
std::string option_text(const char* name, unsigned value);

// Some material reflects or refracts.
bool scene_blends_light(const FlatScene& scene);
bool scene_is_specular(const FlatScene& scene);

// Options for kernels specialised to a plan of `scene`; `generic`: every feature on, as for any scene.
std::string kernel_options(const FlatScene& scene, const RenderPlan& plan, const DeviceInfo& device, int lanes,
                           bool generic);

}  // namespace brume
