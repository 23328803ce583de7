// The exact picture of single scattering: Gauss-Legendre of the true integrand between all cell borders of all media.
// Called through media_scatter. Exact up to the quadrature in S(t): intervals are cut where a surface's shadow or a
// cone begins and ends, what is left of kinks (of τ to the light) converges with the order.
#pragma once
#include "reference/scatter.hpp"

namespace brume::reference {

Scattered media_scatter_exact(const Context& context, const RayD& ray, double t_max, const RandomStream& random);

}  // namespace brume::reference
