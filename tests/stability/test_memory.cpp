// What a large, mostly empty grid costs: 512³ voxels of which one in twenty is not empty.
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "render/program.hpp"
#include "volume/formats/openvdb.hpp"

namespace brume::test {
namespace {

using Memory = Program;

constexpr int SIDE = 512, CHUNK = 32;

// Cubes of 32³ voxels, one in twenty of the places, everywhere in the grid.
std::size_t sparse_write(const fs::path& file) {
  Grid grid{ivec3(SIDE)};
  grid.border = Border::ZERO;
  std::size_t filled = 0;
  int place = 0;
  for (int cz = 0; cz < SIDE; cz += CHUNK)
    for (int cy = 0; cy < SIDE; cy += CHUNK)
      for (int cx = 0; cx < SIDE; cx += CHUNK) {
        if (place++ * 7 % 20 != 0) continue;
        for (int z = 0; z < CHUNK; ++z)
          for (int y = 0; y < CHUNK; ++y)
            for (int x = 0; x < CHUNK; ++x) {
              grid.set({cx + x, cy + y, cz + z}, 0.5f + 0.001f * static_cast<float>((x * 31 + y * 17 + z * 7) % 97));
              ++filled;
            }
      }
  vdb_write(grid, file);
  return filled;
}

TEST_F(Memory, AMostlyEmptyGridCostsWhatIsInIt) {
  const std::size_t filled = sparse_write(folder_ / "sparse.vdb");
  EXPECT_NEAR(static_cast<double>(filled) / (double(SIDE) * SIDE * SIDE), 0.05, 0.002);
  const Outcome r = run("render sparse.vdb --set /render/light_grid=64 --size 256x256 --stats s.json --quiet -o a.png");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  EXPECT_LT(usage.ru_maxrss, 600 << 10) << "KiB of the largest child process";
  const auto memory = nlohmann::json::parse(text(folder_ / "s.json")).at("memory");
  // of the cells of the bricks that are stored: 9³ samples for 8³ cells, the index, a light grid of 64 (1.1 MB; 128, a
  // bare volume's own, is 8.6 MB), the rays in flight
  const double cells = memory.at("voxel_bytes").get<double>() * 512 / 729;
  const double share = memory.at("device_bytes").get<double>() / cells;
  EXPECT_LE(share, 1.6);
  std::printf(
      "peak %ld MiB; device memory: %.2f times the stored bricks' cells, %.2f times the voxels that are "
      "not 0\n",
      usage.ru_maxrss >> 10, share, share * cells / (4.0 * static_cast<double>(filled)));
}

}  // namespace
}  // namespace brume::test
