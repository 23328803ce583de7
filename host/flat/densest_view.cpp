// Every voxel is added to a coarse picture, whose pixels are a few voxels wide. Where its sums are largest, rays are
// integrated exactly, and the best of them is moved as long as that makes it denser. What is blurred in the picture is
// exact along the rays. What is lost in it is no wider than a voxel: so the densest voxel of a pixel is tried as well.
#include "flat/densest_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "flat/transform.hpp"

namespace brume {

namespace {

using glm::dvec2;

constexpr int PICTURE_MAX = 1024;  // pixels along a side
constexpr double BOXES_MAX = 1e8;  // tests of a block against a ray that may be spent
constexpr int RAYS_MIN = 24, RAYS_MAX = 512;
constexpr int UPHILL = 24;  // rounds

// A view: (u, v) on a plane at distance 1.
struct View {
  dvec3 eye, forward, right, above;
  dvec3 direction(double u, double v) const { return glm::normalize(forward + u * right + v * above); }
};

View view_make(const dvec3& eye, const dvec3& target) {
  View view{eye, glm::normalize(target - eye), dvec3(0), dvec3(0)};
  view.right = tangent(view.forward);
  view.above = glm::cross(view.right, view.forward);
  return view;
}

// Part of the line p + t d that lies in the box, in t.
bool box_clip(const dvec3& p, const dvec3& d, const dvec3& lo, const dvec3& hi, double& t0, double& t1) {
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) {
      if (p[axis] < lo[axis] || p[axis] > hi[axis]) return false;
      continue;
    }
    const double a = (lo[axis] - p[axis]) / d[axis], b = (hi[axis] - p[axis]) / d[axis];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 < t1;
}

// What the samples of one block add to the density at q, in samples from the block's first.
double block_at(const float* samples, const dvec3& q) {
  const dvec3 cell = glm::floor(q), f = q - cell;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 bit(corner & 1, corner >> 1 & 1, corner >> 2), i = ivec3(cell) + bit;
    if (((i.x | i.y | i.z) & ~7) != 0) continue;
    const dvec3 w = glm::mix(1.0 - f, f, dvec3(bit));
    sum += w.x * w.y * w.z * samples[(i.z << 6) | (i.y << 3) | i.x];
  }
  return sum;
}

// Between the crossings of the planes through the samples the density is a cubic: two points of Gauss are exact.
double block_integral(const float* samples, const dvec3& p, const dvec3& d, double t0, double t1) {
  double crossings[32];
  int count = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int plane = 0; plane < GRID_BLOCK && d[axis] != 0; ++plane) {
      const double t = (plane - p[axis]) / d[axis];
      if (t > t0 && t < t1) crossings[count++] = t;
    }
  crossings[count++] = t1;
  std::sort(crossings, crossings + count);
  double sum = 0, begin = t0;
  for (int i = 0; i < count; begin = crossings[i++]) {
    const double half = 0.5 * (crossings[i] - begin), m = begin + half, g = half / std::sqrt(3.0);
    sum += half * (block_at(samples, p + (m - g) * d) + block_at(samples, p + (m + g) * d));
  }
  return sum;
}

struct Pixel {
  double sum = 0, u = 0, v = 0;             // ∫ρ, and where its middle is, times the sum
  double most = 0, most_u = 0, most_v = 0;  // the densest voxel alone
};

class Picture {
 public:
  Picture(const View& view, const Grid& grid, const std::vector<ivec3>& blocks) : view_(view), grid_(grid) {
    const glm::dmat3 eye_from_world = glm::transpose(glm::dmat3(view.right, view.above, view.forward));
    eye_from_lattice_ = eye_from_world * glm::dmat3(grid.world_from_lattice);
    eye_ = eye_from_world * (dvec3(grid.world_from_lattice[3]) - view.eye);
    bounds_find(blocks);
    for (const ivec3& b : blocks) block_add(b);
  }
  // Directions to try, the likeliest first.
  std::vector<dvec2> candidates(std::size_t count) const {
    std::vector<std::pair<double, dvec2>> all;
    for (const Pixel& p : pixels_) {
      if (p.sum > 0) all.push_back({p.sum, {p.u / p.sum, p.v / p.sum}});
      if (p.most > 0) all.push_back({p.most, {p.most_u, p.most_v}});
    }
    count = std::min(count, all.size());
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                      [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<dvec2> directions;
    for (std::size_t i = 0; i < count; ++i) directions.push_back(all[i].second);
    return directions;
  }
  double pixel() const { return pixel_; }

 private:
  dvec3 seen(const dvec3& lattice) const {  // u, v, depth
    const dvec3 p = eye_from_lattice_ * lattice + eye_;
    const double inverse = 1 / p.z;
    return {p.x * inverse, p.y * inverse, p.z};
  }
  void bounds_find(const std::vector<ivec3>& blocks);
  void block_add(const ivec3& b);
  void row_add(const dvec3& first, const float* samples);
  void add(const dvec3& seen, double mass);

  const View& view_;
  const Grid& grid_;
  glm::dmat3 eye_from_lattice_;  // to the right, above, ahead of the eye
  dvec3 eye_;
  dvec2 lo_{INFINITY}, hi_{-INFINITY};
  double pixel_ = 0, column_ = 0;  // sides of a pixel and of a voxel in the picture
  double per_pixel_ = 0, per_column_ = 0;
  double voxel_ = 1;  // volume of one
  int width_ = 1, height_ = 1;
  std::vector<Pixel> pixels_;
};

void Picture::bounds_find(const std::vector<ivec3>& blocks) {
  for (const ivec3& b : blocks)
    for (int corner = 0; corner < 8; ++corner) {
      const dvec3 p = seen(dvec3((b + ivec3(corner & 1, corner >> 1 & 1, corner >> 2)) * GRID_BLOCK));
      lo_ = glm::min(lo_, dvec2(p));
      hi_ = glm::max(hi_, dvec2(p));
    }
  const glm::dmat3 edges(grid_.world_from_lattice);
  voxel_ = std::abs(glm::determinant(edges));
  double face = 0;  // the largest that a voxel shows
  for (int i = 0; i < 3; ++i)
    face = std::max(face, std::abs(glm::dot(glm::cross(edges[i], edges[(i + 1) % 3]), view_.forward)));
  column_ = std::sqrt(face) / seen(0.5 * dvec3(grid_.size())).z;
  pixel_ = std::max(column_, std::max(hi_.x - lo_.x, hi_.y - lo_.y) / PICTURE_MAX);
  width_ = static_cast<int>((hi_.x - lo_.x) / pixel_) + 1;
  height_ = static_cast<int>((hi_.y - lo_.y) / pixel_) + 1;
  per_pixel_ = 1 / pixel_;
  per_column_ = 1 / column_;
  pixels_.resize(std::size_t(width_) * std::size_t(height_));
}

void Picture::block_add(const ivec3& b) {
  const float* samples = grid_.block(b);
  const dvec3 first = dvec3(b * GRID_BLOCK) + 0.5;
  if (grid_.block_uniform(b)) return add(seen(first + 3.5), 512.0 * samples[0]);
  for (int row = 0; row < 512; row += GRID_BLOCK) row_add(first + dvec3(0, row >> 3 & 7, row >> 6), samples + row);
}

// Voxels along x. Where they are seen is found for all at once.
void Picture::row_add(const dvec3& first, const float* samples) {
  dvec3 p[GRID_BLOCK];
  for (int i = 0; i < GRID_BLOCK; ++i) p[i] = seen(first + dvec3(i, 0, 0));
  for (int i = 0; i < GRID_BLOCK; ++i)
    if (samples[i] > 0) add(p[i], samples[i]);
}

void Picture::add(const dvec3& p, double mass) {
  const int x = std::clamp(static_cast<int>((p.x - lo_.x) * per_pixel_), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>((p.y - lo_.y) * per_pixel_), 0, height_ - 1);
  Pixel& pixel = pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
  const double here = mass * voxel_ / (p.z * p.z), column = here * per_pixel_ * per_pixel_,
               alone = here * per_column_ * per_column_;
  pixel.sum += column;
  pixel.u += column * p.x;
  pixel.v += column * p.y;
  if (alone <= pixel.most) return;
  pixel.most = alone;
  pixel.most_u = p.x;
  pixel.most_v = p.y;
}

}  // namespace

GridBlocks grid_blocks(const Grid& grid) {
  GridBlocks blocks;
  std::map<std::array<int, 3>, std::size_t> known;
  grid_visit_blocks(grid, [&](ivec3 b) {
    const ivec3 group = b / GRID_GROUP;
    const auto [at, is_new] = known.try_emplace({group.x, group.y, group.z}, blocks.groups.size());
    if (is_new) blocks.groups.push_back({group, {}});
    blocks.groups[at->second].members.push_back(static_cast<std::uint32_t>(blocks.all.size()));
    blocks.all.push_back(b);
  });
  return blocks;
}

double grid_line_integral(const Grid& grid, const GridBlocks& blocks, const dvec3& from, const dvec3& dir) {
  const dmat4 lattice_from_world = glm::inverse(grid.world_from_lattice);
  const dvec3 p = transform_point(lattice_from_world, from) - 0.5, d = transform_dir(lattice_from_world, dir);
  struct Met {
    std::uint32_t block;
    double t0, t1;
  };
  std::vector<Met> met;
  const auto meets = [&](const dvec3& q, double margin, double side, double& t0, double& t1) {
    return box_clip(q, d, dvec3(-1 - margin), dvec3(side + margin), t0 = 0, t1 = INFINITY);
  };
  double t0, t1;
  for (const GridBlocks::Group& group : blocks.groups) {
    constexpr int SIDE = GRID_GROUP * GRID_BLOCK;
    if (!meets(p - dvec3(group.index * SIDE), 0.5, SIDE, t0, t1)) continue;
    for (const std::uint32_t i : group.members)
      if (meets(p - dvec3(blocks.all[i] * GRID_BLOCK), 0, GRID_BLOCK, t0, t1)) met.push_back({i, t0, t1});
  }
  std::sort(met.begin(), met.end(),
            [](const Met& a, const Met& b) { return a.block < b.block; });  // one order of adding
  double sum = 0;
  for (const Met& m : met) {
    const ivec3 b = blocks.all[m.block];
    sum += block_integral(grid.block(b), p - dvec3(b * GRID_BLOCK), d, m.t0, m.t1);
  }
  return sum;
}

double grid_densest_view(const Grid& grid, const dvec3& eye, const dvec3& target) {
  const GridBlocks blocks = grid_blocks(grid);
  if (blocks.all.empty()) return 0;
  const View view = view_make(eye, target);
  const Picture picture(view, grid, blocks.all);
  const auto along = [&](const glm::dvec2& at) {
    return grid_line_integral(grid, blocks, eye, view.direction(at.x, at.y));
  };
  const double rays = std::clamp<double>(BOXES_MAX / double(blocks.all.size()), RAYS_MIN, RAYS_MAX);
  const std::vector<glm::dvec2> candidates = picture.candidates(static_cast<std::size_t>(rays));
  if (candidates.empty()) return 0;
  std::vector<double> found(candidates.size());
  const auto every_second = [&](std::size_t first) {
    for (std::size_t i = first; i < candidates.size(); i += 2) found[i] = along(candidates[i]);
  };
  std::future<void> others = std::async(std::launch::async, every_second, 1);
  every_second(0);
  others.get();
  const auto densest = std::max_element(found.begin(), found.end());
  double best = *densest;
  glm::dvec2 at = candidates[static_cast<std::size_t>(densest - found.begin())];
  double step = 0.5 * picture.pixel();
  for (int round = 0; round < UPHILL; ++round) {
    const glm::dvec2 here = at;
    for (const glm::dvec2& way : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
      const double there = along(here + step * way);
      if (there <= best) continue;
      best = there;
      at = here + step * way;
    }
    if (at == here) step *= 0.5;
  }
  return best;
}

}  // namespace brume
