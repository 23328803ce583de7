// Closed forms of water: the sphere in the presence of a ball, Snell and Fresnel, a flat pool.
#include <cmath>
#include <glm/geometric.hpp>

#include "check/check_parts.hpp"
#include "physics/closed_form.hpp"
#include "reference/glass.hpp"

namespace brume::test {
namespace {

constexpr double WATER = 1.33f;  // as scenes hold it

TEST(WaterForms, FresnelByTheTextbook) {
  for (const double eta : {1 / 1.33, 1.33, 1 / 1.5, 1.5}) {  // from outside and from inside
    for (int degree = 1; degree < 90; ++degree) {
      const double i = degree * M_PI / 180, sine = eta * std::sin(i), f = reference::fresnel(std::cos(i), eta);
      if (sine >= 1) {
        EXPECT_EQ(f, 1) << degree;
        continue;
      }
      const double t = std::asin(sine), s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
      EXPECT_NEAR(f, (s * s + p * p) / 2, 1e-13) << degree;
    }
    EXPECT_NEAR(reference::fresnel(1, eta), std::pow((eta - 1) / (eta + 1), 2), 1e-16);
    EXPECT_EQ(reference::fresnel(0, eta), 1);
  }
  EXPECT_NEAR(reference::fresnel(0.3, 1), 0, 1e-30);  // no interface
}

TEST(WaterForms, APoolShowsItsFloorAtTheRefractedPlace) {
  constexpr double depth = 0.625, absorption = 0.75;
  expect_closed_form(
      "pool.json",
      [](const PlannedScene&, const reference::RayD& ray) {
        const double cos_i = -ray.dir.y, sin_i = std::sqrt(1 - cos_i * cos_i), sin_t = sin_i / WATER,
                     cos_t = std::sqrt(1 - sin_t * sin_t);
        const dvec3 met = ray.at(ray.origin.y / cos_i);
        const dvec3 along = sin_i > 0 ? dvec3(ray.dir.x, 0, ray.dir.z) / sin_i : dvec3(0);
        const dvec3 place = met + depth * (sin_t / cos_t) * along;
        const bool second = static_cast<int>(std::floor(8 * place.x) + std::floor(8 * place.z)) % 2 != 0;
        const double mirrored = reference::fresnel(cos_i, 1 / WATER), upright = reference::fresnel(1, 1 / WATER);
        const double floor = (second ? 0.25 : 0.875) / M_PI * 3 * (1 - upright) * std::exp(-depth * absorption);
        return mirrored * 0.5 + (1 - mirrored) * std::exp(-depth * absorption / cos_t) * floor;
      },
      {}, 0, 2e-6);  // refracted rays begin 2^-17 aside of where they are met (PICTURE, Hits)
}

// How far off the surface and its normal in the presence of a ball are from the sphere, in the mean.
struct Off {
  double place = 0, normal = 0;
};
Off ball_off(int resolution) {
  const std::string n = std::to_string(resolution);
  const std::string text = R"({"shapes": [{"type": "isosurface", "density": {"type": "ball", "radius": 0.7, "ramp": 6,
    "resolution": [)" + n + "," +
                           n + "," + n + R"(]}}]})";
  const PlannedScene scene = flatten(scene_read_text(text, "ball.json", {}), {bvh_width_for(16), {}});
  CheckRandom random;
  std::vector<float> in;
  std::vector<reference::RayD> rays;
  while (rays.size() < 2000) {
    const dvec3 from = 1.7 * random.direction(), to = 0.5 * random.direction();
    rays.push_back({dvec3(glm::vec3(from)), dvec3(glm::vec3(glm::normalize(to - from)))});
    push3(in, rays.back().origin);
    push3(in, rays.back().dir);
    in.push_back(INFINITY);
  }
  const Probe probe(pocl(), scene, 16);
  const std::vector<float> hits = probe.run("probe_hit", in, 7, 5);
  std::vector<float> at;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    at.insert(at.end(), in.begin() + 7 * i, in.begin() + 7 * i + 6);
    at.insert(at.end(), hits.begin() + 5 * i, hits.begin() + 5 * i + 5);
  }
  const std::vector<float> surfaces = probe.run("probe_surface", at, 11, 8);
  Off off;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const dvec3 point = rays[i].at(hits[5 * i]);
    const float* normal = &surfaces[8 * i + 3];
    off.place += std::abs(glm::length(point) - 0.7) / rays.size();
    off.normal += glm::length(dvec3(normal[0], normal[1], normal[2]) - glm::normalize(point)) / rays.size();
  }
  return off;
}

TEST(WaterForms, ABallIsASphereToSecondOrder) {
  Off before = ball_off(20);
  for (const int resolution : {40, 80}) {
    const Off off = ball_off(resolution);
    EXPECT_NEAR(std::log2(before.place / off.place), 2, 0.25) << resolution << ": " << off.place;
    EXPECT_NEAR(std::log2(before.normal / off.normal), 2, 0.25) << resolution << ": " << off.normal;
    before = off;
  }
}

}  // namespace
}  // namespace brume::test
