// Surface materials and their textures.
//   radiance = emission + ambient * scene ambient + Σ lights E (diffuse cosθ / π + specular lobe), PICTURE, The pixel
#ifndef BRUME_SHARED_MATERIAL_H
#define BRUME_SHARED_MATERIAL_H
#include "shared/platform.h"

#define BRUME_MATERIALS(ROW)                                  \
  ROW(LAMBERT, "lambert", "diffuse only")                     \
  ROW(PHONG, "phong", "diffuse and specular (R·V)^shininess") \
  ROW(BLINN_PHONG, "blinn_phong", "diffuse and specular (N·H)^shininess")

#define BRUME_TEXTURES(ROW)                                                              \
  ROW(IMAGE, "image", "an image file: bilinear, v = 0 at the bottom row; times diffuse") \
  ROW(CHECKER, "checker", "two colors in squares of 1/scale texture units; times diffuse")

// What is beside an image.
#define BRUME_WRAPS(ROW)                            \
  ROW(REPEAT, "repeat", "the image again")          \
  ROW(CLAMP, "clamp", "its outermost texels go on") \
  ROW(MIRROR, "mirror", "the image again, mirrored at its edge")

BRUME_SHARED_BEGIN
enum MaterialModel {
#define ROW(id, name, help) MATERIAL_##id,
  BRUME_MATERIALS(ROW)
#undef ROW
      MATERIAL_COUNT
};
enum TextureType {
#define ROW(id, name, help) TEXTURE_##id,
  BRUME_TEXTURES(ROW)
#undef ROW
      TEXTURE_COUNT
};

enum TextureWrap {
#define ROW(id, name, help) WRAP_##id,
  BRUME_WRAPS(ROW)
#undef ROW
      WRAP_COUNT,
  WRAP_ONCE = WRAP_COUNT  // of MTL alone: 1 as the color beside the image
};

typedef struct {
  Packed3 diffuse;
  int model;
  Packed3 specular;
  float shininess;
  Packed3 ambient;
  int texture;  // index into the textures, -1 for none
  Packed3 emission;
  float ior;
  float reflection;      // weight of the mirrored ray
  float refraction;      // weight of the transmitted ray; with `fresnel` of both
  int emission_texture;  // an image, times emission; -1 for none
  int fresnel;           // 1: Fresnel's equations share `refraction` out between both rays; `reflection` is 0
  Packed3 absorption;    // per flat unit, inside a shape that refracts
} Material;
BRUME_LAYOUT(Material, 92);

// checker: color_a where floor(u scale) + floor(v scale) is even, color_b elsewhere.
// image: texel (x, row) of linear RGB at texels[3 * (offset + row * width + x)]; row 0 is the BOTTOM row (v = 0). It is
// looked up at uv_scale * uv + uv_offset; its color is base + gain * texel, 0 where that is negative. Beside
// [0, 1]² it goes on as wrap says; where an image is mirrored, so are its texels. With WRAP_ONCE the color is 1 there.
typedef struct {
  int type;
  int width;
  int height;
  uint offset;
  Packed3 color_a;
  float scale;
  Packed3 color_b;
  int wrap;
  float uv_scale[2];
  float uv_offset[2];
  float base;
  float gain;
  float pad[2];
} Texture;
BRUME_LAYOUT(Texture, 80);
BRUME_SHARED_END
#endif
