// Closed forms of surfaces: inverse square, cosine, highlight. The derivations open the scenes.
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/closed_form.hpp"

namespace brume::test {
namespace {

TEST(SurfaceForms, InverseSquareAndCosineOnLambert) {
  expect_closed_form("lambert.json", [](const PlannedScene&, const reference::RayD& ray) {
    const double d2 = 1 + ray.origin.x * ray.origin.x + ray.origin.z * ray.origin.z;
    return 0.75 / M_PI * 4 / d2 / std::sqrt(d2);
  });
}

TEST(SurfaceForms, BlinnPhongHighlight) {
  expect_closed_form("blinn_phong.json", [](const PlannedScene& scene, const reference::RayD& ray) {
    const Packed3& l = scene.lights[0].direction;
    const dvec3 to_light = -glm::normalize(dvec3(l.x, l.y, l.z));
    if (ray.dir.y >= 0) return 0.0;  // above the horizon
    return 2 * 0.5 * std::pow(std::max(0.0, glm::normalize(to_light - ray.dir).y), 32);
  });
}

TEST(SurfaceForms, PhongHighlight) {
  expect_closed_form("blinn_phong.json",
                     [](const PlannedScene& scene, const reference::RayD& ray) {
                       const Packed3& l = scene.lights[0].direction;
                       const dvec3 to_light = -glm::normalize(dvec3(l.x, l.y, l.z));
                       if (ray.dir.y >= 0) return 0.0;
                       const dvec3 mirrored(-to_light.x, to_light.y, -to_light.z);
                       return 2 * 0.5 * std::pow(std::max(0.0, glm::dot(mirrored, -ray.dir)), 32);
                     },
                     {"/materials/shiny/model=phong"});
}

}  // namespace
}  // namespace brume::test
