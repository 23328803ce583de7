// An error in the metric of a goal.
#pragma once
#include <array>

#include "film/film.hpp"
#include "scene/scene_desc.hpp"
#include "witness/witnesses.hpp"

namespace brume {

// What a pixel shows: the mean of its samples.
std::array<double, 3> shown_by(const FilmPixel& pixel);

double error_in(const WitnessError& error, int metric);
// The error that it is hardly above: the upper end of the interval where there is one.
double error_at_most(const WitnessError& error, int metric);

}  // namespace brume
