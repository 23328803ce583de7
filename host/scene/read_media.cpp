// "media": bounds, density, coefficients, phase function; of a liquid, how it is lit.
#include <cstdint>

#include "base/number_text.hpp"
#include "scene/families.hpp"
#include "scene/read_parts.hpp"

namespace brume {

namespace {

constexpr int RESOLUTION_MAX = 4096;
constexpr std::int64_t SAMPLES_MAX = 2147483647;

// Keys that a density type reads beside "type" (host/volume's table makes the field).
struct DensityKeys {
  std::string_view name;
  bool resolution, value, noise, file, of, ball;
};
constexpr DensityKeys DENSITIES[] = {
    {"constant", true, true, false, false, false, false},     {"linear", true, false, false, false, false, false},
    {"exponential", true, false, false, false, false, false}, {"perlin", true, false, true, false, false, false},
    {"sphere", false, false, false, false, true, false},      {"ball", true, false, false, false, false, true},
    {"file", false, false, false, true, false, false}};

const Family& density_names() {
  static const Family family = [] {
    Family rows;
    for (const DensityKeys& d : DENSITIES) rows.push_back({static_cast<int>(rows.size()), d.name, ""});
    return rows;
  }();
  return family;
}

ivec3 read_resolution(const JsonValue& value) {
  const std::vector<JsonValue> list = value.as_list();
  if (list.size() != 3) value.fail("expected 3 integers" + value.got());
  ivec3 r;
  for (int i = 0; i < 3; ++i) r[i] = list[i].as_integer(1, RESOLUTION_MAX);
  if (std::int64_t(r.x) * r.y * r.z > SAMPLES_MAX)
    value.fail(std::to_string(std::int64_t(r.x) * r.y * r.z) + " samples; at most " + std::to_string(SAMPLES_MAX) +
               " are allowed");
  return r;
}

std::vector<dvec2> read_remap(const JsonValue& remap) {
  std::vector<dvec2> points;
  for (const JsonValue& pair : remap.as_list()) {
    const std::vector<JsonValue> values = pair.as_list();
    if (values.size() != 2) pair.fail("expected [value, density]" + pair.got());
    points.emplace_back(values[0].as_number(Range::any()), values[1].as_number(Range::at_least_0()));
    if (points.size() > 1 && !(points.back().x > points[points.size() - 2].x))
      pair.fail("expected a value above that of the pair before" + pair.got());
  }
  if (points.empty()) remap.fail("expected [[value, density], ...]" + remap.got());
  return points;
}

// How the values of a file become densities.
void read_values(const JsonValue& density, DensityDesc& d) {
  d.level_set = density.member("level_set", d.level_set, level_set_family(), "level set rule");
  if (density.has("threshold")) d.threshold = density.get("threshold").as_number(Range::any());
  if (density.has("remap")) d.remap = read_remap(density.get("remap"));
  d.factor = density.number("scale", d.factor, Range::at_least_0());
  d.negative = density.member("negative", d.negative, negative_family(), "rule for negative densities");
}

}  // namespace

DensityDesc read_density(const JsonValue& density, const std::filesystem::path& folder) {
  DensityDesc d;
  const DensityKeys& keys = DENSITIES[density.get("type").as_member(density_names(), "density")];
  d.type = std::string(keys.name);
  if (keys.resolution && density.has("resolution")) d.resolution = read_resolution(density.get("resolution"));
  if (keys.value) d.value = density.number("value", d.value, Range::at_least_0());
  if (keys.noise) {
    d.scale = density.number("scale", d.scale, Range::positive());
    d.octaves = density.integer("octaves", d.octaves, 1, 16);
    d.seed = density.integer("seed", d.seed, 0, 0x7fffffff);
  }
  if (keys.ball) {
    d.radius = density.number("radius", d.radius, Range::positive());
    d.ramp = density.number("ramp", d.ramp, Range::positive());
  }
  if (keys.file) {
    d.file = read_path(density.get("path"), folder);
    if (density.has("grid")) d.grid = density.get("grid").as_string();
    read_values(density, d);
  }
  if (keys.of) d.of = std::make_shared<DensityDesc>(read_density(density.get("of"), folder));
  density.refuse_unread();
  return d;
}

std::array<dvec3, 2> read_bounds(const JsonValue& bounds) {
  const std::vector<JsonValue> corners = bounds.as_list();
  if (corners.size() != 2)
    bounds.fail("expected [[x, y, z], [x, y, z]]: the lowest and the highest corner" + bounds.got());
  const std::array<dvec3, 2> b{corners[0].as_vec3(Range::any()), corners[1].as_vec3(Range::any())};
  for (int i = 0; i < 3; ++i)
    if (!(b[0][i] < b[1][i])) bounds.fail("expected the first corner below the second on every axis" + bounds.got());
  return b;
}

namespace {

void read_phase(const JsonValue& phase, MediumDesc& m) {
  m.phase = phase.get("type").as_member(phase_family(), "phase function");
  if (phase_takes_g(m.phase)) m.g = phase.number("g", m.g, Range::open(-1, 1));
  phase.refuse_unread();
}

// 0 <= outside < inside <= 1.
void read_thresholds(const JsonValue& medium, LiquidDesc& l) {
  l.outside = medium.number("outside", l.outside, Range::closed(0, 1));
  l.inside = medium.number("inside", l.inside, Range::closed(0, 1));
  if (static_cast<float>(l.outside) < static_cast<float>(l.inside)) return;
  if (!medium.has("inside"))
    medium.get("outside").fail("expected a presence below that of \"inside\", " + number_text(l.inside) + ", got " +
                               number_text(l.outside));
  medium.get("inside").fail("expected a presence above that of \"outside\", " + number_text(l.outside) + ", got " +
                            number_text(l.inside));
}

void read_local_lighting(const JsonValue& medium, LiquidDesc& l) {
  constexpr int SLICES_MAX = 100000;
  read_thresholds(medium, l);
  l.light_intensity = medium.number("light_intensity", l.light_intensity, Range::at_least_0());
  l.albedo = medium.color("albedo", l.albedo, Range::at_least_0());
  l.specular = medium.color("specular", l.specular, Range::at_least_0());
  l.shininess = medium.number("shininess", l.shininess, Range::closed(0, 1e6));
  l.ambient = medium.color("ambient", l.ambient, Range::at_least_0());
  l.grazing_correction = medium.flag("grazing_correction", l.grazing_correction);
  if (medium.has("slices")) l.slices = medium.get("slices").as_integer(1, SLICES_MAX);
}

void read_liquid(const JsonValue& medium, const std::vector<MaterialDesc>& materials, MediumDesc& m) {
  LiquidDesc& l = m.liquid;
  l.model = medium.member("model", l.model, liquid_model_family(), "model of a liquid");
  m.density.presence = medium.member("presence", PRESENCE_REFUSE, presence_family(), "rule for the presence");
  if (m.interpolation != INTERPOLATION_TRILINEAR)
    medium.get("interpolation").fail("a liquid has its surface between samples; allowed: trilinear");
  if (medium.has("sigma_s"))
    medium.get("sigma_s").fail("a liquid does not scatter, it absorbs (sigma_a) and is lit at its surface");
  if (l.model == LIQUID_LOCAL_LIGHTING) {
    read_local_lighting(medium, l);
    if (medium.has("method")) m.method = read_method(medium, METHOD_AUTO);
    if (medium.has("step")) m.step = read_step(medium, 1);
  }
  if (l.model == LIQUID_SURFACE) {
    l.iso = medium.number("iso", l.iso, Range::open(0, 1));
    l.material = read_material_name(medium, materials);
  }
}

void read_participating(const JsonValue& medium, const std::filesystem::path& folder, MediumDesc& m) {
  m.sigma_s = medium.color("sigma_s", m.sigma_s, Range::at_least_0());
  m.emission = medium.color("emission", m.emission, Range::at_least_0());
  if (medium.has("emission_density"))
    m.emission_density = std::make_shared<DensityDesc>(read_density(medium.get("emission_density"), folder));
  if (medium.has("phase")) read_phase(medium.get("phase"), m);
  if (medium.has("method")) m.method = read_method(medium, METHOD_AUTO);
  if (medium.has("step")) m.step = read_step(medium, 1);
  if (medium.has("tolerance")) m.tolerance = read_tolerance(medium, 1);
}

MediumDesc read_medium(const JsonValue& medium, const std::vector<MaterialDesc>& materials,
                       const std::filesystem::path& folder) {
  MediumDesc m;
  m.place = medium.place();
  m.type = medium.member("type", m.type, medium_family(), "medium");
  if (medium.has("bounds")) m.bounds = read_bounds(medium.get("bounds"));
  m.transform = read_transform(medium);
  m.interpolation = medium.member("interpolation", m.interpolation, interpolation_family(), "interpolation");
  m.density = read_density(medium.get("density"), folder);
  m.sigma_a = medium.color("sigma_a", m.sigma_a, Range::at_least_0());
  if (m.type == MEDIUM_LIQUID)
    read_liquid(medium, materials, m);
  else
    read_participating(medium, folder, m);
  medium.refuse_unread();
  return m;
}

}  // namespace

std::vector<MediumDesc> read_media(const JsonValue& scene, const std::vector<MaterialDesc>& materials,
                                   const std::filesystem::path& folder) {
  std::vector<MediumDesc> media;
  for (const JsonValue& medium : scene.list("media")) media.push_back(read_medium(medium, materials, folder));
  return media;
}

}  // namespace brume
