// Transforms of scene files: the steps in the order written, rotations right-handed, points moved and directions not.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "flat/transform.hpp"

namespace brume {
namespace {

void expect_near(const dvec3& a, const dvec3& b) {
  EXPECT_LT(glm::distance(a, b), 1e-12) << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " "
                                        << b.z;
}

dvec3 moved(const TransformDesc& steps, const dvec3& p) { return transform_point(transform_matrix(steps), p); }

TEST(Transform, NoStepsChangeNothing) { expect_near(moved({}, {1, 2, 3}), {1, 2, 3}); }

TEST(Transform, EachStepAlone) {
  expect_near(moved({Scale{{2, 3, -4}}}, {1, 2, 3}), {2, 6, -12});
  expect_near(moved({Translate{{10, 20, 30}}}, {1, 2, 3}), {11, 22, 33});
}

// Counterclockwise for who looks against the axis: x → y about z, y → z about x, z → x about y.
TEST(Transform, RotationsAreRightHanded) {
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  expect_near(moved({Rotate{z, 90}}, x), y);
  expect_near(moved({Rotate{x, 90}}, y), z);
  expect_near(moved({Rotate{y, 90}}, z), x);
  expect_near(moved({Rotate{z, -90}}, y), x);
  expect_near(moved({Rotate{z, 30}}, x), {std::sqrt(3) / 2, 0.5, 0});
  expect_near(moved({Rotate{{1, 1, 1}, 120}}, {1, 2, 3}), {3, 1, 2});  // x → y → z → x
  expect_near(moved({Rotate{z, 360}}, {1, 2, 3}), {1, 2, 3});
}

TEST(Transform, TheAxisNeedNotBeUnit) {
  expect_near(moved({Rotate{{0, 0, 7}, 90}}, {1, 0, 0}), {0, 1, 0});
  expect_near(moved({Rotate{{0, -0.01, 0}, 90}}, {0, 0, 1}), {-1, 0, 0});
}

TEST(Transform, StepsApplyInTheOrderWritten) {
  const Scale twice{{2, 2, 2}};
  const Rotate turn{{0, 0, 1}, 90};
  const Translate shift{{10, 0, 0}};
  const dvec3 p(1, 0, 0);
  expect_near(moved({twice, turn, shift}, p), {10, 2, 0});
  expect_near(moved({twice, shift, turn}, p), {0, 12, 0});
  expect_near(moved({shift, twice, turn}, p), {0, 22, 0});
  expect_near(moved({shift, turn, twice}, p), {0, 22, 0});
  expect_near(moved({turn, shift, twice}, p), {20, 2, 0});
  expect_near(moved({Scale{{1, 5, 1}}, turn}, {1, 1, 0}), {-5, 1, 0});
  expect_near(moved({turn, Scale{{1, 5, 1}}}, {1, 1, 0}), {-1, 5, 0});
  expect_near(moved({turn, turn, shift, shift}, p), {19, 0, 0});
}

TEST(Transform, DirectionsAreNotTranslated) {
  const dmat4 m = transform_matrix({Translate{{10, 20, 30}}, Rotate{{0, 0, 1}, 90}, Scale{{1, 3, 1}}});
  expect_near(transform_dir(m, {1, 0, 0}), {0, 3, 0});
  expect_near(transform_dir(m, {0, 0, 0}), {0, 0, 0});
  expect_near(transform_point(m, {0, 0, 0}), {-20, 30, 30});
}

// Row by row, translation in the fourth column: kernels read it so.
TEST(Transform, AffineHoldsTheUpperThreeRows) {
  const Affine a = affine(transform_matrix({Scale{{2, 3, 4}}, Rotate{{0, 0, 1}, 90}, Translate{{5, 6, 7}}}));
  const float expected[12] = {0, -3, 0, 5, 2, 0, 0, 6, 0, 0, 4, 7};
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(a.m[i], expected[i], 1e-6) << i;
}

TEST(Transform, PackedKeepsTheOrder) {
  const Packed3 p = packed({1, 2, 3});
  EXPECT_EQ(p.x, 1);
  EXPECT_EQ(p.y, 2);
  EXPECT_EQ(p.z, 3);
}

TEST(Transform, TangentsAreUnitAndPerpendicular) {
  for (const dvec3 v : {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, -1), dvec3(1, 1e-9, 0),
                        dvec3(0.9, 0.3, 0.1), dvec3(1, 1, 1), dvec3(-3, 0.1, 0.2)}) {
    const dvec3 n = glm::normalize(v), t = tangent(n);
    EXPECT_NEAR(glm::length(t), 1, 1e-12);
    EXPECT_NEAR(glm::dot(t, n), 0, 1e-12);
  }
  expect_near(tangent({0, 0, 1}), {1, 0, 0});
  expect_near(tangent({1, 0, 0}), {0, 0, 1});
}

}  // namespace
}  // namespace brume
