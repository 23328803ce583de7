// The table of density sources. A new generator is one file in generators/ and one row here.
#include "volume/density_source.hpp"

#include <iomanip>
#include <sstream>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "base/number_text.hpp"
#include "volume/generators/generators.hpp"

namespace brume {

namespace {

Grid density_file(const DensitySpec& spec) { return volume_read(spec.file, spec.grid, spec.values); }

struct DensityRow {
  std::string_view name, help;
  Grid (*make)(const DensitySpec&);
};
constexpr DensityRow DENSITIES[] = {
    {"constant", "value everywhere", density_constant},
    {"linear", "1 at the bottom of y, 0 at the top", density_linear},
    {"exponential", "exp(-y), y from 0 at the bottom to 1 at the top", density_exponential},
    {"perlin", "fractal sum of Perlin noise in [0, 1]: scale, octaves, seed", density_perlin},
    {"sphere", "`of` within the inscribed ellipsoid, 0 outside", density_sphere},
    {"ball", "1 within a ball, 0 outside, even over a ramp about its surface: radius, ramp", density_ball},
    {"file", "a grid of a volume file: path, grid, and how its values become densities", density_file}};

// Values in [0, 1], by the rule.
void presence_apply(Presence rule, Grid& grid) {
  const GridStats stats = grid_stats(grid);
  if (!(stats.max > 1)) return;
  if (rule == Presence::REFUSE)
    throw InputError(
        grid.source + ": presence from " + number_text(stats.min) + " to " + number_text(stats.max) +
        "; allowed are values in [0, 1]. \"presence\": \"scale\" divides by the largest, \"clamp\" cuts at 1");
  const float largest = stats.max;
  grid_visit_stored(grid, [&](ivec3 i, float value) {
    const float now = rule == Presence::SCALE ? value / largest : std::min(value, 1.0f);
    if (now != value) grid.set(i, now);
  });
}

}  // namespace

const Family& density_family() {
  static const Family family = [] {
    Family rows;
    for (const DensityRow& row : DENSITIES) rows.push_back({static_cast<int>(rows.size()), row.name, row.help});
    return rows;
  }();
  return family;
}

std::string density_key(const DensitySpec& spec) {
  std::ostringstream key;
  key.precision(17);
  key << spec.type << ' ' << spec.resolution.x << ' ' << spec.resolution.y << ' ' << spec.resolution.z << ' '
      << spec.value << ' ' << spec.scale << ' ' << spec.octaves << ' ' << spec.seed << ' ' << spec.radius << ' '
      << spec.ramp << ' ' << static_cast<int>(spec.presence);
  if (spec.type == "file") {
    const VolumeValues& v = spec.values;
    key << ' ' << std::quoted(file_key(spec.file)) << ' ' << std::quoted(spec.grid) << ' ' << v.fill << ' '
        << v.threshold.has_value() << ' ' << v.threshold.value_or(0) << ' ' << v.scale << ' ' << v.clamp_negative;
    for (const dvec2& point : v.remap) key << ' ' << point.x << ' ' << point.y;
  }
  return key.str() + (spec.of ? " of " + density_key(*spec.of) : "");
}

Grid density_make(const DensitySpec& spec) {
  const FamilyRow* row = family_find(density_family(), spec.type);
  if (!row) throw InputError("density: unknown type '" + spec.type + "'; known: " + family_names(density_family()));
  Grid grid = DENSITIES[row->id].make(spec);
  if (grid.source.empty()) grid.source = spec.type;
  if (spec.presence != Presence::NONE) presence_apply(spec.presence, grid);
  return grid;
}

}  // namespace brume
