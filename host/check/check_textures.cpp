// Image textures without a file.
#include "check/check_parts.hpp"

namespace brume {

namespace {

// Adds the texture with texels of its own.
int image_append(PlannedScene& scene, Texture texture) {
  CheckRandom random;
  texture.offset = static_cast<uint>(scene.texels.size() / 3);
  for (int i = 0; i < 3 * texture.width * texture.height; ++i)
    scene.texels.push_back(static_cast<float>(random.uniform(0, 1)));
  scene.textures.push_back(texture);
  return static_cast<int>(scene.textures.size()) - 1;
}

Texture image_texture() {
  Texture t{};
  t.type = TEXTURE_IMAGE;
  t.width = 32;
  t.height = 24;
  t.uv_scale[0] = t.uv_scale[1] = t.gain = 1;
  return t;
}

}  // namespace

int image_add(PlannedScene& scene) { return image_append(scene, image_texture()); }

// Negative where texels are below 1/8.
int image_add_wrapped(PlannedScene& scene, int wrap) {
  Texture t = image_texture();
  t.wrap = wrap;
  t.uv_scale[0] = 1.5F;
  t.uv_scale[1] = -0.5F;
  t.uv_offset[0] = -0.25F;
  t.uv_offset[1] = 0.75F;
  t.base = -0.0625F;
  t.gain = 0.5F;
  return image_append(scene, t);
}

}  // namespace brume
