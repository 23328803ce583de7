// Density lookups, segments and optical depths of the reference against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/medium.hpp"
#include "reference/quadrature.hpp"
#include "unit/plan/flat_scene_builder.hpp"

namespace brume::reference {
namespace {

RayD ray_of(const dvec3& origin, const dvec3& dir) { return {origin, vec_unit(dir)}; }

PlannedScene grid_scene(const ivec3& cells, int interpolation, const std::function<double(ivec3)>& density) {
  PlannedScene scene;
  test::medium_add_grid(scene, cells, interpolation, density, 1, 0);
  return scene;
}

TEST(ReferenceDensity, NearestIsOneValuePerCell) {
  const auto value = [](ivec3 s) { return s.x + 32 * s.y + 1024 * s.z; };
  const PlannedScene scene = grid_scene({12, 17, 9}, INTERPOLATION_NEAREST, value);  // 2 x 3 x 2 bricks
  for (const ivec3& c : {ivec3(0), ivec3(7, 3, 8), ivec3(8, 9, 0), ivec3(3, 16, 2), ivec3(11, 16, 8)})
    for (const double inside : {0.0, 0.5, 0.999})
      EXPECT_EQ(density_at(scene, scene.medium(0), dvec3(c) + inside), value(c));
  EXPECT_EQ(density_at(scene, scene.medium(0), {12, 17, 9}), value({11, 16, 8}));  // the upper border
}

TEST(ReferenceDensity, TrilinearReproducesAMultilinearField) {
  const auto field = [](const dvec3& p) { return 1 + p.x + 2 * p.y * p.z + 3 * p.x * p.y * p.z; };
  const PlannedScene scene = grid_scene({12, 10, 9}, INTERPOLATION_TRILINEAR, [&](ivec3 s) { return field(dvec3(s)); });
  for (const dvec3& p : {dvec3(0), dvec3(0.25, 7.5, 3.125), dvec3(7.75, 8, 8.5), dvec3(8, 8, 8), dvec3(12, 10, 9)})
    EXPECT_NEAR(density_at(scene, scene.medium(0), p), field(p), 1e-12 * field(p));
}

TEST(ReferenceDensity, EmptyBricksAreZero) {
  const PlannedScene scene = grid_scene({16, 8, 8}, INTERPOLATION_NEAREST, [](ivec3 s) { return s.x > 8 ? 2 : 0; });
  ASSERT_EQ(brick_number(scene, scene.medium(0), {0, 0, 0}), BRICK_EMPTY);
  EXPECT_EQ(density_at(scene, scene.medium(0), {3, 3, 3}), 0);
  EXPECT_DOUBLE_EQ(optical_depth(scene, 0, ray_of({-1, 4.5, 4.5}, {1, 0, 0}), INFINITE, METHOD_DDA_NEAREST), 14);
}

TEST(ReferenceDensity, ConstantGridEqualsHomogeneous) {
  PlannedScene scene = grid_scene({8, 8, 8}, INTERPOLATION_TRILINEAR, [](ivec3) { return 0.75; });
  test::medium_add_constant(scene, dvec3(0), dvec3(8), 1, 0, 0.75);
  const RayD ray = ray_of({-3, -2, -1}, {5, 4, 3});
  const double expected = optical_depth(scene, 1, ray, 8, METHOD_HOMOGENEOUS);
  EXPECT_GT(expected, 1);
  for (const int method : {METHOD_DDA_NEAREST, METHOD_DDA_GAUSS2, METHOD_DDA_MIDPOINT, METHOD_MARCH_MIDPOINT}) {
    EXPECT_NEAR(optical_depth(scene, 0, ray, 8, method), expected, 1e-12 * expected) << method;
    EXPECT_NEAR(optical_depth(scene, 1, ray, 8, method), expected, 1e-12 * expected) << method;
  }
}

TEST(ReferenceOpticalDepth, SphereChord) {
  PlannedScene scene;
  test::medium_add_constant(scene, dvec3(-2), dvec3(2), 1, 0).placed.region = REGION_SPHERE;
  for (const double height : {0.0, 0.5, 1.5, 1.999})
    EXPECT_NEAR(optical_depth(scene, 0, ray_of({-9, height, 0}, {1, 0, 0}), INFINITE, METHOD_HOMOGENEOUS),
                2 * std::sqrt(4 - height * height), 1e-13);
  EXPECT_EQ(optical_depth(scene, 0, ray_of({-9, 2, 0}, {1, 0, 0}), INFINITE, METHOD_HOMOGENEOUS), 0);
  EXPECT_NEAR(optical_depth(scene, 0, ray_of({0, 0, 0}, {1, 1, 1}), INFINITE, METHOD_HOMOGENEOUS), 2, 1e-14);
  scene.placed[0].hi = test::packed(2, 2, 6);  // an ellipsoid of half axes 2, 2, 4 about (0, 0, 2)
  EXPECT_NEAR(optical_depth(scene, 0, ray_of({0, 0, 9}, {0, 0, -1}), INFINITE, METHOD_HOMOGENEOUS), 8, 1e-13);
}

TEST(ReferenceOpticalDepth, RampAlongObliqueRaysIsExactWithGauss2) {
  const PlannedScene scene = grid_scene({12, 10, 9}, INTERPOLATION_TRILINEAR, [](ivec3 s) { return s.y; });
  for (const dvec3& dir : {dvec3(1, 1, 1), dvec3(3, -1, 0.5), dvec3(-0.01, 1, 0), dvec3(1, 0, 0), dvec3(0, -1, 0)}) {
    const RayD ray = ray_of({5.3, 4.7, 4.1}, dir);
    const Interval span = medium_interval(scene.medium(0), ray, 0, INFINITE);
    const double expected = (span.t1 - span.t0) * 0.5 * (ray.at(span.t0).y + ray.at(span.t1).y);
    EXPECT_NEAR(optical_depth(scene, 0, ray, INFINITE, METHOD_DDA_GAUSS2), expected, 1e-12 * expected);
    EXPECT_NEAR(optical_depth(scene, 0, ray, INFINITE, METHOD_DDA_MIDPOINT), expected, 1e-12 * expected);
    EXPECT_NEAR(optical_depth(scene, 0, ray, INFINITE, METHOD_MARCH_MIDPOINT), expected, 1e-12 * expected);
  }
}

TEST(ReferenceOpticalDepth, CubicAlongARayInAScaledWorldIsExactWithGauss2) {
  // ρ = xyz in cell space, cells half a world unit wide and moved by one
  PlannedScene scene = grid_scene({12, 10, 9}, INTERPOLATION_TRILINEAR, [](ivec3 s) { return s.x * s.y * s.z; });
  scene.placed[0].cell_from_world = test::affine_scale(2, {2, 2, 2});
  const RayD ray = ray_of({-3, -1.5, -1}, {5, 3, 2});
  const Interval span = medium_interval(scene.medium(0), ray, 0, INFINITE);
  double expected = 0;
  for (const QuadratureNode& node : gauss_legendre(3)) {
    const dvec3 p = 2.0 * ray.at(span.t0 + node.x * (span.t1 - span.t0)) + 2.0;
    expected += node.weight * (span.t1 - span.t0) * p.x * p.y * p.z;
  }
  EXPECT_NEAR(optical_depth(scene, 0, ray, INFINITE, METHOD_DDA_GAUSS2), expected, 1e-12 * expected);
  EXPECT_GT(std::abs(optical_depth(scene, 0, ray, INFINITE, METHOD_DDA_MIDPOINT) / expected - 1), 1e-4);
}

TEST(ReferenceSegments, NearestByHand) {
  const PlannedScene scene = grid_scene({4, 4, 4}, INTERPOLATION_NEAREST, [](ivec3 s) { return 1 + s.x; });
  const std::vector<SegmentD> found = segments(scene, 0, RayD{{-1, 0.5, 0.5}, {1, 0, 0}}, 0, 3.25, METHOD_DDA_NEAREST);
  ASSERT_EQ(found.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const SegmentD& segment = found[static_cast<std::size_t>(i)];
    EXPECT_EQ(segment.t_begin, 1 + i);
    EXPECT_EQ(segment.t_end, std::min(2.0 + i, 3.25));
    EXPECT_EQ(segment.cell, ivec3(i, 0, 0));
    EXPECT_DOUBLE_EQ(segment.density_length, (1 + i) * (segment.t_end - segment.t_begin));
  }
}

TEST(ReferenceSegments, DiagonalsTieWithoutGarbage) {
  const PlannedScene scene = grid_scene({4, 4, 4}, INTERPOLATION_NEAREST, [](ivec3) { return 1; });
  for (const dvec3& dir : {dvec3(1, 1, 1), dvec3(1, 1, 0)}) {
    const std::vector<SegmentD> found = segments(scene, 0, ray_of({0, 0, 0}, dir), 0, INFINITE, METHOD_DDA_NEAREST);
    ASSERT_EQ(found.size(), 4u);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(found[static_cast<std::size_t>(i)].cell, i * ivec3(dir));
  }
}

TEST(ReferenceSegments, AlongFacesByTheHalfOpenRule) {
  const PlannedScene scene = grid_scene({4, 4, 4}, INTERPOLATION_NEAREST, [](ivec3 s) { return 1 + s.x; });
  for (const double zero : {0.0, -0.0}) {
    const auto depth = [&](double x) {
      return optical_depth(scene, 0, RayD{{x, 1, -1}, {zero, zero, 1}}, INFINITE, METHOD_DDA_NEAREST);
    };
    EXPECT_EQ(depth(0), 4 * 1);
    EXPECT_EQ(depth(2), 4 * 3);
    EXPECT_EQ(depth(4), 4 * 4);  // the upper border belongs to the last cell
    EXPECT_EQ(depth(4.001), 0);
    EXPECT_EQ(depth(-0.001), 0);
  }
}

// The chord of [0,4]³ by clipping a ray at 6 half spaces, one after another.
double chord(const RayD& ray) {
  double t0 = 0, t1 = INFINITE;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {  // sign·(x - 2) <= 2
      const double room = 2 - sign * (ray.origin[axis] - 2), speed = sign * ray.dir[axis];
      if (speed == 0 && room < 0) return 0;
      if (speed > 0) t1 = std::min(t1, room / speed);
      if (speed < 0) t0 = std::max(t0, room / speed);
    }
  return std::max(0.0, t1 - t0);
}

TEST(ReferenceSegments, OriginsOnCornersEdgesAndFacesInAllDirections) {
  const PlannedScene scene = grid_scene({4, 4, 4}, INTERPOLATION_NEAREST, [](ivec3) { return 1; });
  const double places[] = {-1, 0, 2, 2.5, 4, 5}, steps[] = {-1, -0.0, 0, 0.5, 1};
  for (const double x : places)
    for (const double y : places)
      for (const double z : places)
        for (const double dx : steps)
          for (const double dy : steps)
            for (const double dz : steps) {
              if (dx == 0 && dy == 0 && dz == 0) continue;
              const RayD ray = ray_of({x, y, z}, {dx, dy, dz});
              double length = 0, last = -1;
              for (const SegmentD& s : segments(scene, 0, ray, 0, INFINITE, METHOD_DDA_NEAREST)) {
                ASSERT_LT(s.t_begin, s.t_end);
                if (last >= 0) {
                  ASSERT_EQ(s.t_begin, last);
                }
                last = s.t_end;
                length += s.density_length;
              }
              ASSERT_NEAR(length, chord(ray), 1e-13) << x << y << z << " " << dx << dy << dz;
            }
}

TEST(ReferenceSegments, MarchCountsStepsWithATolerance) {
  PlannedScene scene;
  MediumWalk& walk = test::medium_add_constant(scene, dvec3(0), dvec3(4), 1, 0).walk;
  const auto count = [&](double step) {
    walk.step = static_cast<float>(step);
    return segments(scene, 0, RayD{{-1, 1, 1}, {1, 0, 0}}, 0, INFINITE, METHOD_MARCH_MIDPOINT).size();
  };
  EXPECT_EQ(count(1), 4u);
  EXPECT_EQ(count(4 / 7.0), 7u);     // whole but for rounding
  EXPECT_EQ(count(4 / 7.0005), 7u);  // within 1/1024 of it
  EXPECT_EQ(count(4 / 7.002), 8u);
  EXPECT_EQ(count(100), 1u);
  walk.step = 1.5f;
  const std::vector<SegmentD> found = segments(scene, 0, RayD{{-1, 1, 1}, {1, 0, 0}}, 0, INFINITE, METHOD_HOMOGENEOUS);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_DOUBLE_EQ(found[1].t_begin, 1 + 4 / 3.0);
  EXPECT_EQ(found[2].t_end, 5);
}

TEST(ReferenceSegments, LookupsAreCounted) {
  const PlannedScene scene = grid_scene({4, 4, 4}, INTERPOLATION_TRILINEAR, [](ivec3) { return 1; });
  double lookups = 0;
  optical_depth(scene, 0, RayD{{-1, 1.5, 1.5}, {1, 0, 0}}, INFINITE, METHOD_DDA_GAUSS2, &lookups);
  EXPECT_EQ(lookups, 8);
  optical_depth(scene, 0, RayD{{-1, 1.5, 1.5}, {1, 0, 0}}, INFINITE, METHOD_DDA_MIDPOINT, &lookups);
  EXPECT_EQ(lookups, 12);
}

}  // namespace
}  // namespace brume::reference
