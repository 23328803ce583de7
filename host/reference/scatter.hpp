// Light on its way: how much of each light reaches a point through surfaces and media, and what the media along a view
// ray scatter towards its origin (single scattering).
#pragma once
#include <vector>

#include "reference/intersect.hpp"
#include "reference/light.hpp"
#include "reference/medium.hpp"
#include "reference/quadrature.hpp"

namespace brume::reference {

struct Options {
  // 0: the segment rule of PICTURE.md with the method of each medium. n > 0: the exact picture: n-point
  // Gauss-Legendre of σs ρ(t) T(t) S(t) between all cell borders, with the exact method of every medium whatever it
  // says.
  int scatter_order = 0;
  int threads = 0;  // 0: as many as the machine has
};

// τ of all media from the points of a medium's light grids to each light (shared/light_grid.h).
struct LightDepths {
  std::vector<std::vector<dvec3>> tau;  // [light][point]
};

// What all samples share.
struct Context {
  Context(const PlannedScene& flat, const Options& options);

  const PlannedScene& scene;
  std::vector<Medium> media;  // its media with everything about them
  TriangleBounds bounds;
  std::vector<QuadratureNode> nodes;      // empty for the segment rule
  std::vector<LightDepths> light_depths;  // one per medium, empty where light is traced
  bool exact() const { return !nodes.empty(); }
  int method(const Medium& medium) const { return exact() ? method_exact(medium) : medium.method; }
};

dvec3 sigma_t_of(const Medium& medium);
dvec3 transmittance_of(const dvec3& tau);  // exp(-τ) per channel
dvec3 tau_of(const dvec3& transmittance);  // -log T per channel

// τ per channel of all media over [0, t_max].
dvec3 media_tau(const Context& context, const RayD& ray, double t_max, const RandomStream& random, double& lookups);

// The same without one of them.
dvec3 media_tau_beside(const Context& context, int medium, const RayD& ray, double t_max, const RandomStream& random,
                       double& lookups);

// As in the kernels: what is left is less than e^-24 in every channel.
bool is_black(const dvec3& transmittance);

// One light at a point. `ray_origin` is the point itself, or the point lifted off the surface on which it lies.
struct Arrival {
  LightSample light;
  bool blocked;      // by a surface
  dvec3 irradiance;  // E·V·T_light
};
// `places` are the numbers of the ray, for lights with an area; `random` is that of the shadow ray. media: τ of all
// media to the light where it is known already.
Arrival light_arrival(const Context& context, std::size_t light, const dvec3& point, const dvec3& ray_origin,
                      const RandomStream& places, const RandomStream& random, double& lookups,
                      const dvec3* media = nullptr);

// Whether a light without media in between shines on a point: E·V ≠ 0.
bool light_shines(const Context& context, const Light& light, const dvec3& point, const RandomStream& places);

struct Scattered {
  dvec3 radiance{0};    // as it arrives at the ray's origin
  dvec3 tau{0};         // of all media up to t_max
  uint shadow_key = 0;  // by the segment rule only; 0 in exact pictures, which have no such samples
  double lookups = 0;
  double error = 0, tau_error = 0;  // estimates of `adaptive`: of the radiance, mean of the channels, and of tau
};
Scattered media_scatter(const Context& context, const RayD& ray, double t_max, const RandomStream& random);

}  // namespace brume::reference
