// A tensor-product B-spline surface (rational or not) of degree 1 to 10 and its Bézier patches.
#pragma once

#include <vector>

#include "mpm/surface/bezier_patch.h"

namespace mpm {

// Never changes once it is made.
//
// Threads: any number may share one.
class BSplineSurface {
 public:
  // `knots_u`, `knots_v`: flat, non-decreasing, multiplicities written out, poles + degree + 1 of them; the
  // ends need not be clamped; interior multiplicity at most the degree. `poles`: nu*nv points, row-major in
  // u. `weights`: empty (polynomial) or nu*nv positive numbers.
  //
  // Fails: std::invalid_argument that names the argument that is not so.
  BSplineSurface(int degree_u,
                 int degree_v,
                 const std::vector<double>& knots_u,
                 const std::vector<double>& knots_v,
                 const std::vector<Vec3>& poles,
                 const std::vector<double>& weights = {});

  const ParamBox& domain() const { return domain_; }
  int degree_u() const { return degree_u_; }
  int degree_v() const { return degree_v_; }

  // The Bézier patches, row-major in u: patch (i, j) covers breaks_u()[i..i+1] x breaks_v()[j..j+1].
  const std::vector<BezierPatch>& patches() const { return patches_; }
  const std::vector<double>& breaks_u() const { return breaks_u_; }
  const std::vector<double>& breaks_v() const { return breaks_v_; }

  // The patch whose parameter box holds (u, v); at a break the one after it; outside the domain the nearest.
  const BezierPatch& patch_at(double u, double v) const;
  // Beyond the domain the nearest patch is continued.
  Vec3 point(double u, double v) const { return patch_at(u, v).point(u, v); }
  SurfacePoint evaluate(double u, double v) const { return patch_at(u, v).evaluate(u, v); }

 private:
  int degree_u_, degree_v_;
  ParamBox domain_;
  std::vector<double> breaks_u_, breaks_v_;
  std::vector<BezierPatch> patches_;
};

}  // namespace mpm
