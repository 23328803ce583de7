// See media_methods.hpp.
#include "flat/media_methods.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

bool density_is_constant(const DensityDesc& d) {
  return d.type == "constant" || (d.type == "sphere" && d.of && d.of->type == "constant");
}

// What a method must fit for this medium: FITS_x bits, any of which will do.
int medium_fits(const MediumDesc& m) {
  if (m.type == MEDIUM_LIQUID) return FITS_PRESENCE;
  return (m.interpolation == INTERPOLATION_NEAREST ? FITS_NEAREST : FITS_TRILINEAR) |
         (density_is_constant(m.density) ? FITS_CONSTANT : 0);
}

std::string methods_that_fit(int fits) {
  std::string names = "auto";
  for (const FamilyRow& row : method_family())
    if (method_fits(row.id) & fits) names += ", " + std::string(row.name);
  return names;
}

int method_exact(const MediumDesc& m) {
  if (m.type == MEDIUM_LIQUID) return method_exact_of(FITS_PRESENCE);
  if (m.density.type == "constant") return method_exact_of(FITS_CONSTANT);
  return method_exact_of(m.interpolation == INTERPOLATION_NEAREST ? FITS_NEAREST : FITS_TRILINEAR);
}

std::string method_name(int method) { return std::string(family_name(method_family(), method)); }

[[noreturn]] void refuse_method(const SceneDesc& desc, const std::string& place, int method, const MediumDesc& m) {
  const std::string kind = m.type == MEDIUM_LIQUID
                               ? "presence"
                               : std::string(family_name(interpolation_family(), m.interpolation)) + " density";
  throw InputError(desc.file.string() + ": " + place + "/method: '" + method_name(method) + "' does not fit the " +
                   kind + " '" + m.density.type + "' of " + m.place +
                   "; these do: " + methods_that_fit(medium_fits(m)));
}

// A grid of depths to the lights is for what scatters, and not for methods whose collisions differ from run to run of a
// light ray: frozen into it their noise would be an error that no number of samples mends.
void light_grids_check(const SceneDesc& desc, const std::vector<MediumRow>& media) {
  const auto scatters = [](const MediumDesc& m) { return m.sigma_s != dvec3(0); };
  if (desc.render.shadow != SHADOW_GRID) return;
  if (!desc.media.empty() && std::none_of(desc.media.begin(), desc.media.end(), scatters))
    throw InputError(desc.file.string() + ": /render/shadow: 'grid' does not fit " + desc.media.front().place +
                     ", nor any other medium: sigma_s is 0, no light is scattered; allowed: trace, auto");
  for (const MediumRow& m : media) {
    const int method = method_resolve(desc, *m.desc);
    if (method_draws(method) == DRAWS_COLLISIONS)
      throw InputError(desc.file.string() + ": /render/shadow: 'grid' does not fit the method '" + method_name(method) +
                       "', whose error only falls over many light rays; allowed with it: trace, auto");
  }
}

// One line about the media that take another method than the picture asks for; refused where all do that have none of
// their own.
void methods_tell(const SceneDesc& desc, const std::vector<MediumRow>& media, std::vector<std::string>& notes) {
  if (desc.render.method == METHOD_AUTO) return;
  std::string others;
  const MediumRow* first = nullptr;
  bool fits_one = false;
  for (const MediumRow& m : media) {
    if (m.desc->method) continue;
    const int method = method_resolve(desc, *m.desc);
    fits_one = fits_one || method == desc.render.method;
    if (method == desc.render.method) continue;
    if (!first) first = &m;
    others += (others.empty() ? "" : ", ") + m.desc->place + " takes " + method_name(method);
  }
  if (!first) return;
  if (!fits_one) refuse_method(desc, "/render", desc.render.method, *first->desc);
  notes.push_back("/render/method: '" + method_name(desc.render.method) + "' does not fit all media: " + others);
}

}  // namespace

int method_resolve(const SceneDesc& desc, const MediumDesc& m) {
  const int wanted = m.method.value_or(desc.render.method);
  if (wanted == METHOD_AUTO) return method_exact(m);
  if (method_fits(wanted) & medium_fits(m)) return wanted;
  if (m.method) refuse_method(desc, m.place, wanted, m);
  return method_exact(m);
}

int in_scattering_resolve(const SceneDesc& desc) {
  if (desc.render.in_scattering != IN_SCATTERING_AUTO) return desc.render.in_scattering;
  if (desc.render.shadow == SHADOW_GRID) return IN_SCATTERING_SEGMENT;
  const bool exact = std::all_of(desc.media.begin(), desc.media.end(), [&](const MediumDesc& m) {
    return m.sigma_s == dvec3(0) || method_resolve(desc, m) == method_exact(m);
  });
  return exact ? IN_SCATTERING_GAUSS2 : IN_SCATTERING_SEGMENT;
}

bool takes_constant(const SceneDesc& desc, const MediumDesc& m) {
  return density_is_constant(m.density) && (method_fits(method_resolve(desc, m)) & FITS_CONSTANT);
}

void media_check(const SceneDesc& desc, const std::vector<MediumRow>& media, std::vector<std::string>& notes) {
  methods_tell(desc, media, notes);
  light_grids_check(desc, media);
}

std::vector<MediumRow> media_rows(const SceneDesc& desc) {
  std::vector<MediumRow> rows;
  for (const MediumDesc& m : desc.media) {
    if (is_liquid(m, LIQUID_SURFACE)) continue;
    auto body = std::make_shared<MediumDesc>(m);
    if (m.emission_density) {  // a medium of its own that only glows
      auto glow = std::make_shared<MediumDesc>(m);
      glow->density = *m.emission_density;
      glow->place += "/emission_density";
      if (m.method && *m.method != METHOD_AUTO && !(method_fits(*m.method) & medium_fits(*glow)))
        glow->method = METHOD_AUTO;  // it is said for the density
      glow->sigma_a = glow->sigma_s = body->emission = dvec3(0);
      rows.push_back({glow, true});
    }
    rows.push_back({body, false});
  }
  return rows;
}

}  // namespace brume
