// How one parameter of a surface runs in the B-spline that OpenCASCADE makes of it.
#pragma once

#include <vector>

namespace mpm::occt {

// Circles, and everything swept from or round them, become rational quadratic arcs: at the knots the
// B-spline's parameter is the angle, between them it is not. Over an arc [a, b] with middle m and half
// opening d = (b-a)/2 the angle t and the local parameter x in [-1, 1] satisfy tan((t-m)/2) = x tan(d/2) (the
// rational half-angle form).
class ParameterMap {
 public:
  // The identity.
  ParameterMap() = default;
  // Arcs between consecutive `knots` (radians, increasing, each arc under 2 pi).
  explicit ParameterMap(std::vector<double> knots) : knots_(std::move(knots)) {}

  double operator()(double t) const;

 private:
  std::vector<double> knots_;  // empty: identity
};

}  // namespace mpm::occt
