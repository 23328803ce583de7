// The surface at a hit: normals, texture coordinates, colours, and how it reflects one light.
// Shadows and media are no business of this file.
#pragma once
#include "plan/render_plan.hpp"
#include "reference/intersect.hpp"

namespace brume::reference {

struct SurfaceD {
  dvec3 point{0};
  dvec3 geometric_normal{0};  // unit, faces the viewer
  dvec3 normal{0};            // unit shading normal, flipped together with the geometric one
  dvec3 diffuse{0};           // material diffuse times texture
  dvec3 emission{0};          // material emission times its texture
  dvec2 uv{0};
  int material = 0;
  bool leaving = false;    // hit from inside: from the side to which the shape's own normal does not point
  int second = 0;          // 1 in the second part of its texture, see texture_second
  double ray_epsilon = 0;  // offset along the geometric normal of rays that leave this point
};

// `hit` must be a hit of `ray`, not a miss.
SurfaceD surface_at(const PlannedScene& scene, const RayD& ray, const HitD& hit);

// Where the light of a hit is asked for, and what each counts: there, or of a triangle that blends the light of its
// corners [Gouraud71] at these, with the colours of the hit.
struct CornerD {
  SurfaceD surface;
  double share;
};
std::vector<CornerD> surface_corners(const PlannedScene& scene, const SurfaceD& surface, const HitD& hit);

// Origin of a ray that leaves the surface in direction `dir`.
dvec3 surface_leave(const SurfaceD& surface, const dvec3& dir);

// Linear RGB of texture `texture` (an index into PlannedScene::textures).
dvec3 texture_lookup(const PlannedScene& scene, int texture, const dvec2& uv);
// 1 where uv lies in the second colour of a checker, or beside an image that is shown once; 0 elsewhere.
int texture_second(const Texture& texture, const dvec2& uv);

// Radiance towards -view_dir for irradiance E = 1 of light that travels along `travel`; 0 from behind the shading
// normal.
dvec3 surface_reflect(const PlannedScene& scene, const SurfaceD& surface, const dvec3& view_dir, const dvec3& travel);

}  // namespace brume::reference
