#include "mpm/surface/bernstein.h"

namespace mpm {
namespace {

// The polynomials of `degree` from those one degree lower.
void raise(int degree, double t, const double* lower, double* b) {
  const double s = 1.0 - t;
  b[0] = s * lower[0];
  for (int i = 1; i < degree; ++i) b[i] = s * lower[i] + t * lower[i - 1];
  b[degree] = t * lower[degree - 1];
}

// b'_i = n (b_{i-1} - b_i) with the polynomials one degree lower.
void differentiate(int degree, const double* lower, double* d) {
  d[0] = -degree * lower[0];
  for (int i = 1; i < degree; ++i) d[i] = degree * (lower[i - 1] - lower[i]);
  d[degree] = degree * lower[degree - 1];
}

// The cubic ones at once.
void cubic(double t, BernsteinRow& b, BernsteinRow& d, BernsteinRow& dd) {
  const double s = 1.0 - t, ss = s * s, st = s * t, tt = t * t;
  b[0] = ss * s, b[1] = 3 * ss * t, b[2] = 3 * s * tt, b[3] = tt * t;
  d[0] = -3 * ss, d[1] = 3 * (ss - 2 * st), d[2] = 3 * (2 * st - tt), d[3] = 3 * tt;
  dd[0] = 6 * s, dd[1] = 6 * (t - 2 * s), dd[2] = 6 * (s - 2 * t), dd[3] = 6 * t;
}

}  // namespace

void bernstein_derivatives(int degree, double t, BernsteinRow& b, BernsteinRow& d, BernsteinRow& dd) {
  if (degree == 3) return cubic(t, b, d, dd);
  BernsteinRow lower, lower_d;
  if (degree < 2) {
    b[0] = 1.0 - t, b[1] = t;
    d[0] = -1.0, d[1] = 1.0;
    dd[0] = dd[1] = 0.0;
    return;
  }
  // Up to two degrees lower, whose derivative of the derivative is wanted; then the last two degrees.
  BernsteinRow lowest;
  lowest[0] = 1.0;
  for (int k = 1; k <= degree - 2; ++k) {
    // In place, from the right: raise() for a row that is its own source.
    lowest[k] = t * lowest[k - 1];
    for (int i = k - 1; i > 0; --i) lowest[i] = (1.0 - t) * lowest[i] + t * lowest[i - 1];
    lowest[0] *= 1.0 - t;
  }
  raise(degree - 1, t, lowest.data(), lower.data());
  raise(degree, t, lower.data(), b.data());
  differentiate(degree, lower.data(), d.data());
  differentiate(degree - 1, lowest.data(), lower_d.data());
  differentiate(degree, lower_d.data(), dd.data());
}

}  // namespace mpm
