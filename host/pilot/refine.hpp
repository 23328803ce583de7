// A picture that is further off than was asked for is refined: by finer settings, where those make a difference.
#pragma once
#include <optional>

#include "pilot/goal.hpp"
#include "render/renderer.hpp"

namespace brume {

// The next finer settings: half the step, a quarter of the tolerance, twice the cells of light grids, light at two
// points of each segment. Nothing where there are none.
std::optional<SceneDesc> settings_finer(const SceneDesc& desc);

// The closest there are: every optical depth exact, light traced, at two points of each segment. Nothing where those
// are what `desc` has.
std::optional<SceneDesc> settings_closest(const SceneDesc& desc);

// Renders every 16th pixel of the frame's crop by `finer`, then all of those tiles of 8 x 8 where that differs from the
// film by about as much as the goal allows. Returns the share of the pixels that were replaced; throws Interrupted, the
// film as it was.
double picture_refine(Renderer& finer, const Frame& frame, const RenderDesc& goal, Film& film);

}  // namespace brume
