// Whole pictures, kernel against reference.
#pragma once
#include <string>
#include <vector>

#include "check/check.hpp"
#include "film/film.hpp"

namespace brume {

// The scene of that name (check_parts.hpp) at size x size pixels, for every lane width: one row each.
std::vector<CheckRow> check_image(Context& context, const std::string& scene, int size, const std::vector<int>& lanes);

// Radiance of every pixel, a row. Pixels that differ while their keys differ are edges.
CheckRow film_check(const std::string& name, int lanes, const Film& kernel, const Film& reference);

// The kernels' film of a flat scene.
Film render_film(Context& context, const PlannedScene& scene, int lanes);

}  // namespace brume
