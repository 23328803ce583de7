// The parts of brume that the roofline measures. Private to bench/roofline*.cpp.
#pragma once
#include "cl/context.hpp"
#include "roofline.hpp"
#include "workload.hpp"

namespace brume::bench {

struct RooflineBench {
  Context& context;
  const Workload& fog;
  int lanes;
  RooflineOptions options;
  std::filesystem::path folder;
  // A row is there: `items` took so many seconds, one number a run.
  std::function<void(const std::string& name, const std::string& item, double items, const std::vector<double>& seconds,
                     const Cost& cost)>
      add;
};

// limit/copy, limit/fma, limit/loads; then cells and light-grid lookups: kernels of bench/roofline.cl.
void roofline_kernels(const RooflineBench& bench);
// Passes of whole renders: lookups by every method, light-grid points, rays by kind, a picture of nothing.
void roofline_lookups(const RooflineBench& bench);
void roofline_rays(const RooflineBench& bench);
void roofline_picture(const RooflineBench& bench);
// What the host does: BVH, bricks, image files.
void roofline_host(const RooflineBench& bench);

// A row of the table of costs; RuntimeError where there is none of that name.
Cost cost_of(const std::string& name);
// The cost of reading that many bytes once, shared out over items.
Cost cost_of_reading(Cost cost, double bytes, double items);
// A ray among so many triangles in nodes of that width.
Cost cost_of_ray(const std::string& name, std::size_t triangles, int width);

// A sphere with bumps, seen from within: every ray meets it. Written to `file` as OBJ; 2 * rings² triangles, but for
// those at its poles that have no area.
void bumpy_sphere_write(int rings, const std::filesystem::path& file);

}  // namespace brume::bench
