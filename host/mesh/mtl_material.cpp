// Illumination models and transparency. See mtl_material.hpp.
#include "mesh/mtl_material.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace brume {

namespace {

using glm::dvec3;

constexpr double SHININESS_MAX = 1e6;

// What "illum n" asks for, by n; `told`: what brume leaves out of it.
struct Illum {
  bool highlight, mirror, glass;
  const char* told;
};
constexpr Illum ILLUMS[] = {{false, false, false, nullptr},  // 0: no light, the color itself
                            {false, false, false, nullptr},
                            {true, false, false, nullptr},
                            {true, true, false, nullptr},
                            {true, true, false, "is shown as 3: glass that does not refract is opaque here"},
                            {true, true, false, "is shown as 3, without Fresnel's law"},
                            {true, true, true, nullptr},
                            {true, true, true, "is shown as 6, without Fresnel's law"},
                            {true, false, false, "is shown as 2: a reflection that is not traced needs a map"},
                            {true, false, false, "is shown as 2: glass that does not refract is opaque here"},
                            {true, false, false, "is shown as 2: shadows on what is not seen are left out"}};
constexpr int ILLUM_MAX = static_cast<int>(std::size(ILLUMS)) - 1;

double mean(const dvec3& c) { return (c.x + c.y + c.z) / 3; }
bool colored(const dvec3& c) { return c.x != c.y || c.y != c.z; }

class Conversion {
 public:
  Conversion(const MtlMaterial& m, LineNotes& notes) : m_(m), notes_(notes) {}

  MeshMaterial run() {
    const int number = illum_number();
    const Illum& illum = ILLUMS[number];
    colors();
    if (!illum.highlight) out_.specular = dvec3(0);
    if (illum.mirror) out_.reflection = weight(positive(m_.specular), "Ks");
    const double dissolve = m_.dissolve ? *m_.dissolve : 1 - m_.transparency.value_or(0);
    if (illum.glass)
      glass(number);
    else if (dissolve < 1)
      tell("is transparent (d or Tr); it is shown opaque");
    if (number == 0) unlit();
    return out_;
  }

 private:
  void tell(const std::string& what) { notes_.add(m_.line, "material '" + m_.name + "' " + what, what); }

  int illum_number() {
    if (!m_.illum) return 2;
    if (!(*m_.illum >= 0 && *m_.illum <= ILLUM_MAX) || *m_.illum != std::floor(*m_.illum)) {
      tell("has an illum that is not a whole number from 0 to 10; it is shown as 2");
      return 2;
    }
    const int number = static_cast<int>(*m_.illum);
    if (ILLUMS[number].told) tell("has illum " + std::to_string(number) + ", which " + ILLUMS[number].told);
    return number;
  }

  static dvec3 positive(const std::optional<dvec3>& color) { return glm::max(color.value_or(dvec3(0)), dvec3(0)); }

  void colors() {
    out_.name = m_.name;
    out_.specular = positive(m_.specular);
    out_.ambient = positive(m_.ambient);
    out_.emission = positive(m_.emission);
    out_.texture = m_.diffuse_map;
    out_.emission_texture = m_.emission_map;
    const bool has_map = !m_.diffuse_map.file.empty();
    if (m_.diffuse) {
      out_.diffuse = positive(m_.diffuse);
    } else if (has_map) {
      out_.diffuse = dvec3(1);
    } else {
      tell("has no Kd; it is grey, 0.5");
    }
    if (std::max({out_.diffuse.x, out_.diffuse.y, out_.diffuse.z}) > 1)
      tell("has a Kd above 1: it sends back more light than arrives");
    if (has_map && out_.diffuse == dvec3(0)) tell("has a map_Kd, but Kd 0, which makes it black");
    if (!m_.emission_map.file.empty() && !m_.emission) out_.emission = dvec3(1);
    if (!m_.emission_map.file.empty()) tell("has a map_Ke: it glows, but lights nothing else");
    if (m_.shininess) out_.shininess = std::clamp(*m_.shininess, 0.0, SHININESS_MAX);
    if (m_.shininess && out_.shininess != *m_.shininess) tell("has an Ns outside 0 to 1e6; the nearest is taken");
  }

  // brume weighs mirrored and transmitted rays by one number.
  double weight(const dvec3& color, const std::string& name) {
    if (colored(color)) tell("has a colored " + name + "; mirrors and glass are grey here");
    if (mean(color) > 1) tell("has a " + name + " above 1; mirrors and glass have 1");
    return std::min(mean(color), 1.0);
  }

  // What is not mirrored goes on inside: (1 - Ks) Tf. Files without Tf mean clear glass, or say with d how clear.
  void glass(int number) {
    const double clear = m_.dissolve ? 1 - *m_.dissolve : m_.transparency.value_or(1);
    const double through = m_.filter ? weight(positive(m_.filter), "Tf") : std::clamp(clear, 0.0, 1.0);
    out_.refraction = (1 - out_.reflection) * through;
    if (!(through > 0)) tell("has illum " + std::to_string(number) + ", but Tf 0 or d 1: it is opaque");
    if (!m_.ior) return;
    if (*m_.ior > 0)
      out_.ior = *m_.ior;
    else
      tell("has an Ni that is not above 0; 1.5 is taken");
  }

  // The color itself, whatever the light.
  void unlit() {
    if (m_.emission && positive(m_.emission) != dvec3(0)) tell("has illum 0, which leaves its Ke out");
    out_.emission = out_.diffuse;
    out_.emission_texture = out_.texture;
    out_.texture = {};
    out_.diffuse = out_.ambient = dvec3(0);
  }

  const MtlMaterial& m_;
  LineNotes& notes_;
  MeshMaterial out_;
};

}  // namespace

MeshMaterial mtl_material(const MtlMaterial& m, LineNotes& notes) { return Conversion(m, notes).run(); }

}  // namespace brume
