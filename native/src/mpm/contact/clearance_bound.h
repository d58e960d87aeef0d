// Proven lower bounds of the clearance between a tool and a piece of surface.
#pragma once

#include "mpm/surface/quadratic_cell.h"
#include "mpm/tool/tool.h"

namespace mpm {

// Least value of f + g1 a + g2 b + h11 a^2 + h12 a b + h22 b^2 over a, b in [-1, 1].
double least_quadratic(double f, double g1, double g2, double h11, double h12, double h22);

// One tool at one pose; asks may come from several threads.
class ClearanceBound {
 public:
  ClearanceBound(const Tool& tool, const ToolPose& pose);

  struct Answer {
    double lower;   // mm: no point of the cell has a smaller signed distance from the tool's body
    double center;  // mm: signed distance of the cell's centre point; only as large as it is known to be
  };
  // Stops refining the bound when it has reached `enough`. First order by the cell's radius, then second
  // order with the tool's signed curvature (docs/methods/exact.md, section "Bound").
  Answer operator()(const QuadraticCell& cell, double enough) const;

 private:
  struct Meridian {  // the cell's centre in the tool's half-plane
    double r, z;
    Vec3 radial;  // unit
  };
  double ring_second_order(const QuadraticCell& cell, const Meridian& at, double distance) const;
  double convex_piece(const QuadraticCell& cell,
                      const Meridian& at,
                      double bottom_radius,
                      double top_radius,
                      double z0,
                      double z1,
                      double enough,
                      double& center) const;

  const Tool& tool_;
  ToolPose pose_;
  double rounding_;  // mm, error of everything computed here (docs/numerics.md)
};

}  // namespace mpm
