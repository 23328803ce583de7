// The settings that a chart goes through: which methods fit a scene and how far each of their knobs is turned.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scene/scene_desc.hpp"

namespace brume {

inline constexpr int METHOD_NONE = -2;  // of a scene without media

struct Knobs {
  int method = METHOD_NONE;
  double step = 0;     // share of a medium's longest side; 0: it has none
  int light_grid = 0;  // cells along it; 0: light is traced
  int storage = STORAGE_F32;
  int rule = IN_SCATTERING_SEGMENT;
  int spp = 1;
  double tolerance = 0;  // of adaptive; 0: it has none
  int level = 0;         // of detail
};

inline constexpr int LEVELS[] = {1, 2};                  // of detail, beside 0
inline constexpr int LIGHT_GRIDS[] = {16, 32, 64, 128};  // cells: those of a sweep

// What decides how far knobs are turned.
struct KnobLimits {
  int cells = 0;       // along the longest side of the finest grid; 0: all densities are constant
  bool grids = false;  // some medium with voxels scatters light, so that light grids have something to do
};

// "march_midpoint-step0.125-grid64-f32-segment-spp1": for files, and to find a point again.
std::string knobs_id(const Knobs& knobs);
std::string knobs_method(const Knobs& knobs);  // its name; "none" in a scene without media

// The scene with these settings for all its media: methods and steps of single media go.
SceneDesc knobs_apply(const SceneDesc& desc, const Knobs& knobs);

// Names as --methods takes them. InputError for an unknown one.
std::vector<int> methods_parse(const std::string& text);
// Those of `wanted` (none: of all) that some medium of the scene takes. InputError where one of `wanted` fits none.
std::vector<int> methods_fitting(const SceneDesc& desc, const std::vector<int>& wanted);

// Every setting once, coarse ones of each sweep first. methods: empty for a scene without media.
std::vector<Knobs> knobs_list(const std::vector<int>& methods, const KnobLimits& limits, int spp);

// Of the voxels of a level of detail.
KnobLimits limits_at(KnobLimits limits, int level);

// Steps as shares of a side, each half of the one before, from coarse ones to half a cell of the finest grid (of
// constant densities: 1/128) and `beyond` halvings further.
std::vector<double> steps_halving(const KnobLimits& limits, int beyond);

// From coarse to fine.
std::vector<double> tolerances_all();

// Each method's cheapest first, then each one's second: whenever the time ends, there is something of all. Last those
// with other numbers of samples than `spp`, which need exact pictures of their own.
void knobs_order(std::vector<Knobs>& list, int spp, const std::function<double(const Knobs&)>& cost);

// The most exact that there is: no steps where none are needed, light traced from every light, nothing left to chance.
SceneDesc exact_desc(const SceneDesc& desc, int spp);
// The same by steps of a fraction of a cell: what light does inside of a cell, which the methods that are exact for
// densities take from its middle, is followed too. Slower; which of the two is closer, witnesses say.
SceneDesc exact_desc_fine(const SceneDesc& desc, int spp, const KnobLimits& limits);

}  // namespace brume
