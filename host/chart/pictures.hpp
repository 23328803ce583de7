// The pictures that a chart's page shows: small enough to travel inside of it.
#pragma once
#include <array>
#include <filesystem>

#include "image/image.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

inline constexpr int PICTURE_SIDE = 384;                // pixels at most; larger ones become means over blocks
inline constexpr double ERROR_LO = 1e-4, ERROR_HI = 1;  // of the exact picture's mean: the ends of the ramp

// The colour of an error, from black at ERROR_LO through red and orange to near white at ERROR_HI and above, along its
// logarithm; as bright in grey. Three values in [0, 1].
std::array<float, 3> error_color(double relative);

// Through the film's display curve.
void picture_write(const Image& image, const FilmDesc& film, const std::filesystem::path& file);
// Of each pixel the largest error of its channels.
void error_map_write(const Image& image, const Image& exact, const std::filesystem::path& file);

}  // namespace brume
