// Gauss-Legendre nodes by Newton's method on the Legendre polynomial, started from the usual cosine estimate.
#include "reference/quadrature.hpp"

#include <cmath>

#include "reference/vec.hpp"

namespace brume::reference {
namespace {

struct Legendre {
  double value, slope;
};

// P_n and its derivative at x in (-1,1), by the three-term recurrence.
Legendre legendre_at(int n, double x) {
  double previous = 1, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, n * (previous - x * value) / (1 - x * x)};
}

}  // namespace

std::vector<QuadratureNode> gauss_legendre(int n) {
  std::vector<QuadratureNode> nodes;
  nodes.reserve(static_cast<std::size_t>(n));
  for (int i = n; i >= 1; --i) {  // the estimate falls with i
    double x = std::cos(PI * (i - 0.25) / (n + 0.5));
    for (int step = 0; step < 8; ++step) {  // quadratic: 8 steps are more than double can hold
      const Legendre p = legendre_at(n, x);
      x -= p.value / p.slope;
    }
    const double slope = legendre_at(n, x).slope;
    nodes.push_back({(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

}  // namespace brume::reference
