// Rays that break walks through a grid: zeros among their components, faces, edges, corners, far origins, no end.
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/families.hpp"
#include "stability/stability_parts.hpp"

namespace brume {

namespace {

constexpr double CELL = 0.25;  // of the cube: 8 voxels over [-1, 1]

std::vector<dvec3> axes() { return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}; }

// Every direction with components in {-1, 0, 1}, the zeros of both signs.
void zero_components(StabilityRun& run) {
  StabilityRays rays;
  const double values[] = {-1, -0.0, 0.0, 1};
  for (const double x : values)
    for (const double y : values)
      for (const double z : values)
        if (x != 0 || y != 0 || z != 0)
          for (const dvec3& p : {dvec3(0.11, -0.07, 0.03), dvec3(-0.61, 0.37, 0.52), dvec3(1.2, 0.4, 0.3)})
            rays.through(p, {x, y, z});
  run.compare(run.cube(), rays, 1e-6, true);
}

// On the planes between voxels and through their middles, along edges of cells; the outer faces of the cube too.
void along_faces(StabilityRun& run) {
  StabilityRays inside, border;
  for (const dvec3& axis : axes())
    for (int i = -8; i <= 8; ++i)
      for (int j = -8; j <= 8; ++j) {
        const double a = i * CELL / 2, b = j * CELL / 2;
        const dvec3 p = axis.x != 0 ? dvec3(0, a, b) : axis.y != 0 ? dvec3(a, 0, b) : dvec3(a, b, 0);
        (std::abs(i) == 8 || std::abs(j) == 8 ? border : inside).through(p, axis);
      }
  for (std::size_t i = 0; i < border.rays.size(); ++i) inside.add(border.rays[i].origin, border.rays[i].dir);
  run.compare(run.cube(), inside, 1e-6, true);
}

// Diagonals of faces and space through the corners of cells.
void through_corners(StabilityRun& run) {
  StabilityRays rays;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x * x + y * y + z * z < 2) continue;
        for (int i = -2; i <= 2; ++i) rays.through(dvec3(i * CELL, -i * CELL, 2 * i * CELL) * 0.5, {x, y, z});
        rays.through(dvec3(0), {x, y, z});
      }
  run.compare(run.cube(), rays, 2e-6, true);
}

// Inside, on a face, on an edge, on a corner of the cube and of a cell.
void origins(StabilityRun& run) {
  StabilityRays rays;
  const dvec3 places[] = {{0.03, 0.11, -0.2}, {0, 0, 0},      {CELL, CELL, 0.1}, {CELL, 0.1, 0.07},
                          {1, 0.2, 0.3},      {-1, 0.2, 0.3}, {1, 1, 0.3},       {-1, 1, 0.3},
                          {1, 1, 1},          {-1, -1, -1},   {1, -1, 1},        {0.999999, 0, 0}};
  CheckRandom random;
  for (const dvec3& place : places) {
    for (const dvec3& axis : axes()) rays.add(place, axis);
    for (int i = 0; i < 20; ++i) rays.add(place, random.direction());
  }
  run.compare(run.cube(), rays, 1e-6, true);
}

// Cuts off a corner at a depth of 1e-1 to 1e-7.
void grazing(StabilityRun& run) {
  StabilityRays rays;
  for (int digits = 1; digits <= 7; ++digits)
    for (const dvec3& dir : {dvec3(1, -1, 0), dvec3(1, 0, -1), dvec3(1, 1, -2), dvec3(-1, 2, -1)})
      rays.through(dvec3(1) - std::pow(10.0, -digits), dir);
  run.compare(run.cube(), rays, 2e-6, true);
}

// Origins at a distance of up to a million: the entry loses digits, nothing else does.
void far_origins(StabilityRun& run) {
  StabilityRays rays;
  CheckRandom random;
  for (const double back : {10.0, 1e3, 1e5, 1e6})
    for (int i = 0; i < 20; ++i) rays.through(random.in_box(0.5), random.direction(), back);
  run.compare(run.cube(), rays, 0.2, true);
}

// Directions that hardly move, that are not unit, that come from nowhere: the walk ends.
void endless(StabilityRun& run) {
  StabilityRays rays;
  for (const double tiny : {1e-6, 1e-12, 1e-20, 1e-30, 1e-38, 1e-42}) {
    rays.add({-2, 0.1, 0.1}, {1, tiny, -tiny});
    rays.add({0.1, 0.1, 0.1}, {tiny, 1, tiny});
    rays.add({0.1, 0.125, 0.1}, glm::normalize(dvec3(1, -tiny, tiny)));
  }
  rays.add({-1e30, 0, 0}, {1, 0, 0});
  rays.add({1e30, 1e30, 1e30}, glm::normalize(dvec3(-1)));
  rays.add({0, 0, 0}, {1, 0, 0}, 0);
  rays.add({0, 0, 0}, {1, 0, 0}, 1e-30);
  run.shoot(run.cube(), rays);
}

// Axis-aligned and random rays on the linear ramp: what the methods are worth on a field that is not constant.
void ramp(StabilityRun& run) {
  if (run.method() == METHOD_HOMOGENEOUS) return;
  StabilityRays rays;
  CheckRandom random;
  for (int i = 0; i < 200; ++i) rays.through(random.in_box(0.8), random.direction());
  run.compare(run.cube(R"({"type": "linear", "resolution": [8, 8, 8]})"), rays, 1e-6, false);
}

}  // namespace

const std::vector<StabilityEntry> STABILITY_RAYS = {
    {"zero_components", "directions with 0 and -0.0 components", zero_components, all_methods},
    {"along_faces", "axis-aligned along voxel faces and edges, the outer ones too", along_faces, all_methods},
    {"through_corners", "diagonals through corners of voxels", through_corners, all_methods},
    {"origins", "origin inside, on a face, on an edge, on a corner", origins, all_methods},
    {"grazing", "grazing hits of one corner, 1e-1 to 1e-7 deep", grazing, all_methods},
    {"far_origins", "origins up to 1e6 away", far_origins, all_methods},
    {"endless", "rays that would not end: tiny components, origins at 1e30, no length", endless, all_methods},
    {"ramp", "random rays through a linear ramp", ramp, all_methods},
};

}  // namespace brume
