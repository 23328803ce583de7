// What volumes and lights cost: what is stored in them and not the box around it, and no more than a dense one needs
// while it loads.
#include <openvdb/openvdb.h>
#include <sys/wait.h>

#include <random>

#include "render/program.hpp"

namespace brume::test {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;

class Sparse : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    openvdb::initialize();
    write("nothing.json", R"({"media": [{"density": {"type": "constant"}, "sigma_a": 1}]})");
  }

  FloatGrid::Ptr grid() const {
    const FloatGrid::Ptr g = FloatGrid::create(0.0f);
    g->setName("density");
    return g;
  }
  void file(const FloatGrid::Ptr& g, const std::string& name) const {
    openvdb::io::File((folder_ / name).string()).write(openvdb::GridPtrVec{g});
  }
  // Absorption alone: nothing but the walk along view rays.
  void scene(const std::string& name, const std::string& volume) const {
    const std::string camera = R"({"camera": {"eye": [-700, 800, -1900], "target": [500, 500, 500], "vfov": 60}, )";
    write(name, camera + R"("media": [{"density": {"type": "file", "path": ")" + volume + R"("}, "sigma_a": 0.5}]})");
  }

  // Largest resident set of `brume render SCENE` in MiB, without its helpers. A first run builds the kernels: the
  // compiler takes more than
  // these volumes. What wait4() says would be at least what this process takes.
  long peak(const std::string& name) const {
    const std::string arguments = "render " + name + " --size 64x64 --quiet -o a.exr";
    const Outcome first = run(arguments);
    EXPECT_EQ(first.exit_code, 0) << first.err;
    const std::string command = "cd " + folder_.string() + " && exec " BRUME_BINARY " " + arguments + " > /dev/null";
    const pid_t child = vfork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(3);
    }
    long most = 0;
    int status = 0;
    for (; waitpid(child, &status, WNOHANG) == 0; usleep(2000)) most = std::max(most, high_water(child));
    EXPECT_EQ(status, 0);
    return most >> 10;
  }
  static long high_water(pid_t process) {  // KiB
    const std::string status = text("/proc/" + std::to_string(process) + "/status");
    const std::size_t at = status.find("VmHWM:");
    return at == std::string::npos ? 0 : std::atol(status.c_str() + at + 6);
  }
};

TEST_F(Sparse, TwoVoxelsFarApartCostTwoVoxels) {
  const FloatGrid::Ptr g = grid();
  g->tree().setValueOn(Coord(0), 1.0f);
  g->tree().setValueOn(Coord(5000), 1.0f);
  file(g, "two.vdb");
  const long alone = peak("nothing.json"), two = peak("two.vdb");
  std::printf("peak %ld MiB, without a volume %ld MiB\n", two, alone);
  EXPECT_LT(two, alone + 40);  // a light grid and the file's reader among them
}

// Also where its tiles do not begin with the grid's own blocks.
TEST_F(Sparse, ATileCostsItsSides) {
  for (const int begin : {0, 3}) {
    const FloatGrid::Ptr g = grid();
    g->sparseFill(CoordBBox(Coord(begin), Coord(begin + 1015)), 0.01f);
    file(g, "tile.vdb");
    scene("tile.json", "tile.vdb");
    const long alone = peak("nothing.json"), tile = peak("tile.json");
    std::printf("peak %ld MiB, without a volume %ld MiB\n", tile, alone);
    EXPECT_LT(tile, alone + (begin == 0 ? 60 : 320)) << begin;  // its voxels: 4 GiB
  }
}

// Samples are repeated where bricks meet, 1.42 times as many; that is what stays, and what was there before is gone.
TEST_F(Sparse, ADenseGridIsNotHeldTwice) {
  constexpr int SIDE = 256;
  {
    const FloatGrid::Ptr g = grid();
    auto at = g->getAccessor();
    std::mt19937 random(3);
    for (int x = 0; x < SIDE; ++x)
      for (int y = 0; y < SIDE; ++y)
        for (int z = 0; z < SIDE; ++z)
          at.setValueOn(Coord(x, y, z), 1e-4f + 1e-12f * static_cast<float>(random() >> 4));
    file(g, "dense.vdb");
  }
  scene("dense.json", "dense.vdb");
  const double bytes = 4.0 * SIDE * SIDE * SIDE / (1 << 20);
  const long alone = peak("nothing.json"), dense = peak("dense.json");
  std::printf("peak %ld MiB, without a volume %ld MiB: %.2f times the grid\n", dense, alone, (dense - alone) / bytes);
  EXPECT_LT(dense - alone, 1.9 * bytes);
}

// Tiles and the same voxels one by one are one picture.
TEST_F(Sparse, ItsDenseTwinIsTheSamePicture) {
  const FloatGrid::Ptr g = grid();
  g->sparseFill(CoordBBox(Coord(100, 120, 130), Coord(420, 300, 310)), 0.01f);
  g->sparseFill(CoordBBox(Coord(800), Coord(900)), 0.02f);
  g->tree().setValueOn(Coord(200, 200, 200), 0.4f);
  g->tree().setValueOn(Coord(1000), 0.4f);
  file(g, "tiles.vdb");
  g->tree().voxelizeActiveTiles();
  file(g, "voxels.vdb");
  scene("tiles.json", "tiles.vdb");
  scene("voxels.json", "voxels.vdb");
  for (const char* method : {"dda_gauss2", "march_midpoint", "ratio_tracking"}) {
    for (const char* name : {"tiles", "voxels"}) {
      const std::string scene = name;
      const Outcome r = run("render " + scene + ".json --size 64x64 --quiet -o " + scene +
                            ".exr --set '/render/method=\"" + method + "\"'");
      ASSERT_EQ(r.exit_code, 0) << r.err;
    }
    const Outcome plain = run("compare tiles.exr voxels.exr");
    EXPECT_NE(plain.out.find("max_abs           0.0\n"), std::string::npos) << method << "\n" << plain.out;
  }
}

// Many lights: what each takes, and nothing per light and ray.
TEST_F(Sparse, TenThousandLightsTakeNoNumberPerRay) {
  std::string lights;
  for (int i = 0; i < 10000; ++i)
    lights += std::string(i ? "," : "") + R"({"type": "point", "position": [)" + std::to_string(i % 100) + ", " +
              std::to_string(1 + i % 7) + ", " + std::to_string(i / 100) + R"(], "intensity": 0.01})";
  write("lights.json", R"({"lights": [)" + lights + R"(], "materials": {"grey": {"diffuse": 0.5}},
    "shapes": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "material": "grey"}],
    "camera": {"eye": [50, 30, -40], "target": [50, 0, 50]}})");
  const long alone = peak("nothing.json"), many = peak("lights.json");
  std::printf("peak %ld MiB, without lights %ld MiB\n", many, alone);
  EXPECT_LT(many, alone + 60);  // 4 096 rays x 10 000 lights x 16 bytes would be 625 MiB
}

}  // namespace
}  // namespace brume::test
