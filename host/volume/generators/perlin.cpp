// Improved Perlin noise [Perlin02] as a fractal sum. The permutation is shuffled by our own generator, so that a seed
// gives the same field on every platform.
//   sum   = Σ_{k < octaves} 2⁻ᵏ noise(2ᵏ p) / Σ 2⁻ᵏ,   p = (i + 0.5) · scale / longest side of the resolution
//   value = clamp(0.5 + 0.5 · sum, 0, 1): mean 0.5; noise itself lies in about [-1, 1]. The lattice repeats after 256
//   cells.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "volume/generators/generators.hpp"

namespace brume {

namespace {

constexpr double SCALE_MAX = 1e9;
constexpr int OCTAVES_MAX = 16;

// SplitMix64 [Steele14].
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double lerp(double t, double a, double b) { return a + t * (b - a); }

// Dot product with one of the 12 directions to the edges of a cube (four of them twice).
double gradient(int hash, double x, double y, double z) {
  const int h = hash & 15;
  const double u = h < 8 ? x : y;
  const double v = h < 4 ? y : h == 12 || h == 14 ? x : z;
  return ((h & 1) ? -u : u) + ((h & 2) ? -v : v);
}

class PerlinNoise {
 public:
  explicit PerlinNoise(int seed) {
    std::iota(table_.begin(), table_.begin() + 256, 0);
    SplitMix random(static_cast<std::uint32_t>(seed));
    for (unsigned i = 255; i > 0; --i) std::swap(table_[i], table_[random.next() % (i + 1)]);
    std::copy_n(table_.begin(), 256, table_.begin() + 256);
  }

  double at(const dvec3& p) const {
    const Axis x(p.x), y(p.y), z(p.z);
    return lerp(fade(z.t), layer(x, y, z.cell, z.t), layer(x, y, (z.cell + 1) & 255, z.t - 1));
  }

 private:
  struct Axis {
    explicit Axis(double p)
        : cell(static_cast<int>(static_cast<std::int64_t>(std::floor(p)) & 255)), t(p - std::floor(p)) {}
    int cell;
    double t;
  };
  int hash(int x, int y, int z) const { return at(at(at(x) + y) + z); }
  int at(int i) const { return table_[static_cast<std::size_t>(i)]; }

  // The four corners at one z, blended along x and y.
  double layer(const Axis& x, const Axis& y, int cell_z, double tz) const {
    double row[2];
    for (int j = 0; j < 2; ++j) {
      const int cell_y = (y.cell + j) & 255;
      row[j] = lerp(fade(x.t), gradient(hash(x.cell, cell_y, cell_z), x.t, y.t - j, tz),
                    gradient(hash((x.cell + 1) & 255, cell_y, cell_z), x.t - 1, y.t - j, tz));
    }
    return lerp(fade(y.t), row[0], row[1]);
  }

  std::array<int, 512> table_;  // the permutation twice, so that a hash plus a cell needs no wrapping
};

}  // namespace

Grid density_perlin(const DensitySpec& spec) {
  if (!(spec.scale > 0 && spec.scale <= SCALE_MAX))
    throw InputError("density 'perlin': scale: expected a number in (0, 1e9], got " + number_text(spec.scale));
  if (spec.octaves < 1 || spec.octaves > OCTAVES_MAX)
    throw InputError("density 'perlin': octaves: expected 1 to 16, got " + std::to_string(spec.octaves));
  const PerlinNoise noise(spec.seed);
  const ivec3 size = spec.resolution;
  const double cells_per_sample = spec.scale / std::max({size.x, size.y, size.z});
  return grid_generate(spec, [&](ivec3 i) {
    dvec3 p = (dvec3(i) + 0.5) * cells_per_sample;
    double sum = 0, weights = 0, amplitude = 1;
    for (int octave = 0; octave < spec.octaves; ++octave, p *= 2.0, amplitude *= 0.5) {
      sum += amplitude * noise.at(p);
      weights += amplitude;
    }
    return std::clamp(0.5 + 0.5 * sum / weights, 0.0, 1.0);
  });
}

}  // namespace brume
