// Whole pictures, kernel against reference.
#pragma once
#include <string>

#include "check/check.hpp"
#include "film/film.hpp"
#include "plan/render_plan.hpp"

namespace brume {

// Radiance, transmittance and what is seen of the background of every pixel, by the tolerance of images. Pixels that
// differ while their keys differ are edges.
CheckRow film_check(const std::string& name, int lanes, const Film& kernel, const Film& reference);

// The kernels' film of a flat scene.
Film render_film(Context& context, const PlannedScene& scene, int lanes);

}  // namespace brume
