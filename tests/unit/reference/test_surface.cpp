// Surfaces of the reference: normals, texture coordinates, textures, reflection, leaving rays.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/render.hpp"
#include "reference/surface.hpp"
#include "unit/plan/flat_scene_builder.hpp"

namespace brume::reference {
namespace {

SurfaceD look(const PlannedScene& scene, const dvec3& origin, const dvec3& dir) {
  const RayD ray{origin, vec_unit(dir)};
  const HitD hit = nearest_hit(scene, ray);
  EXPECT_NE(hit.primitive, PRIMITIVE_NONE);
  return surface_at(scene, ray, hit);
}

void expect_near(const dvec3& a, const dvec3& b, double tolerance = 1e-13) {
  EXPECT_NEAR(glm::distance(a, b), 0, tolerance) << a.x << " " << a.y << " " << a.z;
}
void expect_near(const dvec2& a, const dvec2& b, double tolerance = 1e-13) {
  EXPECT_NEAR(glm::distance(a, b), 0, tolerance) << a.x << " " << a.y;
}

TEST(ReferenceSurface, SphereNormalsAndCoordinates) {
  PlannedScene scene;
  test::shape_add(scene, SHAPE_SPHERE, {0, 0, 0, 2});
  const SurfaceD front = look(scene, {0, 0, 5}, {0, 0, -1});  // +z is -90 degrees, i.e. 3/4 turn
  expect_near(front.normal, {0, 0, 1});
  expect_near(front.uv, {0.75, 0.5});
  expect_near(look(scene, {5, 0, 0}, {-1, 0, 0}).uv, {0, 0.5});
  expect_near(look(scene, {0, 0, -5}, {0, 0, 1}).uv, {0.25, 0.5});
  EXPECT_NEAR(look(scene, {0, 5, 0}, {0, -1, 0}).uv.y, 1, 1e-13);
  EXPECT_NEAR(look(scene, {0, -5, 0}, {0, 1, 0}).uv.y, 0, 1e-13);
  const SurfaceD inside = look(scene, {0, 0, 0}, {1, 0, 0});  // two-sided
  expect_near(inside.normal, {-1, 0, 0});
  expect_near(inside.geometric_normal, {-1, 0, 0});
}

TEST(ReferenceSurface, CylinderSideAndCaps) {
  PlannedScene scene;  // axis z, its frame x, y = z × x
  test::shape_add(scene, SHAPE_CYLINDER, {0, 0, 0, 0, 0, 1, 4, 2, 1, 0, 0});
  const SurfaceD side = look(scene, {0, 5, 1}, {0, -1, 0});
  expect_near(side.normal, {0, 1, 0});
  expect_near(side.uv, {0.25, 0.25});
  const SurfaceD top = look(scene, {1, 0.5, 9}, {0, 0, -1});
  expect_near(top.normal, {0, 0, 1});
  expect_near(top.uv, {0.75, 0.625});
  expect_near(look(scene, {1, 0.5, -9}, {0, 0, 1}).normal, {0, 0, -1});
  expect_near(look(scene, {1, 0.5, 2}, {0, 0, 1}).normal, {0, 0, -1});  // the top from inside
}

TEST(ReferenceSurface, PlaneQuadBoxCoordinates) {
  PlannedScene plane;
  test::shape_add(plane, SHAPE_PLANE, {1, 2, 0, 0, 1, 0, 1, 0, 0});  // v axis = y × x = -z
  expect_near(look(plane, {4, 9, 5}, {0, -1, 0}).uv, {3, -5});
  expect_near(look(plane, {4, -9, 5}, {0, 1, 0}).normal, {0, -1, 0});
  PlannedScene quad;
  test::shape_add(quad, SHAPE_QUAD, {0, 0, 0, 0, 0, 1, 0.5, -0.25, 0, 0, 0.5, 0});
  expect_near(look(quad, {1.5, 1, 3}, {0, 0, -1}).uv, {0.5, 0.5});
  expect_near(look(quad, {1.5, 0.5, 3}, {0, 0, -1}).uv, {0.625, 0.25});
  PlannedScene box;  // [0,2] x [0,4] x [0,8]
  test::shape_add(box, SHAPE_BOX, {0.5, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 0.125, 0});
  expect_near(look(box, {9, 1, 2}, {-1, 0, 0}).uv, {0.25, 0.25});    // (y, z)
  expect_near(look(box, {0.5, 9, 2}, {0, -1, 0}).uv, {0.25, 0.25});  // (x, z)
  expect_near(look(box, {0.5, 3, 9}, {0, 0, -1}).uv, {0.25, 0.75});  // (x, y)
  expect_near(look(box, {0.5, 3, -9}, {0, 0, 1}).normal, {0, 0, -1});
}

TEST(ReferenceSurface, ShearedBoxHasTheFaceNormalOfItsPlane) {
  PlannedScene box;  // unit x = x - y: the face x = 0 is the plane x = y, whose outward normal is (-1, 1, 0)/√2
  test::shape_add(box, SHAPE_BOX, {1, -1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  expect_near(look(box, {-4, 0.5, 0.5}, {1, 0, 0}).normal, dvec3(-1, 1, 0) / std::sqrt(2.0));
}

TEST(ReferenceSurface, TriangleShadingFlipsTogetherWithItsFace) {
  PlannedScene scene;
  Triangle& triangle = test::triangle_add(scene, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  triangle.shading = TRIANGLE_PHONG;
  triangle.n[0] = test::packed(0, 0, 1);
  triangle.n[1] = test::packed(1, 0, 0);
  triangle.n[2] = test::packed(0, 0, 1);
  const float uv[6] = {0, 0, 1, 0, 0, 2};
  std::copy(uv, uv + 6, triangle.uv);
  const SurfaceD front = look(scene, {2, 1, 3}, {0, 0, -1});  // u = 1/2, v = 1/4
  expect_near(front.normal, vec_unit({0.5, 0, 0.5}));
  expect_near(front.uv, {0.5, 0.5});
  const SurfaceD back = look(scene, {2, 1, -3}, {0, 0, 1});
  expect_near(back.geometric_normal, {0, 0, -1});
  expect_near(back.normal, -vec_unit({0.5, 0, 0.5}));
}

TEST(ReferenceTexture, BilinearWithRepeat) {
  PlannedScene scene;  // texels: bottom row 1 2, top row 3 5; an unused texel first
  scene.texels = {9, 9, 9, 1, 1, 1, 2, 2, 2, 3, 3, 3, 5, 5, 5};
  Texture texture{};
  texture.type = TEXTURE_IMAGE;
  texture.width = texture.height = 2;
  texture.offset = 1;
  texture.uv_scale[0] = texture.uv_scale[1] = texture.gain = 1;
  scene.textures.push_back(texture);
  const auto value = [&](double u, double v) { return texture_lookup(scene, 0, {u, v}).x; };
  EXPECT_DOUBLE_EQ(value(0.25, 0.25), 1);  // texel centres
  EXPECT_DOUBLE_EQ(value(0.75, 0.25), 2);
  EXPECT_DOUBLE_EQ(value(0.25, 0.75), 3);
  EXPECT_DOUBLE_EQ(value(0.75, 0.75), 5);
  EXPECT_DOUBLE_EQ(value(0.5, 0.5), 2.75);
  EXPECT_DOUBLE_EQ(value(0.375, 0.25), 1.25);
  EXPECT_DOUBLE_EQ(value(0, 0.25), 1.5);  // half way between the last and the first column
  EXPECT_DOUBLE_EQ(value(1, 0.25), 1.5);
  EXPECT_DOUBLE_EQ(value(0.25, 0), 2);
  EXPECT_DOUBLE_EQ(value(-3.75, 7.25), 1);
}

TEST(ReferenceTexture, ScaledShiftedClampedAndInOtherUnits) {
  PlannedScene scene;  // texels: bottom row 1 2, top row 3 5
  scene.texels = {1, 1, 1, 2, 2, 2, 3, 3, 3, 5, 5, 5};
  Texture texture{};
  texture.type = TEXTURE_IMAGE;
  texture.width = texture.height = 2;
  texture.uv_scale[0] = 2;
  texture.uv_scale[1] = 1;
  texture.uv_offset[0] = 0.25;
  texture.uv_offset[1] = -0.5;
  texture.base = -4;
  texture.gain = 2;
  scene.textures.push_back(texture);
  const auto value = [&](double u, double v) { return texture_lookup(scene, 0, {u, v}).x; };
  EXPECT_DOUBLE_EQ(value(0.25, 1.25), 6);  // (0.75, 0.75): 5
  EXPECT_DOUBLE_EQ(value(0, 1.25), 2);     // (0.25, 0.75): 3
  EXPECT_DOUBLE_EQ(value(0.5, 0.25), 2);   // (1.25, -0.25) is (0.25, 0.75)
  EXPECT_DOUBLE_EQ(value(0, 0.75), 0);     // (0.25, 0.25): -4 + 2
  scene.textures[0].wrap = WRAP_ONCE;
  EXPECT_DOUBLE_EQ(value(0.5, 1.25), 1);   // (1.25, 0.75): beside it
  EXPECT_DOUBLE_EQ(value(0.25, 0.25), 1);  // (0.75, -0.25): below it
  EXPECT_DOUBLE_EQ(value(-9, 9), 1);
  EXPECT_DOUBLE_EQ(value(0.375, 1.5), 6);  // (1, 1): no blend with the other side
  EXPECT_DOUBLE_EQ(value(0.25, 1.5), 6);   // (0.75, 1)
  EXPECT_EQ(texture_second(scene.textures[0], {0.25, 1.5}), 0);
  EXPECT_EQ(texture_second(scene.textures[0], {0.25, 0.25}), 1);
}

TEST(ReferenceTexture, BesideTheImage) {
  PlannedScene scene;  // one row: 1 2 4
  scene.texels = {1, 1, 1, 2, 2, 2, 4, 4, 4};
  Texture texture{};
  texture.type = TEXTURE_IMAGE;
  texture.width = 3;
  texture.height = 1;
  texture.uv_scale[0] = texture.uv_scale[1] = texture.gain = 1;
  scene.textures.push_back(texture);
  const auto value = [&](int wrap, double texel) {  // 0 is the centre of the first
    scene.textures[0].wrap = wrap;
    return texture_lookup(scene, 0, {(texel + 0.5) / 3, 0.5}).x;
  };
  const double at[] = {-4, -1, -0.5, 0, 2, 2.5, 3, 4.5, 5, 6, 9};
  const double repeat[] = {4, 4, 2.5, 1, 4, 2.5, 1, 3, 4, 1, 1}, clamp[] = {1, 1, 1, 1, 4, 4, 4, 4, 4, 4, 4},
               mirror[] = {4, 1, 1, 1, 4, 4, 4, 1.5, 1, 1, 4};
  for (int i = 0; i < 11; ++i) {
    EXPECT_NEAR(value(WRAP_REPEAT, at[i]), repeat[i], 1e-12) << at[i];
    EXPECT_NEAR(value(WRAP_CLAMP, at[i]), clamp[i], 1e-12) << at[i];
    EXPECT_NEAR(value(WRAP_MIRROR, at[i]), mirror[i], 1e-12) << at[i];
  }
}

TEST(ReferenceTexture, EmissionHasATextureOfItsOwn) {
  PlannedScene scene;
  test::shape_add(scene, SHAPE_PLANE, {0, 0, 0, 0, 0, 1, 1, 0, 0});
  scene.materials[0].emission = test::grey(2);
  EXPECT_EQ(look(scene, {0, 0, 1}, {0, 0, -1}).emission, dvec3(2));
  scene.texels = {0.5F, 0.25F, 1};
  Texture texture{};
  texture.type = TEXTURE_IMAGE;
  texture.width = texture.height = 1;
  texture.gain = 1;
  scene.textures.push_back(texture);
  scene.materials[0].emission_texture = 0;
  EXPECT_EQ(look(scene, {0, 0, 1}, {0, 0, -1}).emission, dvec3(1, 0.5, 2));
  EXPECT_EQ(look(scene, {0, 0, 1}, {0, 0, -1}).diffuse, dvec3(1));
}

TEST(ReferenceTexture, CheckerAlternatesAcrossTheOrigin) {
  PlannedScene scene;
  test::shape_add(scene, SHAPE_PLANE, {0, 0, 0, 0, 0, 1, 1, 0, 0});
  scene.materials[0].texture = 0;
  scene.materials[0].diffuse = test::grey(0.5);
  Texture texture{};
  texture.type = TEXTURE_CHECKER;
  texture.color_a = test::grey(1);
  texture.color_b = test::packed(0, 0.5, 0);
  texture.scale = 2;
  scene.textures.push_back(texture);
  EXPECT_EQ(look(scene, {0.25, 0.25, 1}, {0, 0, -1}).second, 0);
  EXPECT_EQ(look(scene, {0.75, 0.25, 1}, {0, 0, -1}).second, 1);
  EXPECT_EQ(look(scene, {-0.25, 0.25, 1}, {0, 0, -1}).second, 1);
  EXPECT_EQ(look(scene, {-0.25, -0.25, 1}, {0, 0, -1}).second, 0);
  EXPECT_EQ(look(scene, {0.25, 0.25, 1}, {0, 0, -1}).diffuse, dvec3(0.5));
  EXPECT_EQ(look(scene, {0.75, 0.25, 1}, {0, 0, -1}).diffuse, dvec3(0, 0.25, 0));
}

TEST(ReferenceReflection, LambertUnderAPointLight) {
  // floor y = 0, light at height 4 and 3 away: d² = 25, cos = 4/5
  PlannedScene scene;
  test::shape_add(scene, SHAPE_PLANE, {0, 0, 0, 0, 1, 0, 1, 0, 0});
  scene.materials[0].diffuse = test::grey(0.5);
  scene.materials[0].ambient = test::grey(0.25);
  scene.materials[0].emission = test::grey(2);
  scene.frame.ambient = test::grey(0.5);
  test::light_add_point(scene, {3, 4, 0}, 50);
  const Context context(scene, {});
  const RayD down{{0, 2, 0}, {0, -1, 0}};
  EXPECT_NEAR(ray_render(context, down).radiance.x, 2 + 0.125 + 0.5 * 2 * 0.8 / PI, 1e-14);
  const RayD up{{0, -2, 0}, {0, 1, 0}};  // the lower side faces away from the light
  EXPECT_NEAR(ray_render(context, up).radiance.x, 2.125, 1e-14);
}

TEST(ReferenceReflection, PhongAndBlinnPhongLobes) {
  // viewer straight above, light 45 degrees off: R·V = √½, N·H = cos 22.5°
  PlannedScene scene;
  test::shape_add(scene, SHAPE_PLANE, {0, 0, 0, 0, 1, 0, 1, 0, 0});
  scene.materials[0].diffuse = test::grey(0);
  scene.materials[0].specular = test::grey(0.5);
  scene.materials[0].shininess = 8;
  test::light_add_directional(scene, {1, -1, 0}, 4);
  const Context context(scene, {});
  const RayD down{{0, 2, 0}, {0, -1, 0}};
  EXPECT_EQ(ray_render(context, down).radiance.x, 0);  // lambert has no lobe
  scene.materials[0].model = MATERIAL_PHONG;
  EXPECT_NEAR(ray_render(context, down).radiance.x, 0.5 * 4 * std::pow(0.5, 4), 1e-14);
  scene.materials[0].model = MATERIAL_BLINN_PHONG;
  EXPECT_NEAR(ray_render(context, down).radiance.x, 0.5 * 4 * std::pow(std::cos(PI / 8), 8), 1e-14);
}

TEST(ReferenceSurface, NoSelfShadowAtAnyScale) {
  for (const double scale : {0x1p-14, 1.0, 0x1p14}) {
    PlannedScene scene;
    test::shape_add(scene, SHAPE_SPHERE, {scale, scale / 2, 0, scale});
    test::light_add_directional(scene, {1, -1, -1}, 1);
    const Context context(scene, {});
    for (int i = 0; i < 400; ++i) {  // a spiral of view points
      const double y = (i + 0.5) / 200 - 1, turn = 2.4 * i, r = std::sqrt(1 - y * y);
      const dvec3 away(r * std::cos(turn), y, r * std::sin(turn));
      const PixelD pixel = ray_render(context, RayD{scale * (dvec3(1, 0.5, 0) + 3.0 * away), -away});
      const double expected = std::max(0.0, glm::dot(away, dvec3(-1, 1, 1)) / std::sqrt(3.0)) / PI;
      EXPECT_NEAR(pixel.radiance.x, expected, 1e-12) << scale << " " << i;
    }
  }
}

TEST(ReferenceSurface, RaysLeaveOnTheSideToWhichTheyGo) {
  PlannedScene scene;
  test::shape_add(scene, SHAPE_PLANE, {0, 0, 0, 0, 1, 0, 1, 0, 0});
  const SurfaceD surface = look(scene, {0, 2, 0}, {0, -1, 0});  // t = 2 exceeds |P|
  EXPECT_EQ(surface_leave(surface, {0, 1, 0}), dvec3(0, 0x1p-16, 0));
  EXPECT_EQ(surface_leave(surface, vec_unit({1, -1, 0})), dvec3(0, -0x1p-16, 0));
  EXPECT_EQ(surface_leave(look(scene, {64, 2, 0}, {0, -1, 0}), {0, 1, 0}), dvec3(64, 0x1p-11, 0));
}

}  // namespace
}  // namespace brume::reference
