// How far off a picture is: some of its pixels, rendered in double precision by the reference, are held against it.
#pragma once
#include <array>
#include <vector>

#include "film/film.hpp"
#include "image/image.hpp"
#include "plan/render_plan.hpp"

namespace brume {

struct WitnessOptions {
  double seconds = 30;  // after which no further pixel is begun, once there are `least`
  int least = 16;
  int order = 3;  // Gauss-Legendre points between two faces of cells
};

// A pixel that is asked. It stands for `weight` of a picture of as many pixels as are drawn.
struct WitnessDraw {
  int x, y;
  double weight;
};
using WitnessDraws = std::vector<WitnessDraw>;

// `count` pixels of `picture`, the crop of `frame` as film_image gives it; any first part of them is spread over all of
// it. Half are drawn evenly and half by the square of their brightness, because methods err by a share of what they
// show; a bright pixel may be drawn more than once. All pixels, once, where there are no more than `count`.
WitnessDraws witnesses_draw(const Image& picture, const Frame& frame, int count, unsigned seed);

// What the reference says of them.
struct Witnesses {
  WitnessDraws draws;
  std::vector<std::array<double, 3>> radiance;  // their means over samples
  int order = 0;
};
// By single scattering integrated between all faces of cells, whatever the plan says of methods, with the plan's own
// samples of each pixel: the error of the integration, not that of the edges. Throws Interrupted.
Witnesses witnesses_ask(const PlannedScene& scene, const WitnessDraws& draws, const WitnessOptions& options);

// What they say of a picture: errors of its R, G, B against theirs.
struct WitnessError {
  int pixels = 0;  // that were compared
  int order = 0;
  double rel_rmse = 0;                   // over the mean of the picture
  std::array<double, 2> interval{0, 0};  // of rel_rmse: it lies there in 95 of 100 cases
  double max_abs = 0;                    // the largest of them: the picture's is no smaller
  double display = 0;                    // what 99 % of the display values of them are not further off than
};

WitnessError witnesses_compare(const Witnesses& witnesses, const Frame& frame, const Image& picture);
// Of what is shown at each draw, beside the mean of the picture.
WitnessError witnesses_compare(const Witnesses& witnesses, const std::vector<std::array<double, 3>>& shown,
                               double mean);

// What chance adds to a picture, from the second moments of its pixels: the standard error of rel_rmse's kind. 0 below
// 2 samples per pixel. Where the samples of a pixel differ for other reasons too (edges), it is too large.
double film_noise(const Film& film, const Frame& frame);

// Whether a plan leaves anything to chance.
bool plan_is_random(const RenderPlan& plan);

}  // namespace brume
