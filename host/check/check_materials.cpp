// How materials reflect one light, and textures.
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "check/check_parts.hpp"
#include "check/row_scenes.hpp"
#include "reference/glass.hpp"
#include "reference/surface.hpp"
#include "render/renderer.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

dvec3 towards(const dvec3& side, CheckRandom& random) {  // on that side of a surface
  const dvec3 d = random.direction();
  return glm::dot(d, side) < 0 ? -d : d;
}

// A viewer near the mirrored direction every other time, where the lobe is.
CheckCompare material_prepare(int model, int size) {
  return [model, items = size * size](Context& context, int lanes, ErrorSum& sum) {
    const PlannedScene scene = row_scene(material_desc(model), "material", 8, bvh_width_for(lanes));
    CheckRandom random;
    std::vector<float> in;
    std::vector<dvec3> expected;
    for (int i = 0; i < items; ++i) {
      reference::SurfaceD surface;
      surface.normal = random.direction();
      const dvec3 to_light = towards(surface.normal, random), any = towards(surface.normal, random);
      const dvec3 mirrored = 2 * glm::dot(surface.normal, to_light) * surface.normal - to_light;
      const dvec3 to_viewer = i % 2 ? any : dvec3(glm::vec3(glm::normalize(mirrored + random.in_box(0.2))));
      surface.diffuse = reference::vec_promote(scene.materials[0].diffuse);
      in.push_back(bits_as_float(0));
      for (const dvec3& v : {surface.normal, to_light, to_viewer}) push3(in, v);
      expected.push_back(reference::surface_reflect(scene, surface, -to_viewer, -to_light));
    }
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_material", in, 10, 3);
    for (int i = 0; i < items; ++i) add3(sum, &found[3 * i], expected[i]);
  };
}

using TexturedScene = PlannedScene (*)(int row, int bvh_width);  // of the family that is compared

// By its keys' defaults, in colors that tell the channels apart.
PlannedScene made_texture(int type, int bvh_width) {
  TextureDesc texture;
  texture.type = type;
  texture.colors = {dvec3(0.8, 0.7, 0.6), dvec3(0.2, 0.3, 0.25)};
  texture.scale = 2;
  SceneDesc desc = material_desc(MATERIAL_LAMBERT);
  desc.materials[0].texture = texture;
  return row_scene(desc, "texture", 8, bvh_width);
}

PlannedScene repeated_image(int, int bvh_width) {
  PlannedScene scene = row_scene(material_desc(MATERIAL_LAMBERT), "texture", 8, bvh_width);
  scene.materials[0].texture = image_add(scene);
  return scene;
}

PlannedScene wrapped_image(int wrap, int bvh_width) {
  PlannedScene scene = row_scene(material_desc(MATERIAL_LAMBERT), "texture", 8, bvh_width);
  scene.materials[0].texture = image_add_wrapped(scene, wrap);
  return scene;
}

Check texture_check(const std::string& name, int row, TexturedScene make) {
  const auto prepare = [row, make](int size) -> CheckCompare {
    return [row, make, items = size * size](Context& context, int lanes, ErrorSum& sum) {
      const PlannedScene scene = make(row, bvh_width_for(lanes));
      const int texture = scene.materials[0].texture;
      CheckRandom random;
      std::vector<float> in;
      for (int i = 0; i < items; ++i) {
        in.push_back(bits_as_float(texture));
        for (int k = 0; k < 2; ++k) in.push_back(static_cast<float>(random.uniform(-2, 3)));
      }
      const std::vector<float> found = Probe(context, scene, lanes).run("probe_texture", in, 3, 4);
      for (int i = 0; i < items; ++i) {
        const glm::dvec2 uv(in[3 * i + 1], in[3 * i + 2]);
        add3(sum, &found[4 * i], reference::texture_lookup(scene, texture, uv));
        sum.add(found[4 * i + 3], reference::texture_second(scene.textures[texture], uv));
      }
    };
  };
  return {"texture/" + name, "texture", prepare};
}

// From either side of glass, water, diamond and of nothing, at all angles.
CheckCompare fresnel_prepare(int size) {
  return [items = size * size](Context& context, int lanes, ErrorSum& sum) {
    const PlannedScene scene = row_scene(material_desc(MATERIAL_LAMBERT), "material", 8, bvh_width_for(lanes));
    constexpr double IORS[] = {1.5, 1.33, 2.42, 1};
    CheckRandom random;
    std::vector<float> in;
    for (int i = 0; i < items; ++i) {
      const double ior = IORS[i % std::size(IORS)];
      const int four = i / 4;
      in.push_back(static_cast<float>(i < 8 ? four : random.uniform(0, 1)));
      in.push_back(static_cast<float>(four % 2 ? ior : 1 / ior));
    }
    const std::vector<float> found = Probe(context, scene, lanes).run("probe_fresnel", in, 2, 1);
    for (int i = 0; i < items; ++i) {
      const double cosine = in[2 * i], eta = in[2 * i + 1], k = 1 - eta * eta * (1 - cosine * cosine);
      if (std::abs(k) > 1e-4) sum.add(found[i], reference::fresnel(cosine, eta));  // a root of what is next to 0
    }
  };
}

}  // namespace

std::vector<Check> material_checks() {
  std::vector<Check> checks;
  for (const FamilyRow& row : material_family())
    checks.push_back({"material/" + std::string(row.name), "material",
                      [model = row.id](int size) { return material_prepare(model, size); }});
  checks.push_back({"glass/fresnel", "fresnel", fresnel_prepare});
  for (const FamilyRow& row : texture_family())
    checks.push_back(
        texture_check(std::string(row.name), row.id, row.id == TEXTURE_IMAGE ? repeated_image : made_texture));
  for (const FamilyRow& row : wrap_family())
    checks.push_back(texture_check("wrap_" + std::string(row.name), row.id, wrapped_image));
  checks.push_back(texture_check("once", WRAP_ONCE, wrapped_image));
  return checks;
}

}  // namespace brume
