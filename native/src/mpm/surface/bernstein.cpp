#include "mpm/surface/bernstein.h"

namespace mpm {
namespace {

// b'_i = n (b_{i-1} - b_i) with the polynomials one degree lower, which `lower` holds.
void differentiate(int degree, const BernsteinRow& lower, BernsteinRow& d) {
  for (int i = 0; i <= degree; ++i) {
    const double before = i > 0 ? lower[i - 1] : 0.0;
    const double here = i < degree ? lower[i] : 0.0;
    d[i] = degree * (before - here);
  }
}

}  // namespace

void bernstein_derivatives(int degree, double t, BernsteinRow& b, BernsteinRow& d, BernsteinRow& dd) {
  bernstein(degree, t, b);
  BernsteinRow lower{};
  bernstein(degree - 1, t, lower);
  differentiate(degree, lower, d);
  if (degree < 2) {
    dd.fill(0.0);
    return;
  }
  BernsteinRow lowest{}, lower_d{};
  bernstein(degree - 2, t, lowest);
  differentiate(degree - 1, lowest, lower_d);
  differentiate(degree, lower_d, dd);
}

}  // namespace mpm
