// "materials": an object of named materials.
#include "scene/families.hpp"
#include "scene/read_parts.hpp"

namespace brume {

namespace {

static_assert(TEXTURE_COUNT == 2, "read_texture knows the keys of all");

TextureDesc read_texture(const JsonValue& value, const std::filesystem::path& folder) {
  TextureDesc t;
  if (value.is_string()) {
    t.file = read_path(value, folder);
    return t;
  }
  t.type = value.get("type").as_member(texture_family(), "texture");
  if (t.type == TEXTURE_IMAGE) {
    t.file = read_path(value.get("file"), folder);
    t.wrap = value.member("wrap", t.wrap, wrap_family(), "wrap");
  }
  if (t.type == TEXTURE_CHECKER) {
    if (value.has("colors")) {
      const std::vector<JsonValue> colors = value.get("colors").as_list();
      if (colors.size() != 2) value.get("colors").fail("expected 2 colors" + value.get("colors").got());
      for (int i = 0; i < 2; ++i) t.colors[i] = colors[i].as_color(Range::at_least_0());
    }
    t.scale = value.number("scale", t.scale, Range::positive());
  }
  value.refuse_unread();
  return t;
}

MaterialDesc read_material(const std::string& name, const JsonValue& m, const std::filesystem::path& folder) {
  MaterialDesc out;
  out.name = name;
  out.model = m.member("model", out.model, material_family(), "material model");
  out.ambient = m.color("ambient", out.ambient, Range::at_least_0());
  out.diffuse = m.color("diffuse", out.diffuse, Range::at_least_0());
  out.specular = m.color("specular", out.specular, Range::at_least_0());
  out.emission = m.color("emission", out.emission, Range::closed(0, RADIANCE_MAX));
  out.is_light = m.flag("light", out.is_light);
  out.shininess = m.number("shininess", out.shininess, Range::closed(0, 1e6));
  out.ior = m.number("ior", out.ior, Range::positive());
  out.reflection = m.number("reflection", out.reflection, Range::closed(0, 1));
  out.refraction = m.number("refraction", out.refraction, Range::closed(0, 1));
  out.fresnel = m.flag("fresnel", out.fresnel);
  out.absorption = m.color("absorption", out.absorption, Range::at_least_0());
  if (m.has("texture")) out.texture = read_texture(m.get("texture"), folder);
  m.refuse_unread();
  return out;
}

}  // namespace

std::vector<MaterialDesc> read_materials(const JsonValue& scene, const std::filesystem::path& folder) {
  std::vector<MaterialDesc> materials;
  if (!scene.has("materials")) return materials;
  const JsonValue all = scene.get("materials");
  all.expect_object();
  for (const auto& item : all.json().items())
    materials.push_back(read_material(item.key(), all.get(item.key()), folder));
  return materials;
}

}  // namespace brume
