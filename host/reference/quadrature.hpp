// Gauss-Legendre nodes of any order: the exact pictures integrate in-scattering with them.
#pragma once
#include <vector>

namespace brume::reference {

struct QuadratureNode {
  double x;       // in (0,1)
  double weight;  // the weights sum to 1
};

// n nodes on [0,1], ascending; exact for polynomials of degree 2n-1. None for n = 0.
std::vector<QuadratureNode> gauss_legendre(int n);

}  // namespace brume::reference
