// Density generators against their formulas, and what their parameters may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>

#include "base/error.hpp"
#include "volume/density_source.hpp"

using namespace brume;
using testing::AllOf;
using testing::HasSubstr;

namespace {

DensitySpec spec_of(const std::string& type, ivec3 resolution) {
  DensitySpec spec;
  spec.type = type;
  spec.resolution = resolution;
  return spec;
}

void for_each(ivec3 size, const std::function<void(ivec3)>& visit) {
  for (ivec3 i(0); i.z < size.z; ++i.z)
    for (i.y = 0; i.y < size.y; ++i.y)
      for (i.x = 0; i.x < size.x; ++i.x) visit(i);
}

void expect_samples(const Grid& grid, const std::function<double(ivec3)>& expected, double tolerance = 1e-7) {
  for_each(grid.size(),
           [&](ivec3 i) { ASSERT_NEAR(grid.at(i), expected(i), tolerance) << i.x << " " << i.y << " " << i.z; });
}

std::string refusal(const DensitySpec& spec) {
  try {
    density_make(spec);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Generators, TheTableNamesThem) {
  EXPECT_EQ(family_names(density_family()), "constant, linear, exponential, perlin, sphere, ball, file");
  for (std::size_t i = 0; i < density_family().size(); ++i) EXPECT_EQ(density_family()[i].id, static_cast<int>(i));
  EXPECT_THAT(refusal(spec_of("fractal", ivec3(4))), AllOf(HasSubstr("'fractal'"), HasSubstr("constant, linear")));
}

TEST(Generators, FillTheirLatticeAndClamp) {
  for (const char* type : {"constant", "linear", "exponential", "perlin", "ball"}) {
    const Grid grid = density_make(spec_of(type, {3, 7, 5}));
    EXPECT_EQ(grid.size(), ivec3(3, 7, 5));
    EXPECT_EQ(grid.border, Border::CLAMP);
    EXPECT_EQ(grid.world_from_lattice, dmat4(1.0));
    EXPECT_EQ(grid.source, type);
  }
}

TEST(Generators, ConstantLinearExponential) {
  DensitySpec constant = spec_of("constant", {3, 7, 5});
  constant.value = 0.75;
  expect_samples(density_make(constant), [](ivec3) { return 0.75; });
  expect_samples(density_make(spec_of("linear", {3, 7, 5})), [](ivec3 i) { return 1 - (i.y + 0.5) / 7; });
  expect_samples(density_make(spec_of("exponential", {3, 7, 5})), [](ivec3 i) { return std::exp(-(i.y + 0.5) / 7); });
}

// The mean over the samples of `linear` is exactly 1/2 at any resolution; of `exponential` it tends to 1 - 1/e.
TEST(Generators, MeansOfTheProfiles) {
  EXPECT_NEAR(grid_stats(density_make(spec_of("linear", {4, 33, 4}))).mean, 0.5, 1e-7);
  EXPECT_NEAR(grid_stats(density_make(spec_of("exponential", {1, 512, 1}))).mean, 1 - std::exp(-1.0), 1e-6);
}

TEST(Perlin, StaysInRangeAroundOneHalf) {
  for (int octaves : {1, 4, 16}) {
    DensitySpec spec = spec_of("perlin", ivec3(48));
    spec.octaves = octaves;
    spec.scale = 12;
    const GridStats stats = grid_stats(density_make(spec));
    EXPECT_GE(stats.min, 0.0f);
    EXPECT_LE(stats.max, 1.0f);
    EXPECT_LT(stats.min, 0.3f);
    EXPECT_GT(stats.max, 0.7f);
    EXPECT_NEAR(stats.mean, 0.5, 0.02);
  }
}

// scale = 2n puts sample i at lattice coordinate 2i + 1, where all noise is 0, and so it is for every octave.
TEST(Perlin, IsOneHalfAtLatticePoints) {
  DensitySpec spec = spec_of("perlin", ivec3(12));
  spec.scale = 24;
  expect_samples(density_make(spec), [](ivec3) { return 0.5; });
}

// noise₂(p) = (noise(p) + noise(2p)/2) / (3/2), and doubling the scale doubles p.
TEST(Perlin, OctavesHalveAndDouble) {
  DensitySpec spec = spec_of("perlin", {16, 12, 9});
  spec.octaves = 1;
  const Grid one = density_make(spec);
  spec.scale *= 2;
  const Grid half = density_make(spec);
  spec.scale /= 2;
  spec.octaves = 2;
  expect_samples(
      density_make(spec), [&](ivec3 i) { return 0.5 + ((one.at(i) - 0.5) + (half.at(i) - 0.5) / 2) / 1.5; }, 1e-6);
}

TEST(Perlin, ScaleCountsCellsAlongTheLongestSide) {
  const Grid flat = density_make(spec_of("perlin", {8, 32, 16})), cube = density_make(spec_of("perlin", ivec3(32)));
  expect_samples(flat, [&](ivec3 i) { return cube.at(i); });
}

TEST(Perlin, IsSmooth) {
  DensitySpec spec = spec_of("perlin", {256, 4, 4});
  spec.octaves = 1;  // 64 samples a cell; |∇noise| is below 4, so that neighbours differ by less than 0.5·4/64
  const Grid grid = density_make(spec);
  for (int x = 1; x < 256; ++x) ASSERT_LT(std::abs(grid.at({x, 1, 2}) - grid.at({x - 1, 1, 2})), 0.5 * 4 / 64) << x;
}

TEST(Perlin, SeedsDifferAndRepeat) {
  DensitySpec spec = spec_of("perlin", ivec3(16));
  const Grid a = density_make(spec), again = density_make(spec);
  spec.seed = 2;
  const Grid b = density_make(spec);
  int different = 0;
  for_each(a.size(), [&](ivec3 i) {
    ASSERT_EQ(a.at(i), again.at(i));
    different += std::abs(a.at(i) - b.at(i)) > 1e-3;
  });
  EXPECT_GT(different, 16 * 16 * 16 * 9 / 10);
}

// The same field on every machine and in every version: a changed picture must be a decision.
TEST(Perlin, GoldenChecksum) {
  std::uint64_t sum = 0;
  const Grid grid = density_make(spec_of("perlin", {24, 16, 8}));
  for_each(grid.size(), [&](ivec3 i) {
    sum = sum * 1099511628211ull + static_cast<std::uint64_t>(std::lround(grid.at(i) * 65536));
  });
  EXPECT_EQ(sum, 2992679865263205626ull);
}

TEST(Sphere, KeepsWhatLiesInTheInscribedEllipsoid) {
  DensitySpec spec;
  spec.type = "sphere";
  spec.of = std::make_shared<DensitySpec>(spec_of("perlin", {40, 30, 21}));
  const Grid whole = density_make(*spec.of), cut = density_make(spec);
  int inside = 0;
  expect_samples(cut, [&](ivec3 i) {
    const dvec3 p((i.x + 0.5) / 20 - 1, (i.y + 0.5) / 15 - 1, (i.z + 0.5) / 10.5 - 1);
    const bool keep = p.x * p.x + p.y * p.y + p.z * p.z <= 1;
    inside += keep;
    return keep ? whole.at(i) : 0.0;
  });
  EXPECT_NEAR(inside / (40.0 * 30 * 21), 3.14159265 / 6, 0.01);
  EXPECT_EQ(cut.border, Border::CLAMP);
}

TEST(Generators, BallIsAPresence) {
  DensitySpec spec = spec_of("ball", {20, 30, 40});
  spec.radius = 0.5;
  spec.ramp = 3;
  expect_samples(density_make(spec), [](ivec3 i) {
    const double x = (i.x + 0.5) / 10 - 1, y = (i.y + 0.5) / 15 - 1, z = (i.z + 0.5) / 20 - 1;
    return std::clamp(0.5 - 10 * (std::sqrt(x * x + y * y + z * z) - 0.5) / 3, 0.0, 1.0);
  });
  for (double bad : {0.0, -1.0, double(NAN)}) {
    spec.ramp = bad;
    EXPECT_THAT(refusal(spec), HasSubstr("density 'ball': radius and ramp"));
  }
}

TEST(Generators, PresenceIsWithinOne) {
  DensitySpec spec = spec_of("constant", ivec3(20));
  spec.value = 4;
  EXPECT_EQ(density_make(spec).at(ivec3(19)), 4);
  spec.presence = Presence::REFUSE;
  EXPECT_THAT(refusal(spec), AllOf(HasSubstr("presence from 4 to 4"), HasSubstr("\"scale\""), HasSubstr("\"clamp\"")));
  DensitySpec noise = spec_of("linear", ivec3(20));
  noise.presence = Presence::REFUSE;
  EXPECT_EQ(refusal(noise), "accepted");
  for (Presence rule : {Presence::SCALE, Presence::CLAMP}) {
    spec.presence = rule;
    expect_samples(density_make(spec), [](ivec3) { return 1; });
  }
}

TEST(Generators, RefuseWhatTheyCannotMake) {
  EXPECT_THAT(refusal(spec_of("linear", {4, 0, 4})),
              AllOf(HasSubstr("density 'linear': resolution"), HasSubstr("4x0x4")));
  EXPECT_THAT(refusal(spec_of("perlin", ivec3(4096))), AllOf(HasSubstr("4096x4096x4096"), HasSubstr("bytes")));
  EXPECT_THAT(refusal(spec_of("sphere", ivec3(4))), HasSubstr("of: missing"));
  EXPECT_THAT(refusal(spec_of("file", ivec3(4))), HasSubstr("no such file"));
  for (double value : {-1.0, double(NAN), double(INFINITY), 1e39}) {
    DensitySpec spec = spec_of("constant", ivec3(4));
    spec.value = value;
    EXPECT_THAT(refusal(spec), HasSubstr("density 'constant': value")) << value;
  }
  for (double scale : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    DensitySpec spec = spec_of("perlin", ivec3(4));
    spec.scale = scale;
    EXPECT_THAT(refusal(spec), HasSubstr("density 'perlin': scale")) << scale;
  }
  for (int octaves : {0, 17}) {
    DensitySpec spec = spec_of("perlin", ivec3(4));
    spec.octaves = octaves;
    EXPECT_THAT(refusal(spec), HasSubstr("density 'perlin': octaves")) << octaves;
  }
}

// Grids are kept by their key: whatever changes one has to change the other.
TEST(Generators, KeysTellDensitiesApart) {
  const DensitySpec given = spec_of("file", {4, 5, 6});
  const std::function<void(DensitySpec&)> changes[] = {
      [](DensitySpec&) {},
      [](DensitySpec& s) { s.type = "perlin"; },
      [](DensitySpec& s) { s.resolution.z = 7; },
      [](DensitySpec& s) { s.value = 1 + 1e-15; },
      [](DensitySpec& s) { s.scale = 5; },
      [](DensitySpec& s) { s.octaves = 5; },
      [](DensitySpec& s) { s.seed = 2; },
      [](DensitySpec& s) { s.radius = 0.5; },
      [](DensitySpec& s) { s.ramp = 1; },
      [](DensitySpec& s) { s.presence = Presence::REFUSE; },
      [](DensitySpec& s) { s.presence = Presence::CLAMP; },
      [](DensitySpec& s) { s.file = "b.vdb"; },
      [](DensitySpec& s) { s.grid = "heat"; },
      [](DensitySpec& s) { s.values.fill = true; },
      [](DensitySpec& s) { s.values.threshold = 0; },
      [](DensitySpec& s) {
        s.values.remap = {{0, 1}};
      },
      [](DensitySpec& s) { s.values.scale = 2; },
      [](DensitySpec& s) { s.values.clamp_negative = false; },
      [](DensitySpec& s) {
        s.of = std::make_shared<DensitySpec>(spec_of("linear", {4, 4, 4}));
      },
      [](DensitySpec& s) {
        s.of = std::make_shared<DensitySpec>(spec_of("perlin", {4, 4, 4}));
      }};
  std::set<std::string> keys;
  for (const auto& change : changes) {
    DensitySpec spec = given;
    change(spec);
    EXPECT_TRUE(keys.insert(density_key(spec)).second) << density_key(spec);
  }
  DensitySpec same = given;
  same.file = std::filesystem::current_path() / "a.vdb";
  DensitySpec other = given;
  other.file = "x/../a.vdb";
  EXPECT_EQ(density_key(same), density_key(other));
}

}  // namespace
