// What the host does beside the device.
#include <array>
#include <cmath>

#include "accel/bvh.hpp"
#include "base/atomic_file.hpp"
#include "base/stopwatch.hpp"
#include "flat/bricks.hpp"
#include "flat/flatten.hpp"
#include "image/image.hpp"
#include "render/renderer.hpp"
#include "roofline_parts.hpp"
#include "scene/scene_reader.hpp"

namespace brume::bench {

namespace {

template <class Work>
std::vector<double> timed(const RooflineBench& bench, const Work& work) {
  std::vector<double> seconds;
  for (int i = 0; i < bench.options.repetitions; ++i) {
    const Stopwatch watch;
    work();
    seconds.push_back(watch.seconds());
  }
  return seconds;
}

void add_bvh(const RooflineBench& bench) {
  const SceneDesc desc =
      scene_read_text(R"({"shapes": [{"type": "mesh", "file": "sphere.obj"}]})", bench.folder / "sphere.json", {});
  LoadedScene loaded;
  const int width = bvh_width_for(bench.lanes);
  const FlatScene flat = scene_flatten(desc, loaded, width);
  const double triangles = static_cast<double>(flat.triangles.size());
  Cost cost = cost_of("triangle of a tree");
  cost.flops += 12 * std::log2(triangles);
  bench.add("build/bvh", "triangle", triangles, timed(bench, [&] { bvh_build(flat.triangles, width); }), cost);
}

void add_bricks(const RooflineBench& bench) {
  const Grid& grid = bench.fog.grid();
  const ivec3 size = grid.size();
  const double voxels = static_cast<double>(size.x) * size.y * size.z;
  const auto build = [&] {
    Medium medium{};
    medium.liquid = -1;
    FlatScene scene;
    medium.interpolation = INTERPOLATION_TRILINEAR;
    bricks_append(grid, medium, scene);
  };
  bench.add("build/bricks", "voxel", voxels, timed(bench, build), cost_of("voxel of a brick"));
}

// A picture with something in it: what is the same all over packs too well.
std::vector<float> pattern(int side) {
  std::vector<float> values;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c)
        values.push_back(static_cast<float>(0.5 + 0.5 * std::sin(0.1 * x + 0.07 * y + c) * std::cos(0.013 * x * y)));
  return values;
}

void add_image(const RooflineBench& bench, const std::string& kind, const std::function<void()>& write) {
  const std::filesystem::path file = bench.folder / ("image." + kind);
  const double side = bench.options.size, bytes = 3 * sizeof(float) * side * side;
  write();  // starts the program that does it
  const std::vector<double> written = timed(bench, write);
  const Cost cost =
      cost_of_reading(cost_of("byte of values"), static_cast<double>(std::filesystem::file_size(file)), bytes);
  bench.add("image/write_" + kind, "byte", bytes, written, cost);
  image_read(file);
  bench.add("image/read_" + kind, "byte", bytes, timed(bench, [&] { image_read(file); }), cost);
}

}  // namespace

void bumpy_sphere_write(int rings, const std::filesystem::path& file) {
  std::string text;
  const auto line = [&](const char* kind, const std::array<std::string, 3>& words) {
    text += kind;
    for (const std::string& word : words) text.append(" ").append(word);
    text += "\n";
  };
  const auto point = [&](int ring, int column) {
    const double theta = M_PI * ring / rings, phi = 2 * M_PI * column / rings;
    const double r = 1 + 0.05 * std::sin(9 * theta) * std::sin(7 * phi);
    line("v", {std::to_string(r * std::sin(theta) * std::cos(phi)), std::to_string(r * std::cos(theta)),
               std::to_string(r * std::sin(theta) * std::sin(phi))});
  };
  const auto name = [&](int ring, int column) { return std::to_string(ring * rings + column % rings + 1); };
  for (int ring = 0; ring <= rings; ++ring)
    for (int column = 0; column < rings; ++column) point(ring, column);
  for (int ring = 0; ring < rings; ++ring)
    for (int column = 0; column < rings; ++column) {
      const std::string a = name(ring, column), b = name(ring, column + 1), c = name(ring + 1, column),
                        d = name(ring + 1, column + 1);
      line("f", {a, b, c});
      line("f", {b, d, c});
    }
  atomic_write(file, text);
}

void roofline_host(const RooflineBench& bench) {
  add_bvh(bench);
  add_bricks(bench);
  const int side = bench.options.size;
  const std::vector<float> values = pattern(side);
  add_image(bench, "png", [&] { image_write_display(bench.folder / "image.png", side, side, values); });
  add_image(bench, "exr", [&] {
    image_write_exr(bench.folder / "image.exr", side, side,
                    {{"R", values.data(), 3}, {"G", values.data() + 1, 3}, {"B", values.data() + 2, 3}}, {});
  });
}

}  // namespace brume::bench
