// The exact picture of single scattering: Gauss-Legendre of the true integrand between all cell borders of all media.
// Called through media_scatter. Exact up to the quadrature in S(t): kinks of shadow rays converge with the order, and
// the edge of a surface's shadow inside an interval does not.
#pragma once
#include "reference/scatter.hpp"

namespace brume::reference {

Scattered media_scatter_exact(const Context& context, const RayD& ray, double t_max);

}  // namespace brume::reference
