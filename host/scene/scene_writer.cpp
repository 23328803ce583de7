// See scene_writer.hpp.
#include "scene/scene_writer.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/json_text.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

using Json = nlohmann::ordered_json;
using Folder = std::filesystem::path;

// 1 and not 1.0 where nothing is lost.
Json number(double v) {
  if (std::floor(v) == v && std::abs(v) < 1e15) return static_cast<std::int64_t>(v);
  return v;
}

Json vec(const dvec3& v) { return {number(v.x), number(v.y), number(v.z)}; }

// By names alone: links in the path are not followed, as in the reader.
std::string path_text(const std::filesystem::path& file, const Folder& folder) {
  const Folder base = std::filesystem::absolute(folder.empty() ? "." : folder).lexically_normal();
  const auto relative = std::filesystem::absolute(file).lexically_normal().lexically_relative(base);
  return relative.empty() ? file.generic_string() : relative.generic_string();
}

Json transform_json(const TransformDesc& transform) {
  struct Step {
    Json operator()(const Scale& s) const { return {{"scale", vec(s.factor)}}; }
    Json operator()(const Rotate& r) const {
      return {{"rotate", {number(r.axis.x), number(r.axis.y), number(r.axis.z), number(r.degrees)}}};
    }
    Json operator()(const Translate& t) const { return {{"translate", vec(t.offset)}}; }
  };
  Json steps = Json::array();
  for (const auto& step : transform) steps.push_back(std::visit(Step{}, step));
  return steps;
}

// A row that these do not know would be written without its keys.
static_assert(CAMERA_COUNT == 2 && LIGHT_COUNT == 3 && TEXTURE_COUNT == 2);

Json camera_json(const CameraDesc& c) {
  Json json{{"type", family_name(camera_family(), c.type)},
            {"eye", vec(c.eye)},
            {"target", vec(c.target)},
            {"up", vec(c.up)}};
  if (c.type == CAMERA_PERSPECTIVE) json["vfov"] = number(c.vfov);
  if (c.type == CAMERA_ORTHOGRAPHIC) json["height"] = number(c.height);
  return json;
}

Json light_json(const LightDesc& l) {
  Json json{{"type", family_name(light_family(), l.type)}};
  if (l.type != LIGHT_DIRECTIONAL) json["position"] = vec(l.position);
  if (l.type != LIGHT_POINT) json["direction"] = vec(l.direction);
  json[l.type == LIGHT_DIRECTIONAL ? "irradiance" : "intensity"] = vec(l.intensity);
  if (l.type != LIGHT_DIRECTIONAL) json["falloff"] = family_name(falloff_family(), l.falloff);
  if (l.type == LIGHT_SPOT) {
    json["angle"] = number(l.angle);
    json["softness"] = number(l.softness);
  }
  return json;
}

Json material_json(const MaterialDesc& m, const Folder& folder) {
  Json json{{"model", family_name(material_family(), m.model)},
            {"ambient", vec(m.ambient)},
            {"diffuse", vec(m.diffuse)},
            {"specular", vec(m.specular)},
            {"shininess", number(m.shininess)},
            {"reflection", number(m.reflection)},
            {"refraction", number(m.refraction)},
            {"ior", number(m.ior)},
            {"fresnel", m.fresnel},
            {"absorption", vec(m.absorption)},
            {"emission", vec(m.emission)}};
  if (!m.is_light) json["light"] = false;
  if (!m.texture) return json;
  if (m.texture->type == TEXTURE_IMAGE && m.texture->wrap == WRAP_REPEAT)
    json["texture"] = path_text(m.texture->file, folder);
  else if (m.texture->type == TEXTURE_IMAGE)
    json["texture"] = {{"type", family_name(texture_family(), m.texture->type)},
                       {"file", path_text(m.texture->file, folder)},
                       {"wrap", family_name(wrap_family(), m.texture->wrap)}};
  else
    json["texture"] = {{"type", family_name(texture_family(), m.texture->type)},
                       {"colors", {vec(m.texture->colors[0]), vec(m.texture->colors[1])}},
                       {"scale", number(m.texture->scale)}};
  return json;
}

Json density_json(const DensityDesc& d, const Folder& folder);

struct GeometryJson {
  const Folder& folder;
  Json operator()(const SphereDesc& s) const {
    return {{"type", "sphere"}, {"center", vec(s.center)}, {"radius", number(s.radius)}};
  }
  Json operator()(const CylinderDesc& c) const {
    return {{"type", "cylinder"}, {"base", vec(c.base)}, {"top", vec(c.top)}, {"radius", number(c.radius)}};
  }
  Json operator()(const PlaneDesc& p) const {
    return {{"type", "plane"}, {"point", vec(p.point)}, {"normal", vec(p.normal)}};
  }
  Json operator()(const QuadDesc& q) const {
    return {{"type", "quad"}, {"corner", vec(q.corner)}, {"u", vec(q.u)}, {"v", vec(q.v)}};
  }
  Json operator()(const BoxDesc& b) const {
    return {{"type", "box"}, {"min", vec(b.min)}, {"max", vec(b.max)}, {"transform", transform_json(b.transform)}};
  }
  Json operator()(const IsosurfaceDesc& s) const {
    Json json{{"type", "isosurface"},
              {"density", density_json(*s.density, folder)},
              {"iso", number(s.iso)},
              {"transform", transform_json(s.transform)}};
    if (s.bounds) json["bounds"] = {vec((*s.bounds)[0]), vec((*s.bounds)[1])};
    return json;
  }
  Json operator()(const TriangleDesc& t) const {
    return {{"type", "triangle"}, {"vertices", {vec(t.vertices[0]), vec(t.vertices[1]), vec(t.vertices[2])}}};
  }
  Json operator()(const MeshDesc& m) const {
    Json json{{"type", "mesh"},
              {"file", path_text(m.file, folder)},
              {"shading", family_name(mesh_shading_family(), static_cast<int>(m.shading))},
              {"transform", transform_json(m.transform)}};
    if (m.crease) json["crease"] = number(*m.crease);
    if (!m.instance_file.empty()) json["instances"] = path_text(m.instance_file, folder);
    for (const TransformDesc& instance : m.instances) json["instances"].push_back(transform_json(instance));
    return json;
  }
};

// What leaves the values of the file alone is not written.
Json file_density_json(const DensityDesc& d, const Folder& folder) {
  Json json{{"type", "file"}, {"path", path_text(d.file, folder)}};
  if (!d.grid.empty()) json["grid"] = d.grid;
  if (d.level_set != LEVEL_SET_REFUSE) json["level_set"] = family_name(level_set_family(), d.level_set);
  if (d.threshold) json["threshold"] = number(*d.threshold);
  for (const dvec2& point : d.remap) json["remap"].push_back({number(point.x), number(point.y)});
  if (d.factor != 1) json["scale"] = number(d.factor);
  if (d.negative != NEGATIVE_CLAMP) json["negative"] = family_name(negative_family(), d.negative);
  return json;
}

Json density_json(const DensityDesc& d, const Folder& folder) {
  if (d.type == "file") return file_density_json(d, folder);
  if (d.type == "sphere") return {{"type", "sphere"}, {"of", density_json(*d.of, folder)}};
  Json json{{"type", d.type}, {"resolution", {d.resolution.x, d.resolution.y, d.resolution.z}}};
  if (d.type == "constant") json["value"] = number(d.value);
  if (d.type == "perlin") {
    json["scale"] = number(d.scale);
    json["octaves"] = d.octaves;
    json["seed"] = d.seed;
  }
  if (d.type == "ball") {
    json["radius"] = number(d.radius);
    json["ramp"] = number(d.ramp);
  }
  return json;
}

static_assert(METHOD_AUTO == -1 && SHADOW_AUTO == -1 && IN_SCATTERING_AUTO == -1, "one number for all");
Json auto_or_name(const Family& family, int id) { return id == METHOD_AUTO ? "auto" : family_name(family, id); }

Json render_json(const RenderDesc& r) {
  Json json{{"integrator", family_name(integrator_family(), r.integrator)},
            {"directions", r.directions},
            {"rotate", r.rotate},
            {"method", auto_or_name(method_family(), r.method)},
            {"step", number(r.step)},
            {"tolerance", number(r.tolerance)},
            {"in_scattering", auto_or_name(in_scattering_family(), r.in_scattering)},
            {"shadow", auto_or_name(shadow_family(), r.shadow)},
            {"light_grid", r.light_grid},
            {"light_samples", r.light_samples},
            {"light_points", family_name(light_points_family(), r.light_points)},
            {"storage", family_name(storage_family(), r.storage)},
            {"level", r.level},
            {"roulette", r.roulette},
            {"max_depth", r.max_depth},
            {"cutoff", number(r.cutoff)},
            {"bvh", family_name(bvh_family(), r.bvh)},
            {"seed", r.seed}};
  if (r.distance) json["distance"] = number(*r.distance);
  if (r.light_picks != LIGHT_PICKS_AUTO) json["light_picks"] = r.light_picks;
  if (r.shadow_of_glass) json["shadow_of_glass"] = family_name(glass_shadow_family(), *r.shadow_of_glass);
  if (r.max_error) json["max_error"] = number(*r.max_error);
  if (r.time_budget) json["time_budget"] = number(*r.time_budget);
  if (r.has_goal()) json["error_metric"] = family_name(error_metric_family(), r.error_metric);
  return json;
}

static_assert(MEDIUM_TYPE_COUNT == 2 && LIQUID_MODEL_COUNT == 2, "medium_json and liquid_json know the keys of all");

// What a liquid has beside where it stands and what it absorbs.
void liquid_json(const MediumDesc& m, const std::vector<MaterialDesc>& materials, Json& json) {
  const LiquidDesc& l = m.liquid;
  json["model"] = family_name(liquid_model_family(), l.model);
  json["presence"] = family_name(presence_family(), m.density.presence.value_or(PRESENCE_REFUSE));
  if (l.model == LIQUID_SURFACE) {
    json["iso"] = number(l.iso);
    if (l.material >= 0) json["material"] = materials[static_cast<std::size_t>(l.material)].name;
    return;
  }
  json["outside"] = number(l.outside);
  json["inside"] = number(l.inside);
  json["light_intensity"] = number(l.light_intensity);
  json["albedo"] = vec(l.albedo);
  json["specular"] = vec(l.specular);
  json["shininess"] = number(l.shininess);
  json["ambient"] = vec(l.ambient);
  json["grazing_correction"] = l.grazing_correction;
  if (l.slices) json["slices"] = *l.slices;
}

Json medium_json(const MediumDesc& m, const std::vector<MaterialDesc>& materials, const Folder& folder) {
  Json json{{"type", family_name(medium_family(), m.type)}};
  if (m.bounds) json["bounds"] = {vec((*m.bounds)[0]), vec((*m.bounds)[1])};
  if (!m.transform.empty()) json["transform"] = transform_json(m.transform);
  json["interpolation"] = family_name(interpolation_family(), m.interpolation);
  json["density"] = density_json(m.density, folder);
  if (m.emission_density) json["emission_density"] = density_json(*m.emission_density, folder);
  json["sigma_a"] = vec(m.sigma_a);
  if (m.type == MEDIUM_LIQUID) {
    liquid_json(m, materials, json);
  } else {
    json["sigma_s"] = vec(m.sigma_s);
    json["emission"] = vec(m.emission);
    json["phase"] = {{"type", family_name(phase_family(), m.phase)}};
    if (phase_takes_g(m.phase)) json["phase"]["g"] = number(m.g);
  }
  if (m.method) json["method"] = auto_or_name(method_family(), *m.method);
  if (m.step) json["step"] = number(*m.step);
  if (m.tolerance) json["tolerance"] = number(*m.tolerance);
  return json;
}

Json scene_json(const SceneDesc& desc, const Folder& folder) {
  Json json;
  json["camera"] = camera_json(desc.camera);
  json["film"] = {{"size", {desc.film.size.x, desc.film.size.y}},
                  {"spp", desc.film.spp},
                  {"exposure", number(desc.film.exposure)},
                  {"transfer", family_name(transfer_family(), desc.film.transfer)}};
  json["background"] = vec(desc.background);
  json["ambient"] = vec(desc.ambient);
  json["lights"] = Json::array();
  for (const LightDesc& l : desc.lights) json["lights"].push_back(light_json(l));
  json["materials"] = Json::object();
  for (const MaterialDesc& m : desc.materials) json["materials"][m.name] = material_json(m, folder);
  json["shapes"] = Json::array();
  for (const ShapeDesc& s : desc.shapes) {
    Json shape = std::visit(GeometryJson{folder}, s.geometry);
    if (s.material >= 0) shape["material"] = desc.materials[static_cast<std::size_t>(s.material)].name;
    json["shapes"].push_back(shape);
  }
  json["media"] = Json::array();
  for (const MediumDesc& m : desc.media) json["media"].push_back(medium_json(m, desc.materials, folder));
  json["render"] = render_json(desc.render);
  return json;
}

}  // namespace

std::string camera_write(const CameraDesc& camera) { return json_text(camera_json(camera)); }

std::string scene_write(const SceneDesc& desc, const Folder& folder) {
  try {
    return json_text(scene_json(desc, folder));
  } catch (const nlohmann::json::
               type_error&) {  // of dump(): the only text that is not from a scene file is a name of a file
    throw InputError(desc.file.string() + ": the name of a file is not UTF-8, a scene cannot hold it");
  }
}

}  // namespace brume
