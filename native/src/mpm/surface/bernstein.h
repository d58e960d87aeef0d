// Bernstein polynomials on [0, 1] and the blossom (polar form) of a Bézier curve.
#pragma once

#include <array>

#include "mpm/surface/bezier_patch.h"

namespace mpm {

using BernsteinRow = std::array<double, kMaxDegree + 1>;

// All Bernstein polynomials of `degree` at t, by the triangular recurrence (no cancellation for t in [0, 1]).
inline void bernstein(int degree, double t, BernsteinRow& b) {
  b[0] = 1.0;
  const double s = 1.0 - t;
  for (int k = 1; k <= degree; ++k) {
    double carry = 0.0;
    for (int i = 0; i < k; ++i) {
      const double left = b[i];
      b[i] = carry + s * left;
      carry = t * left;
    }
    b[k] = carry;
  }
}

// Values, first and second derivatives of all Bernstein polynomials of `degree` at t.
void bernstein_derivatives(int degree, double t, BernsteinRow& b, BernsteinRow& d, BernsteinRow& dd);

}  // namespace mpm
