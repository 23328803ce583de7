// Any other density, cut to the ellipsoid inscribed in its grid. A sample is kept where its centre lies inside.
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "volume/generators/generators.hpp"

namespace brume {

Grid density_sphere(const DensitySpec& spec) {
  if (!spec.of) throw InputError("density 'sphere': of: missing, expected the density that is cut");
  Grid grid = density_make(*spec.of);
  const dvec3 size(grid.size());
  grid_visit_stored(grid, [&](ivec3 i, float) {
    const dvec3 p = 2.0 * (dvec3(i) + 0.5) / size - 1.0;
    if (glm::dot(p, p) > 1) grid.set(i, 0.0f);
  });
  return grid;
}

}  // namespace brume
