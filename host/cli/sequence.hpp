// brume render --frames: the pictures of a sequence, one after the other on one device, the next one read meanwhile.
#pragma once
#include "cli/render_arguments.hpp"

namespace brume {

// The exit code: 1 where a frame could not be rendered.
int sequence_render(const RenderArguments& arguments);

}  // namespace brume
