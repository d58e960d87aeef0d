// Random B-splines for the surface tests.
#pragma once

#include <random>

#include "mpm/surface/bspline_surface.h"

namespace mpm::testing {

struct SurfaceData {
  int degree_u, degree_v;
  std::vector<double> knots_u, knots_v;
  std::vector<Vec3> poles;
  std::vector<double> weights;

  std::size_t poles_u() const { return knots_u.size() - std::size_t(degree_u) - 1; }
  std::size_t poles_v() const { return knots_v.size() - std::size_t(degree_v) - 1; }
  BSplineSurface surface() const { return {degree_u, degree_v, knots_u, knots_v, poles, weights}; }
};

class SurfaceMaker {
 public:
  explicit SurfaceMaker(unsigned seed) : random_(seed) {}

  double uniform(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random_); }

  // Clamped or not; interior knots of random multiplicity from 1 to the degree.
  std::vector<double> knots(int degree, bool clamped) {
    std::vector<double> result;
    double at = uniform(-3, 3);
    for (int i = 0; i <= degree; ++i) result.push_back(clamped ? at : at += uniform(0.1, 1));
    const int spans = std::uniform_int_distribution(1, 4)(random_);
    for (int span = 1; span < spans; ++span) {
      at += uniform(0.1, 1);
      result.insert(result.end(), std::size_t(std::uniform_int_distribution(1, degree)(random_)), at);
    }
    at += uniform(0.1, 1);
    for (int i = 0; i <= degree; ++i) result.push_back(clamped ? at : at += uniform(0.1, 1));
    return result;
  }

  SurfaceData data(int degree_u, int degree_v, bool rational, bool clamped) {
    SurfaceData d{degree_u, degree_v, knots(degree_u, clamped), knots(degree_v, clamped), {}, {}};
    for (std::size_t i = 0; i < d.poles_u(); ++i)
      for (std::size_t j = 0; j < d.poles_v(); ++j) {
        d.poles.emplace_back(
            10 * double(i) + uniform(-3, 3), 10 * double(j) + uniform(-3, 3), uniform(-20, 20));
        if (rational) d.weights.push_back(uniform(0.2, 5));
      }
    return d;
  }

 private:
  std::mt19937 random_;
};

}  // namespace mpm::testing
