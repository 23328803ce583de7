// Materials of the scene and of meshes, and their textures.
#include <algorithm>
#include <glm/common.hpp>
#include <map>
#include <tuple>

#include "base/error.hpp"
#include "flat/flatten_parts.hpp"

namespace brume {

namespace {

static_assert(static_cast<int>(MeshWrap::CLAMP) == WRAP_CLAMP && static_cast<int>(MeshWrap::MIRROR) == WRAP_MIRROR &&
                  static_cast<int>(MeshWrap::ONCE) == WRAP_ONCE,
              "one number for both");

// All that makes an image another one.
auto image_key(const Texture& t) {
  return std::tuple(t.type, t.offset, t.width, t.height, t.wrap, t.base, t.gain, t.uv_scale[0], t.uv_scale[1],
                    t.uv_offset[0], t.uv_offset[1]);
}

// Holds the texels of every image once, however many materials name it.
class TextureTable {
 public:
  TextureTable(LoadedScene& loaded, FlatScene& scene) : loaded_(loaded), scene_(scene) {}

  int add(const TextureDesc& desc) {
    if (desc.type == TEXTURE_IMAGE) {
      MeshTexture plain;
      plain.file = desc.file;
      plain.wrap = static_cast<MeshWrap>(desc.wrap);
      return add(plain);
    }
    Texture t{};
    t.type = TEXTURE_CHECKER;
    t.color_a = packed(desc.colors[0]);
    t.color_b = packed(desc.colors[1]);
    t.scale = static_cast<float>(desc.scale);
    return append(t);
  }

  // -1 for no file.
  int add(const MeshTexture& desc) {
    if (desc.file.empty()) return -1;
    Texture t = image(desc.file);
    for (int k = 0; k < 2; ++k) {
      t.uv_scale[k] = static_cast<float>(desc.scale[k]);
      t.uv_offset[k] = static_cast<float>(desc.offset[k]);
    }
    t.base = static_cast<float>(desc.base);
    t.gain = static_cast<float>(desc.gain);
    t.wrap = static_cast<int>(desc.wrap);
    const auto same = [&](const Texture& other) { return image_key(other) == image_key(t); };
    const auto known = std::find_if(scene_.textures.begin(), scene_.textures.end(), same);
    return known != scene_.textures.end() ? static_cast<int>(known - scene_.textures.begin()) : append(t);
  }

 private:
  // Where its texels are; the rest is 0.
  const Texture& image(const std::filesystem::path& file) {
    const auto known = images_.find(file);
    if (known != images_.end()) return known->second;
    const std::shared_ptr<const Image> decoded = loaded_.texture(file);
    const Image& image = *decoded;
    if (image.cleaned > 0)
      scene_.notes.push_back(file.string() + ": " + std::to_string(image.cleaned) + " of " +
                             std::to_string(image.values.size() / 3) +
                             " texels had channels that were NaN, infinite or negative; these are 0");
    Texture t{};
    t.type = TEXTURE_IMAGE;
    t.width = image.width;
    t.height = image.height;
    t.offset = static_cast<uint>(scene_.texels.size() / 3);
    for (int row = image.height - 1; row >= 0; --row) {  // files begin at the top, v = 0 is the bottom
      const auto begin = image.values.begin() + std::ptrdiff_t(row) * image.width * 3;
      scene_.texels.insert(scene_.texels.end(), begin, begin + std::ptrdiff_t(image.width) * 3);
    }
    return images_[file] = t;
  }

  int append(const Texture& t) {
    scene_.textures.push_back(t);
    return static_cast<int>(scene_.textures.size()) - 1;
  }

  LoadedScene& loaded_;
  FlatScene& scene_;
  std::map<std::filesystem::path, Texture> images_;
};

constexpr double ABSORPTION_MAX = 1e30;  // more absorption per flat unit leaves nothing, over any length

// `unit`: of the flat scene.
Material material_flatten(const MaterialDesc& m, double unit, TextureTable& textures) {
  Material out{};
  out.model = m.model;
  out.diffuse = packed(m.diffuse);
  out.specular = packed(m.specular);
  out.shininess = static_cast<float>(m.shininess);
  out.ambient = packed(m.ambient);
  out.emission = packed(m.emission);
  out.ior = static_cast<float>(m.ior);
  out.reflection = static_cast<float>(m.reflection);
  out.refraction = static_cast<float>(m.refraction);
  out.fresnel = m.fresnel;
  if (m.fresnel) {
    out.refraction = static_cast<float>(m.reflection + m.refraction);
    out.reflection = 0;
  }
  out.absorption = packed(glm::min(m.absorption * unit, dvec3(ABSORPTION_MAX)));
  out.texture = m.texture ? textures.add(*m.texture) : -1;
  out.emission_texture = -1;
  return out;
}

// A texture of a mesh that cannot be used is told, not fatal: the scene file did not ask for it.
int mesh_texture(const MeshTexture& texture, TextureTable& textures, std::vector<std::string>& notes) {
  try {
    return textures.add(texture);
  } catch (const InputError& error) {
    std::string why = error.what();
    if (const std::string file = texture.file.string(); !texture.name.empty() && why.rfind(file, 0) == 0)
      why = texture.name + why.substr(file.size());
    note_once(notes, why + "; the material goes without it");
    return -1;
  }
}

Material material_flatten(const MeshMaterial& m, double unit, TextureTable& textures, std::vector<std::string>& notes) {
  MaterialDesc desc;
  desc.diffuse = m.diffuse;
  desc.specular = m.specular;
  desc.ambient = m.ambient;
  desc.emission = m.emission;
  desc.shininess = m.shininess;
  desc.reflection = m.reflection;
  desc.refraction = m.refraction;
  desc.ior = m.ior;
  desc.model = m.specular == dvec3(0) ? MATERIAL_LAMBERT : MATERIAL_BLINN_PHONG;
  Material out = material_flatten(desc, unit, textures);
  out.texture = mesh_texture(m.texture, textures, notes);
  out.emission_texture = mesh_texture(m.emission_texture, textures, notes);
  return out;
}

}  // namespace

void flatten_materials(const SceneDesc& desc, LoadedScene& loaded, LoadedShapes& shapes, FlatScene& scene) {
  TextureTable textures(loaded, scene);
  for (const MaterialDesc& m : desc.materials) scene.materials.push_back(material_flatten(m, scene.unit, textures));
  shapes.default_material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material_flatten(MaterialDesc{}, scene.unit, textures));
  for (const LoadedMesh& mesh : shapes.meshes) {
    shapes.first_material.push_back(static_cast<int>(scene.materials.size()));
    if (!mesh.shows_own) continue;
    for (const MeshMaterial& m : mesh.mesh->materials)
      scene.materials.push_back(material_flatten(m, scene.unit, textures, scene.notes));
  }
}

}  // namespace brume
