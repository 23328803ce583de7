// Whole samples of the reference: slabs and single scattering in closed form, keys, film sums.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "reference/phase.hpp"
#include "reference/render.hpp"
#include "unit/plan/flat_scene_builder.hpp"

namespace brume::reference {
namespace {

const RayD VIEW{{0.5, 0.5, 8}, {0, 0, -1}};

// A slab 0 < z < 2 of constant density, seen along -z.
PlannedScene slab(double sigma_a, double sigma_s) {
  PlannedScene scene = test::scene_empty();
  test::medium_add_constant(scene, {-64, -64, 0}, {64, 64, 2}, sigma_a, sigma_s);
  return scene;
}

TEST(ReferenceSlab, TransmitsTheBackground) {
  for (const double tau : {0x1p-20, 1.0, 20.0, 80.0, 1e6}) {
    PlannedScene scene = slab(tau / 2, 0);
    scene.frame.background = test::grey(3);
    const double expected = std::exp(-static_cast<double>(scene.media[0].sigma_a.x) * 2);
    const PixelD pixel = pixel_render(Context(scene, {}), 0, 0);
    EXPECT_NEAR(pixel.transmittance.x, expected, 1e-13 * expected);
    EXPECT_NEAR(pixel.radiance.x, 3 * expected, 3e-13 * expected);
  }
}

TEST(ReferenceSlab, EndsAtASurface) {
  PlannedScene scene = slab(0.5, 0);
  test::shape_add(scene, SHAPE_PLANE, {0, 0, 0.5, 0, 0, 1, 1, 0, 0});
  scene.materials[0].emission = test::grey(1);
  const PixelD pixel = pixel_render(Context(scene, {}), 0, 0);
  EXPECT_NEAR(pixel.radiance.x, std::exp(-0.75), 1e-14);
  EXPECT_EQ(pixel.depth, 7.5);
  EXPECT_EQ(pixel.hits, 1);
  EXPECT_EQ(pixel.normal, dvec3(0, 0, 1));
}

TEST(ReferenceSlab, SingleScatteringLitFromTheFrontAndFromBehind) {
  for (const double g : {0.0, 0.5}) {
    const double a = 0.25, s = 0.75, t = a + s, depth = 2;
    PlannedScene scene = slab(a, s);
    scene.media[0].phase = PHASE_HENYEY_GREENSTEIN;
    scene.media[0].g = static_cast<float>(g);
    test::light_add_directional(scene, {0, 0, -1}, 5);  // travels with the view: reflected back
    const double back = phase_eval(PHASE_HENYEY_GREENSTEIN, g, -1), forward = phase_eval(PHASE_HENYEY_GREENSTEIN, g, 1);
    const Options exact{8, 1};
    EXPECT_NEAR(ray_render(Context(scene, exact), VIEW).radiance.x,
                s * back * 5 * (1 - std::exp(-2 * t * depth)) / (2 * t), 1e-13);
    scene.lights[0].direction = test::packed(0, 0, 1);
    EXPECT_NEAR(ray_render(Context(scene, exact), VIEW).radiance.x, s * forward * 5 * depth * std::exp(-t * depth),
                1e-13);
  }
}

TEST(ReferenceSlab, SegmentRuleByHand) {
  // one segment or two, cut into 16 parts: the depths to the eye and to the light grow evenly, so the sum is the
  // integral
  PlannedScene scene = slab(0.25, 0.75);
  test::light_add_directional(scene, {0, 0, -1}, 5);
  const double expected = 0.75 * 5 / (4 * PI) * (1 - std::exp(-4)) / 2;
  for (const float step : {8.0f, 1.0f}) {
    scene.walks[0].step = step;
    EXPECT_NEAR(ray_render(Context(scene, {}), VIEW).radiance.x, expected, 1e-14);
  }
  // a thin one takes the light in its middle: albedo · p E e^(-τ/2) · (1 - e^(-τ))
  PlannedScene thin = slab(0x1p-13, 0x1p-12);
  thin.walks[0].step = 8;
  test::light_add_directional(thin, {0, 0, -1}, 5);
  const double tau = 3 * 0x1p-12;
  EXPECT_NEAR(ray_render(Context(thin, {}), VIEW).radiance.x,
              2.0 / 3 * 5 / (4 * PI) * std::exp(-tau / 2) * -std::expm1(-tau), 1e-17);
  // and so does each part where collisions are tracked
  double middles = 0;
  for (int i = 0; i < 16; ++i) middles += (1 - std::exp(-0.125)) * std::exp(-i / 8.0 - (i + 0.5) / 8);
  scene.frame.takes_ends = 0;
  EXPECT_NEAR(ray_render(Context(scene, {}), VIEW).radiance.x, 0.75 * 5 / (4 * PI) * middles, 1e-14);
  scene.frame.takes_ends = 1;
  // light that travels with the view comes back by the value at cos θ = -1: 1/(18π) for g = 1/2
  scene.media[0].phase = PHASE_HENYEY_GREENSTEIN;
  scene.media[0].g = 0.5f;
  EXPECT_NEAR(ray_render(Context(scene, {}), VIEW).radiance.x, expected * 4 / 18, 1e-14);
}

TEST(ReferenceSlab, SegmentRuleOfTwoMediaByHand) {
  // both fill the slab in one segment; each is dimmed by both, and both dim the light: one medium of their sum
  PlannedScene scene = slab(0.25, 0.25);
  scene.walks[0].step = 8;
  test::medium_add_constant(scene, {-64, -64, 0}, {64, 64, 2}, 0, 1).walk.step = 8;
  test::light_add_directional(scene, {0, 0, -1}, 1);
  const double expected = 1.25 / (4 * PI) * (1 - std::exp(-6)) / 3;
  const PixelD pixel = ray_render(Context(scene, {}), VIEW);
  EXPECT_NEAR(pixel.radiance.x, expected, 1e-14);
  EXPECT_NEAR(pixel.transmittance.x, std::exp(-3), 1e-15);
}

double wavy(ivec3 s) { return (1 + s.x % 3 + s.y % 2 + s.z % 4) / 8.0; }

TEST(ReferenceMedia, OverlappingOnesEqualTheirSum) {
  for (const int interpolation : {INTERPOLATION_NEAREST, INTERPOLATION_TRILINEAR}) {
    PlannedScene one = test::scene_empty(), two = test::scene_empty();
    test::medium_add_grid(one, {6, 6, 6}, interpolation, wavy, 0.375, 0.75);
    test::medium_add_grid(two, {6, 6, 6}, interpolation, wavy, 0.25, 0.25);
    test::medium_add_grid(two, {6, 6, 6}, interpolation, wavy, 0.125, 0.5);
    for (PlannedScene* scene : {&one, &two}) test::light_add_point(*scene, {9, 7, 5}, 16);
    const RayD ray{{-1, 1.25, 8}, vec_unit({3, 2, -5})};
    const PixelD a = ray_render(Context(one, {}), ray), b = ray_render(Context(two, {}), ray);
    EXPECT_LT(a.transmittance.x, 0.9);
    EXPECT_NEAR(a.transmittance.x, b.transmittance.x, 1e-14);
    const Options exact{8, 1};
    const PixelD c = ray_render(Context(one, exact), ray), d = ray_render(Context(two, exact), ray);
    EXPECT_NEAR(c.radiance.x, d.radiance.x, 1e-12 * c.radiance.x);
    EXPECT_NEAR(c.transmittance.x, a.transmittance.x, 1e-14);
    EXPECT_NEAR(c.radiance.x, a.radiance.x,
                0.05 * c.radiance.x);  // the segment rule is near the exact picture, not equal
    EXPECT_NE(c.radiance.x, a.radiance.x);
  }
}

TEST(ReferenceMedia, ExactPictureConvergesWithItsOrder) {
  PlannedScene scene = test::scene_empty();
  test::medium_add_grid(scene, {6, 6, 6}, INTERPOLATION_TRILINEAR, wavy, 0.25, 0.75);
  scene.walks[0].method = METHOD_MARCH_MIDPOINT;  // not asked by the exact picture
  test::light_add_directional(scene, {0, -1, 0}, 1);
  const RayD ray{{-1, 3.5, 2.25}, vec_unit({4, 1, 0.5})};
  const double fine = ray_render(Context(scene, {24, 1}), ray).radiance.x;
  EXPECT_NEAR(ray_render(Context(scene, {8, 1}), ray).radiance.x, fine, 1e-12);
  EXPECT_NEAR(ray_render(Context(scene, {2, 1}), ray).radiance.x, fine, 1e-3 * fine);
}

TEST(ReferenceMedia, ColoursAreIndependentAndNoExtinctionIsNoAlbedo) {
  PlannedScene scene = slab(0, 0);
  scene.media[0].sigma_s = test::packed(1, 0, 0.5);
  scene.walks[0].step = 8;
  test::light_add_directional(scene, {0, 0, -1}, 1);
  const PixelD pixel = ray_render(Context(scene, {}), VIEW);
  EXPECT_NEAR(pixel.radiance.x, (1 - std::exp(-4)) / 2 / (4 * PI), 1e-15);
  EXPECT_EQ(pixel.radiance.y, 0);
  EXPECT_EQ(pixel.transmittance.y, 1);
  EXPECT_NEAR(pixel.radiance.z, (1 - std::exp(-2)) / 2 / (4 * PI), 1e-15);
}

TEST(ReferenceMedia, LightReachesASurfaceThroughThem) {
  PlannedScene scene = slab(0.5, 0);
  test::shape_add(scene, SHAPE_PLANE, {0, 0, -1, 0, 0, 1, 1, 0, 0});
  test::light_add_directional(scene, {0, 3, -4}, 1);
  // down through the slab 2/(4/5) = 2.5 long, up along the view 2
  EXPECT_NEAR(ray_render(Context(scene, {}), VIEW).radiance.x, 0.8 / PI * std::exp(-1.25) * std::exp(-1), 1e-14);
}

TEST(ReferenceKeys, PrimitiveLitLightsAndChecker) {
  PlannedScene scene = test::scene_empty();
  test::shape_add(scene, SHAPE_SPHERE, {50, 0, 0, 1});
  test::shape_add(scene, SHAPE_PLANE, {0, 0, 0, 0, 0, 1, 1, 0, 0});
  scene.materials[0].texture = 0;
  Texture texture{};
  texture.type = TEXTURE_CHECKER;
  texture.scale = 1;
  scene.textures.push_back(texture);
  test::light_add_directional(scene, {0, 0, -1}, 1);
  test::light_add_directional(scene, {0, 0, 1}, 1);  // from below the plane
  test::light_add_directional(scene, {0, 1, -1}, 1);
  const Context context(scene, {});
  const auto key = [&](double x) { return ray_render(context, RayD{{x, 0.5, 8}, {0, 0, -1}}).key; };
  EXPECT_EQ(key(0.5), 0x9E3779B1u + 5 * 0x85EBCA6Bu);
  EXPECT_EQ(key(1.5), 0x9E3779B1u + 5 * 0x85EBCA6Bu + 0x27D4EB2Fu);
  const PlannedScene nothing = test::scene_empty();
  EXPECT_EQ(ray_render(Context(nothing, {}), VIEW).key, 0xffffffffu * 0x9E3779B1u);
}

TEST(ReferenceKeys, BlockedLightsInSegmentsWithDensity) {
  // 4 cells of depth 2 along the view, one of them empty, each cut into 16 parts; light 1 (of 0, 1) stands behind a
  // quad
  PlannedScene scene = test::scene_empty();
  test::medium_add_grid(
      scene, {4, 4, 4}, INTERPOLATION_NEAREST, [](ivec3 s) { return s.z == 2 ? 0 : 1; }, 1, 1);
  test::shape_add(scene, SHAPE_QUAD, {-9, 6, -9, 0, -1, 0, 1.0 / 18, 0, 0, 0, 0, 1.0 / 18});
  test::light_add_directional(scene, {1, 0, 0}, 1);
  test::light_add_directional(scene, {0, -1, 0}, 1);
  const PixelD pixel = ray_render(Context(scene, {}), VIEW);
  EXPECT_EQ(pixel.key, 0xffffffffu * 0x9E3779B1u + 3 * 16 * 2 * 0xC2B2AE35u);
  scene.lights[1].intensity = test::grey(0);
  EXPECT_EQ(ray_render(Context(scene, {}), VIEW).key, 0xffffffffu * 0x9E3779B1u);
}

PlannedScene small_scene(int size) {
  PlannedScene scene = test::scene_empty(size);
  scene.frame.camera.spp = 3;
  test::medium_add_grid(scene, {6, 6, 6}, INTERPOLATION_TRILINEAR, wavy, 0.25, 0.75);
  test::shape_add(scene, SHAPE_SPHERE, {0, 0, 0, 0.5});
  test::light_add_point(scene, {3, 7, 5}, 16);
  return scene;
}

TEST(ReferenceRender, SameBytesWithAnyNumberOfThreads) {
  const PlannedScene scene = small_scene(6);
  Film one({6, 6}), three({6, 6});
  render(scene, one, {0, 1});
  render(scene, three, {0, 3});
  EXPECT_EQ(std::memcmp(one.pixels().data(), three.pixels().data(), 36 * sizeof(FilmPixel)), 0);
  const PixelD pixel = pixel_render(Context(scene, {}), 4, 1);
  EXPECT_EQ(one.pixels()[1 * 6 + 4].radiance.y, static_cast<float>(pixel.radiance.y));
  EXPECT_EQ(one.pixels()[1 * 6 + 4].samples, 3);
  EXPECT_EQ(one.pixels()[1 * 6 + 4].key, pixel.key);
  EXPECT_GT(one.pixels()[1 * 6 + 4].lookups, 0);
}

TEST(ReferenceRender, TouchesOnlyTheCrop) {
  PlannedScene scene = small_scene(6);
  scene.frame.crop_x0 = 2, scene.frame.crop_y0 = 1, scene.frame.crop_x1 = 5, scene.frame.crop_y1 = 3;
  Film film({6, 6});
  render(scene, film, {0, 2});
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x)
      EXPECT_EQ(film.pixels()[static_cast<std::size_t>(6 * y + x)].samples, x >= 2 && x < 5 && y >= 1 && y < 3 ? 3 : 0);
}

TEST(ReferenceRender, RefusesAFilmOfAnotherSize) {
  Film film({4, 6});
  EXPECT_THROW(render(small_scene(6), film, {}), RuntimeError);
}

}  // namespace
}  // namespace brume::reference
