// How far kernels (float) may be from the scalar reference (double), in one table, each with its reason. `brume check`
// prints it, tests use it. error = |kernel - reference| / (|reference| + floor); a check passes while its largest error
// stays within `limit`.
#pragma once
#include <string_view>

namespace brume {

struct Tolerance {
  std::string_view name;
  double limit, floor;
  std::string_view reason;
};

// Edges are pixels (or rays) with another hit or shadow, and those whose value the reference itself changes by more
// than the limit when the ray moves by four digits of float (ray_moves.hpp). More than this share of a row is an
// error.
inline constexpr double EDGE_SHARE = 5e-4;

inline constexpr Tolerance TOLERANCES[] = {
    {"layout", 0, 1, "sizes of shared structs and offsets of their fields are equal"},
    {"rng", 0, 1, "integer arithmetic: equal bits"},
    {"camera", 1e-6, 1, "a normalize (5 ulp) and the film position (3 ulp)"},
    {"phase", 1e-4, 0, "unit vectors carry 1 ulp each; at g = 0.99 the lobe turns that into 1e-5 of its value"},
    {"hit", 1e-5, 1, "t of a quadratic or an affine map: some 50 ulp of the scene's size"},
    {"surface", 2e-4, 1, "normal and uv at a point that carries the error of t; uv of a sphere near its poles"},
    {"material", 2e-5, 0.1,
     "unit vectors carry 1 ulp each, the lobe's cosine some 5; raised to the shininess, 20, it carries 20 times that"},
    {"fresnel", 2e-5, 0.1, "near total reflection a root of 1e-4 carries 1e2 ulp of the angle"},
    {"texture", 3e-5, 0.1,
     "weights carry the error of uv times the texture's size, 32 texels, and its repetitions, 1.5; then a gain"},
    {"light", 2e-5, 0.1,
     "a length, a division, a square; at a spot's soft edge the cosine's ulp over the width of the edge"},
    {"cells", 1e-4, 1, "a crossing carries 3 ulp of t, up to 5: 1e-6, and 50 times that for a ray almost along a face"},
    {"density", 5e-7, 0.25, "seven blends of 2 roundings each, with weights that are exact"},
    {"integral", 2e-6, 0.25,
     "both ends of the chord carry 1 ulp of t, which is up to 5; then a sum of up to 100 segments of 4 roundings each"},
    {"grazing", 3e-5, 0.25,
     "as integral, for a rotated box and a sphere: a ray almost along a face or tangent has its ends magnified"},
    {"scatter", 1e-4, 1e-2, "as image, along single rays"},
    {"image", 1e-4, 1e-2, "1e-4 relative + 1e-6 absolute at every pixel that sees the same surfaces and shadows"},
};

constexpr const Tolerance& tolerance(std::string_view name) {
  for (const Tolerance& row : TOLERANCES)
    if (row.name == name) return row;
  throw "no tolerance of that name";
}

}  // namespace brume
