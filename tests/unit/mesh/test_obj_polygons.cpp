// Polygons of OBJ files become triangles that cover them once, wherever, however large and in whatever plane they are.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "unit/mesh/obj_fixture.hpp"

namespace brume {
namespace {

using namespace test;
using glm::dvec2;
using glm::dvec3;

dvec3 corner(const Mesh& mesh, std::size_t triangle, int k) {
  return mesh.positions.at(mesh.triangles.at(triangle).position[k]);
}

dvec3 area_vector(const Mesh& mesh, std::size_t t) {
  return 0.5 * glm::cross(corner(mesh, t, 1) - corner(mesh, t, 0), corner(mesh, t, 2) - corner(mesh, t, 0));
}

// A polygon, its corners going round it, written as one face; every triangle of it must face the same way, and their
// areas must sum to that of the polygon (half the sum of the cross products around it).
struct Polygon {
  const char* name;
  std::vector<dvec2> corners;
};
const std::vector<Polygon>& polygons() {
  static const std::vector<Polygon> all = [] {
    std::vector<Polygon> list{
        {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
        {"dart", {{0, 0}, {2, -1}, {0, 3}, {-2, -1}}},
        {"thin dart", {{0, 0}, {0.5, -1}, {0, 3}, {-0.5, -1}}},
        {"L", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}},
        {"arrow", {{0, 0}, {2, 2}, {1, 2}, {1, 4}, {-1, 4}, {-1, 2}, {-2, 2}}},
        {"comb", {{0, 0}, {7, 0}, {7, 3}, {6, 3}, {6, 1}, {4, 1}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}}};
    for (const int n : {5, 6, 17, 300}) {
      Polygon round{"round", {}};
      for (int i = 0; i < n; ++i) round.corners.emplace_back(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n));
      list.push_back(round);
    }
    return list;
  }();
  return all;
}

// Frames for the polygon's plane: x axis and y axis.
const std::array<std::array<dvec3, 2>, 4> PLANES = {
    {{{{1, 0, 0}, {0, 1, 0}}}, {{{0, 1, 0}, {0, 0, 1}}}, {{{0, 0, 1}, {1, 0, 0}}}, {{{0.6, 0.8, 0}, {0, 0, 1}}}}};

void expect_triangulated(const Mesh& mesh, const std::vector<dvec3>& corners, const std::string& what) {
  dvec3 expected(0), sum(0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    expected += 0.5 * glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  double covered = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += area_vector(mesh, t);
    covered += glm::length(area_vector(mesh, t));
  }
  const double area = glm::length(expected);
  EXPECT_LT(glm::distance(sum, expected), 1e-3 * area) << what;
  EXPECT_NEAR(covered, area, 1e-3 * area) << what;  // more where triangles overlap or face back
  EXPECT_EQ(mesh.triangles.size(), corners.size() - 2) << what;
}

TEST_F(Obj, PolygonsAreCoveredOnceByTheirTriangles) {
  for (const Polygon& polygon : polygons())
    for (std::size_t plane = 0; plane < PLANES.size(); ++plane)
      for (const double size : {1.0, 1e-4})
        for (const double turn : {1.0, -1.0})
          for (const dvec3 shift : {dvec3(0), dvec3(10, 20, -30), dvec3(-5, 7, 9)}) {
            std::ostringstream text;
            text.precision(9);
            std::vector<dvec3> corners;
            for (const dvec2& c : polygon.corners)
              corners.push_back(size * (shift + turn * c.x * PLANES[plane][0] + c.y * PLANES[plane][1]));
            for (const dvec3& p : corners) text << "v " << p.x << " " << p.y << " " << p.z << "\n";
            text << "f";
            for (std::size_t i = 1; i <= corners.size(); ++i) text << " " << i;
            text << "\n";
            const std::string what = polygon.name + (" of " + std::to_string(corners.size())) + ", plane " +
                                     std::to_string(plane) + ", size " + std::to_string(size) + ", turn " +
                                     std::to_string(turn) + ", shift " + std::to_string(shift.x);
            expect_triangulated(read(text.str()), corners, what);
          }
}

}  // namespace
}  // namespace brume
