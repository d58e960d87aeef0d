// One tensor-product Bézier patch, rational or not: the piece of a face that everything is computed on.
#pragma once

#include <vector>

#include "mpm/base/types.h"

namespace mpm {

inline constexpr int kMaxDegree = 10;

// Position and derivatives with respect to the face's parameters (mm, mm per unit of u and v).
struct SurfacePoint {
  Vec3 s, su, sv, suu, suv, svv;
};

// Threads: any number may share one.
class BezierPatch {
 public:
  // `control`: (degree_u+1)*(degree_v+1) homogeneous points (w x, w y, w z, w), row-major in u; weights
  // positive. `box`: the part of the face's parameter plane that the patch covers. Nothing of it is checked:
  // BSplineSurface does.
  BezierPatch(int degree_u, int degree_v, const ParamBox& box, std::vector<Vec4> control);

  int degree_u() const { return degree_u_; }
  int degree_v() const { return degree_v_; }
  const ParamBox& box() const { return box_; }
  bool rational() const { return rational_; }
  const std::vector<Vec4>& control() const { return control_; }
  const Vec4& control(int i, int j) const { return control_[i * (degree_v_ + 1) + j]; }

  // Point and derivatives at face parameters (u, v), exact to rounding; (u, v) outside box() extrapolates.
  Vec3 point(double u, double v) const;
  SurfacePoint evaluate(double u, double v) const;

  // The box of the control points; contains the patch because the weights are positive.
  Box3 bounds() const;

  // The part over `part`, a sub-rectangle of box(), as a patch of its own (blossoming).
  BezierPatch restricted(const ParamBox& part) const;

 private:
  int degree_u_, degree_v_;
  ParamBox box_;
  std::vector<Vec4> control_;
  bool rational_;
};

}  // namespace mpm
