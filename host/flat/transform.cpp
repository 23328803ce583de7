// See transform.hpp.
#include "flat/transform.hpp"

#define GLM_ENABLE_EXPERIMENTAL
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace brume {

namespace {

struct StepMatrix {
  dmat4 operator()(const Scale& s) const { return glm::scale(dmat4(1.0), s.factor); }
  dmat4 operator()(const Rotate& r) const {
    return glm::rotate(dmat4(1.0), glm::radians(r.degrees), glm::normalize(r.axis));
  }
  dmat4 operator()(const Translate& t) const { return glm::translate(dmat4(1.0), t.offset); }
};

}  // namespace

dmat4 transform_matrix(const TransformDesc& transform) {
  dmat4 m(1.0);
  for (const auto& step : transform) m = std::visit(StepMatrix{}, step) * m;
  return m;
}

dvec3 transform_point(const dmat4& m, const dvec3& p) { return dvec3(m * glm::dvec4(p, 1.0)); }
dvec3 transform_dir(const dmat4& m, const dvec3& d) { return dvec3(m * glm::dvec4(d, 0.0)); }

Packed3 packed(const dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

Affine affine(const dmat4& m) {
  Affine a;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) a.m[4 * row + column] = static_cast<float>(m[column][row]);
  return a;
}

dmat4 matrix(const Affine& a) {
  dmat4 m(1.0);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) m[column][row] = a.m[4 * row + column];
  return m;
}

dmat4 flat_from(const FlatScene& scene, dmat4 m) {
  m[3] -= glm::dvec4(scene.origin, 0.0);
  for (int column = 0; column < 4; ++column) m[column] = glm::dvec4(dvec3(m[column]) / scene.unit, m[column].w);
  return m;
}

dvec3 tangent(const dvec3& n) {
  const dvec3 along = std::abs(n.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
  return glm::normalize(along - glm::dot(along, n) * n);
}

}  // namespace brume
