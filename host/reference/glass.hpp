// Shapes that refract: what a ray is inside of, and what light that passes them straight on keeps.
#pragma once
#include <vector>

#include "reference/intersect.hpp"
#include "reference/surface.hpp"

namespace brume::reference {

// Materials that something is inside of, the last entered at the back.
class Inside {
 public:
  // Through a surface that refracts. False where it leaves what it was not inside of.
  bool cross(const SurfaceD& surface);
  void enter(int material);
  int innermost() const { return materials_.empty() ? -1 : materials_.back(); }

 private:
  std::vector<int> materials_;
};

// exp(-absorption * length) of a material; 1 for material -1, none.
dvec3 absorbed(const PlannedScene& scene, int material, double length);

// Fresnel's reflectance of unpolarised light; eta: index of refraction of the ray's side over that of the other.
double fresnel(double cosine, double eta);

// What a ray that follows `ray` straight on begins inside of.
Inside inside_of(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray);

// What surfaces leave of light on its way over `distance` against the ray, which begins `gap` before the point.
dvec3 light_passes(const PlannedScene& scene, const TriangleBounds& bounds, const RayD& ray, double distance,
                   double gap = 0);

}  // namespace brume::reference
