// Hits of the reference against numbers derived by hand: outside, inside, tangent, axis-parallel, edges, order.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/intersect.hpp"
#include "reference/sampling.hpp"
#include "unit/plan/flat_scene_builder.hpp"

namespace brume::reference {
namespace {

using test::shape_add;

struct Case {
  const char* name;
  dvec3 origin, dir;
  double t;  // INFINITE for a miss
};

void expect_hits(const PlannedScene& scene, std::initializer_list<Case> cases) {
  for (const Case& c : cases) {
    const HitD hit = nearest_hit(scene, RayD{c.origin, vec_unit(c.dir)});
    EXPECT_EQ(hit.primitive == PRIMITIVE_NONE, c.t == INFINITE) << c.name;
    if (c.t < INFINITE)
      EXPECT_NEAR(hit.t, c.t, 1e-13) << c.name;
    else
      EXPECT_EQ(hit.t, INFINITE) << c.name;
  }
}

TEST(ReferenceShapes, Sphere) {
  PlannedScene scene;
  shape_add(scene, SHAPE_SPHERE, {1, 0, 0, 2});
  expect_hits(scene, {{"front", {5, 0, 0}, {-1, 0, 0}, 2},
                      {"inside", {1, 0, 0}, {0, 1, 0}, 2},
                      {"inside off centre", {2, 0, 0}, {-1, 0, 0}, 3},
                      {"behind", {5, 0, 0}, {1, 0, 0}, INFINITE},
                      {"tangent", {-4, 2, 0}, {1, 0, 0}, 5},
                      {"just past the tangent", {-4, 2 + 1e-12, 0}, {1, 0, 0}, INFINITE},
                      {"on the surface, outwards", {3, 0, 0}, {1, 0, 0}, INFINITE},
                      {"on the surface, inwards", {3, 0, 0}, {-1, 0, 0}, 4},
                      {"3-4-5 triangle", {-4, 1.2, 0}, {1, 0, 0}, 3.4}});
}

TEST(ReferenceShapes, ClosedCylinder) {
  PlannedScene scene;
  shape_add(scene, SHAPE_CYLINDER, {0, 1, 0, 0, 1, 0, 2, 0.5, 1, 0, 0});  // y in [1,3], radius 1/2
  expect_hits(scene, {{"side", {4, 2, 0}, {-1, 0, 0}, 3.5},
                      {"top cap along the axis", {0.25, 7, 0}, {0, -1, 0}, 4},
                      {"base cap from below", {0, -1, 0.25}, {0, 1, 0}, 2},
                      {"inside to the side", {0, 2, 0}, {0, 0, 1}, 0.5},
                      {"inside to the cap", {0.25, 2, 0.25}, {0, 1, 0}, 1},
                      {"above", {4, 3.001, 0}, {-1, 0, 0}, INFINITE},
                      {"beside, parallel to the axis", {0.6, 7, 0}, {0, -1, 0}, INFINITE},
                      {"tangent to the side", {-2, 2, 0.5}, {1, 0, 0}, 2},
                      {"through the cap to the side", {0, 4, 0}, {0.5, -2, 0}, std::hypot(0.25, 1)},
                      {"oblique, leaves by the side", {0, 2, 0}, {1, 1, 0}, std::sqrt(0.5)}});
}

TEST(ReferenceShapes, PlaneAndQuad) {
  PlannedScene plane;
  shape_add(plane, SHAPE_PLANE, {0, 1, 0, 0, 1, 0, 1, 0, 0});
  expect_hits(plane, {{"from above", {9, 3, 9}, {0, -1, 0}, 2},
                      {"from below", {9, -3, 9}, {0, 1, 0}, 4},
                      {"parallel", {0, 3, 0}, {1, 0, 0}, INFINITE},
                      {"within", {0, 1, 0}, {1, 0, 0}, INFINITE},
                      {"away", {0, 3, 0}, {0, 1, 0}, INFINITE},
                      {"oblique", {0, 2, 0}, {3, -4, 0}, 1.25}});
  PlannedScene quad;  // corner (0,0,0), u = (2,0,0), v = (1,2,0)
  shape_add(quad, SHAPE_QUAD, {0, 0, 0, 0, 0, 1, 0.5, -0.25, 0, 0, 0.5, 0});
  expect_hits(quad, {{"middle", {1.5, 1, 3}, {0, 0, -1}, 3},
                     {"left of the slanted edge", {0.25, 1, 3}, {0, 0, -1}, INFINITE},
                     {"right of the slanted edge", {0.75, 1, 3}, {0, 0, -1}, 3},
                     {"corner", {0, 0, 3}, {0, 0, -1}, 3},
                     {"far corner", {3, 2, -3}, {0, 0, 1}, 3},
                     {"within its plane", {-1, 1, 0}, {1, 0, 0}, INFINITE}});
}

TEST(ReferenceShapes, Box) {
  PlannedScene scene;  // world [-1,1] x [-1,1] x [-2,2]: unit = (x+1)/2, (y+1)/2, (z+2)/4
  shape_add(scene, SHAPE_BOX, {0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.25, 0.5});
  expect_hits(scene, {{"front", {0, 0, 5}, {0, 0, -1}, 3},
                      {"inside", {0, 0, 1}, {0, 0, -1}, 3},
                      {"inside, other way", {0.5, 0, 0}, {1, 0, 0}, 0.5},
                      {"beside", {1.001, 0, 5}, {0, 0, -1}, INFINITE},
                      {"along a face", {1, 0, 5}, {0, 0, -1}, 3},
                      {"along an edge", {1, 1, 5}, {-0.0, -0.0, -1}, 3},
                      {"corner to corner", {2, 2, 3}, {-1, -1, -1}, std::sqrt(3.0)},
                      {"behind", {0, 0, 5}, {0, 0, 1}, INFINITE},
                      {"on a face, inwards", {-1, 0, 0}, {1, 0, 0}, 2}});
}

TEST(ReferenceShapes, TrianglesAndBarycentrics) {
  PlannedScene scene;
  test::triangle_add(scene, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  const HitD hit = nearest_hit(scene, RayD{{1, 2, 5}, {0, 0, -1}});
  EXPECT_EQ(hit.primitive, FIRST_TRIANGLE);
  EXPECT_DOUBLE_EQ(hit.t, 5);
  EXPECT_DOUBLE_EQ(hit.u, 0.25);
  EXPECT_DOUBLE_EQ(hit.v, 0.5);
  expect_hits(scene, {{"from behind", {1, 1, -2}, {0, 0, 1}, 2},
                      {"hypotenuse", {2, 2, 1}, {0, 0, -1}, 1},
                      {"vertex", {4, 0, 1}, {0, 0, -1}, 1},
                      {"beyond the hypotenuse", {2.001, 2, 1}, {0, 0, -1}, INFINITE},
                      {"within its plane", {-1, 1, 0}, {1, 0, 0}, INFINITE}});
  PlannedScene degenerate;
  test::triangle_add(degenerate, {0, 0, 0}, {1, 1, 0}, {2, 2, 0});
  expect_hits(degenerate, {{"degenerate", {1, 1, 1}, {0, 0, -1}, INFINITE}});
}

TEST(ReferenceShapes, NearestWinsAndTheFirstOfEquals) {
  PlannedScene scene;
  shape_add(scene, SHAPE_SPHERE, {0, 0, -4, 1});
  shape_add(scene, SHAPE_SPHERE, {0, 0, 0, 1});
  shape_add(scene, SHAPE_SPHERE, {0, 0, 0, 1});
  test::triangle_add(scene, {-1, -1, -2}, {1, -1, -2}, {0, 1, -2});
  EXPECT_EQ(nearest_hit(scene, RayD{{0, 0, 5}, {0, 0, -1}}).primitive, 1);
  EXPECT_EQ(nearest_hit(scene, RayD{{0, 0, -1.5}, {0, 0, -1}}).primitive, FIRST_TRIANGLE);
  EXPECT_TRUE(occluded(scene, RayD{{0, 0, 5}, {0, 0, -1}}, 4.001));
  EXPECT_FALSE(occluded(scene, RayD{{0, 0, 5}, {0, 0, -1}}, 4));  // t < distance
}

TEST(ReferenceShapes, BoundsOfTriangleRunsNeverChangeAHit) {
  PlannedScene scene;
  uint n = 0;
  const auto random = [&] { return 2 * rng_uniform(n++, 0, 0, 7) - 1; };
  const auto point = [&] {
    const double x = random(), y = random();
    return dvec3(x, y, random());
  };
  for (int i = 0; i < 200; ++i) {
    const dvec3 p = point();
    test::triangle_add(scene, p, p + 0.2 * point(), p + 0.2 * point());
  }
  scene.meshes.push_back({120, 80});
  for (int i = 0; i < 4; ++i) {
    Instance instance{};
    for (int row = 0; row < 3; ++row)
      for (int k = 0; k < 4; ++k)
        instance.world_from_mesh.m[4 * row + k] = static_cast<float>(0.4 * random() + (row == k ? 0.7 : 0));
    scene.instances.push_back(instance);
  }
  const TriangleBounds bounds(scene);
  int hits = 0, of_instances = 0;
  for (int i = 0; i < 500; ++i) {
    const dvec3 from = 2.0 * point();
    const RayD ray{from, i % 5 ? vec_unit(0.5 * point() - from) : dvec3(0, from.y > 0 ? -1 : 1, 0)};
    const HitD plain = nearest_hit(scene, ray), skipping = nearest_hit(scene, bounds, ray);
    EXPECT_EQ(plain.primitive, skipping.primitive);
    EXPECT_EQ(plain.instance, skipping.instance);
    EXPECT_EQ(plain.t, skipping.t);
    of_instances += plain.instance != INSTANCE_NONE;
    hits += plain.primitive != PRIMITIVE_NONE;
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(of_instances, 20);
}

}  // namespace
}  // namespace brume::reference
