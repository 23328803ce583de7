// See volume_convert.hpp: values become densities, and what is none is cleaned or refused.
#include "volume/volume_convert.hpp"

#include <array>
#include <cfloat>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "base/error.hpp"
#include "base/number_text.hpp"

namespace brume {

namespace {

constexpr double ROUNDING = 1e-5;  // of the largest density: what simulations leave of numbers that should be 0

std::string text(ivec3 i) {
  return "[" + std::to_string(i.x) + ", " + std::to_string(i.y) + ", " + std::to_string(i.z) + "]";
}

ivec3 vec(const std::int32_t* v) { return {v[0], v[1], v[2]}; }

double remapped(const std::vector<dvec2>& points, double value) {
  std::size_t i = 0;
  while (i < points.size() && points[i].x < value) ++i;
  if (i == 0) return points.front().y;
  if (i == points.size()) return points.back().y;
  return glm::mix(points[i - 1].y, points[i].y, (value - points[i - 1].x) / (points[i].x - points[i - 1].x));
}

}  // namespace

VolumeConvert::VolumeConvert(const VolumeProgram::GridHead& grid, std::string place, const VolumeValues& values,
                             std::uint64_t bytes_max)
    : head_(grid),
      place_(std::move(place)),
      values_(values),
      bytes_max_(bytes_max),
      plain_(!values.fill && !values.threshold && values.remap.empty() && values.scale == 1) {}

double VolumeConvert::density(double value) const {
  if (values_.fill) value = glm::clamp(0.5 - value / voxel_, 0.0, 1.0);
  if (values_.threshold && value < *values_.threshold) return 0;
  if (!values_.remap.empty()) value = remapped(values_.remap, value);
  return value * values_.scale;
}

void VolumeConvert::topology(const VolumeTopology& t) {
  topology_ = t;
  origin_ = t.active > 0 ? vec(t.lo) : ivec3(0);
  const glm::i64vec3 size =
      t.active > 0 ? glm::i64vec3(vec(t.hi)) - glm::i64vec3(origin_) + std::int64_t{1} : glm::i64vec3(1);
  grid_expect_fits(place_, size, 0, bytes_max_);
  // Sample i of the lattice, at i + 0.5, is voxel i + origin.
  const dmat4 world_from_index = glm::make_mat4(head_.head.world_from_index);
  const double volume = glm::determinant(glm::dmat3(world_from_index));
  if (!std::isfinite(volume) || volume == 0 || !std::isfinite(glm::determinant(world_from_index)))
    throw InputError(place_ + ": its transform is singular or not finite; the file is damaged");
  voxel_ = std::cbrt(std::abs(volume));
  grid_ = Grid(ivec3(size));
  grid_.source = place_;
  grid_.border = Border::ZERO;
  grid_.world_from_lattice = glm::translate(world_from_index, dvec3(origin_) - 0.5);
  if (t.stale)
    grid_.notes.push_back(place_ + ": its metadata are of another state of the grid: " + std::to_string(t.active) +
                          " voxels are active");
}

// The density of `voxels` voxels from `index` on.
float VolumeConvert::judge(float value, ivec3 index, std::uint64_t voxels) {
  const double d = std::isfinite(value) ? density(value) : value;
  if (!(std::abs(d) <= FLT_MAX)) {
    if (wild_.count == 0) wild_ = {0, index, d};
    wild_.count += voxels;
    return 0;
  }
  largest_ = std::max(largest_, d);
  if (d >= 0) return static_cast<float>(d);
  if (d < negative_.value) negative_ = {negative_.count, index, d};
  negative_.count += voxels;
  return 0;
}

void VolumeConvert::leaf(const VolumeLeaf& leaf) {
  const ivec3 origin = vec(leaf.origin);
  const glm::i64vec3 away = glm::i64vec3(origin) - glm::i64vec3(origin_);
  // Only a damaged process sends what lies wholly outside of the box of the active voxels.
  if (glm::any(glm::lessThan(away, glm::i64vec3(-7))) ||
      glm::any(glm::greaterThanEqual(away, glm::i64vec3(grid_.size()))))
    return;
  const ivec3 first(away);
  const bool whole =
      glm::all(glm::greaterThanEqual(first, ivec3(0))) && glm::all(glm::lessThanEqual(first, grid_.size() - 8));
  std::array<float, 512> densities{};
  float largest = 0;
  for (int n = 0; n < 512; ++n) {
    if (!(leaf.active[n >> 6] >> (n & 63) & 1)) continue;
    const ivec3 at(n >> 6, (n >> 3) & 7, n & 7), i = first + at;
    if (!whole && (glm::any(glm::lessThan(i, ivec3(0))) || glm::any(glm::greaterThanEqual(i, grid_.size())))) continue;
    const float value = leaf.values[n];
    float& out = densities[static_cast<std::size_t>((((at.z << 3) | at.y) << 3) | at.x)];
    if (plain_ && value >= 0 && value <= FLT_MAX) {
      out = value;
      largest = std::max(largest, value);
    } else {
      out = judge(value, origin + at, 1);
    }
  }
  largest_ = std::max<double>(largest_, largest);
  grid_.set_cube(first, densities.data());
}

void VolumeConvert::tile(const VolumeTile& tile) {
  const ivec3 lo = glm::max(vec(tile.lo), origin_), hi = glm::min(vec(tile.hi), origin_ + (grid_.size() - 1));
  if (glm::any(glm::greaterThan(lo, hi))) return;
  const glm::u64vec3 side(hi - lo + 1);
  const float d = judge(tile.value, lo, side.x * side.y * side.z);
  if (d != 0) grid_.fill(lo - origin_, hi - origin_, d);
}

void VolumeConvert::finish_negative() {
  if (negative_.count == 0) return;
  const std::string found = std::to_string(negative_.count) + " voxels are negative, the lowest at index " +
                            text(negative_.first) + " with " + number_text(negative_.value);
  if (!values_.clamp_negative)
    throw InputError(place_ + ": " + found + "; allowed are densities >= 0, \"negative\": \"clamp\" forgives rounding");
  if (-negative_.value > ROUNDING * largest_)
    throw InputError(place_ + ": " + found +
                     "; allowed are densities >= 0 and rounding down to -1e-5 of the largest, " +
                     number_text(largest_) + "; \"threshold\": 0 drops all that are negative");
  grid_.notes.push_back(place_ + ": " + found + ", next to " + number_text(largest_) + " rounding: they are read as 0");
}

// Beyond the voxels of a file there is nothing: a medium ends somewhere. With `remap` that is for the scene to say.
void VolumeConvert::finish_background() {
  if (values_.fill || !values_.remap.empty()) return;
  const double b = density(topology_.background);
  if (b == 0) return;
  if (!(std::abs(b) <= ROUNDING * largest_) || (b < 0 && !values_.clamp_negative))
    throw InputError(place_ + ": has the background " + number_text(topology_.background) +
                     "; allowed is 0, since a medium ends somewhere, and rounding up to 1e-5 of the largest density");
  grid_.notes.push_back(place_ + ": its background " + number_text(topology_.background) +
                        " is rounding, and read as 0");
}

Grid VolumeConvert::take(const VolumeReadEnd& end) {
  if (wild_.count > 0)
    throw InputError(place_ + ": " + std::to_string(wild_.count) +
                     " voxels are NaN, infinite or beyond 3.4e38, the first at index " + text(wild_.first) + " with " +
                     number_text(wild_.value) + "; allowed are finite densities >= 0");
  finish_negative();
  finish_background();
  if (end.inactive > 0 && !values_.fill)
    grid_.notes.push_back(place_ + ": " + std::to_string(end.inactive) +
                          " voxels hold values but are not active: they are read as 0");
  return std::move(grid_);
}

}  // namespace brume
