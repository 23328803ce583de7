// See gathered_materials.hpp.
#include "assimp/gathered_materials.hpp"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.hpp"
#include "mesh/mesh.hpp"

namespace brume {

namespace {

class Materials {
 public:
  Materials(const aiScene& scene, GatheredMesh& out) : scene_(scene), out_(out) {}

  // What is told of one that no face has would surprise: the library adds one of its own.
  void add(const aiMaterial& material, bool used) {
    aiColor4D base(1, 1, 1, 1), emission(0, 0, 0, 1);
    float strength = 1;
    if (material.Get(AI_MATKEY_BASE_COLOR, base) != AI_SUCCESS) material.Get(AI_MATKEY_COLOR_DIFFUSE, base);
    material.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
    material.Get(AI_MATKEY_EMISSIVE_INTENSITY, strength);
    MeshSurface surface{};
    for (unsigned c = 0; c < 3; ++c) {
      surface.diffuse[c] = base[c];
      surface.emission[c] = double(emission[c]) * strength;
    }
    surface.texture = image(material, aiTextureType_BASE_COLOR, surface.texture_wrap);
    if (surface.texture < 0) surface.texture = image(material, aiTextureType_DIFFUSE, surface.texture_wrap);
    surface.emission_texture = image(material, aiTextureType_EMISSIVE, surface.emission_texture_wrap);
    out_.surfaces.push_back(surface);
    out_.surface_names.emplace_back(material.GetName().C_Str());
    if (used) tell(material, base.a);
  }

 private:
  void note(const std::string& text) {
    if (std::find(out_.notes.begin(), out_.notes.end(), text) == out_.notes.end()) out_.notes.push_back(text);
  }

  // Where glTF's own defaults stand, metal and glass were not meant.
  void tell(const aiMaterial& material, float alpha) {
    float metallic = 0, transmission = 0;
    material.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
    material.Get(AI_MATKEY_TRANSMISSION_FACTOR, transmission);
    aiString mode;
    material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode);
    if (metallic > 0) note("metallic and roughness are not shown: materials are diffuse");
    if (transmission > 0) note("transmission is not shown");
    if ((alpha < 1 && std::string(mode.C_Str()) != "OPAQUE") || std::string(mode.C_Str()) == "MASK")
      note("alpha is not shown");
  }

  static MeshWrap wrap_of(aiTextureMapMode mode) {
    if (mode == aiTextureMapMode_Clamp) return MeshWrap::CLAMP;
    return mode == aiTextureMapMode_Mirror ? MeshWrap::MIRROR : MeshWrap::REPEAT;
  }

  std::int32_t image(const aiMaterial& material, aiTextureType type, std::int32_t& wrap) {
    aiString path;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned uv = 0;
    if (material.GetTexture(type, 0, &path, nullptr, &uv, nullptr, nullptr, modes) != AI_SUCCESS) return -1;
    int source = 0;
    aiUVTransform transform;
    material.Get(AI_MATKEY_UVWSRC(type, 0), source);
    if (source > 0) note("textures by other coordinates than TEXCOORD_0 are shown by those");
    if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == AI_SUCCESS)
      note("transforms of textures are not shown");
    if (modes[0] != modes[1]) note("textures that go on in another way along v are shown as along u");
    wrap = static_cast<std::int32_t>(wrap_of(modes[0]));
    return image_number(path.C_Str());
  }

  std::int32_t image_number(const std::string& path) {
    GatheredImage image{path, ""};
    if (const aiTexture* inside = scene_.GetEmbeddedTexture(path.c_str())) {
      if (inside->mHeight != 0) throw InputError("image " + path + " is no file of an image");
      image.name = inside->mFilename.length > 0 ? inside->mFilename.C_Str() : "image " + path;
      image.bytes.assign(reinterpret_cast<const char*>(inside->pcData), inside->mWidth);
    }
    const auto same = [&](const GatheredImage& other) {
      return other.name == image.name && other.bytes == image.bytes;
    };
    const auto known = std::find_if(out_.images.begin(), out_.images.end(), same);
    if (known != out_.images.end()) return static_cast<std::int32_t>(known - out_.images.begin());
    out_.images.push_back(std::move(image));
    return static_cast<std::int32_t>(out_.images.size()) - 1;
  }

  const aiScene& scene_;
  GatheredMesh& out_;
};

}  // namespace

void materials_gather(const aiScene& scene, GatheredMesh& out) {
  Materials materials(scene, out);
  std::vector<bool> used(scene.mNumMaterials, false);
  for (const MeshFace& face : out.faces)
    if (static_cast<std::size_t>(face.material) < used.size()) used[static_cast<std::size_t>(face.material)] = true;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) materials.add(*scene.mMaterials[i], used[i]);
}

}  // namespace brume
