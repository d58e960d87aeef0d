// Proven lower bounds of the clearance between a moving tool and a piece of surface.
#pragma once

#include <array>

#include "mpm/surface/quadratic_cell.h"
#include "mpm/tool/tool.h"

namespace mpm {

// f + g1 a + g2 b + g3 t + h11 a^2 + h12 a b + h22 b^2 + h13 a t + h23 b t + h33 t^2.
struct Quadratic3 {
  double f = 0;
  std::array<double, 3> g{};
  std::array<double, 6> h{};  // 11, 12, 22, 13, 23, 33
};

// Least value of q over a, b, t in [-1, 1], or a little less (by 1e-9 of the largest second-order
// coefficient, where q is nearly flat in some direction).
double least_quadratic(const Quadratic3& q);

// The tool between two poses: the tip on a straight line, the axis on a great circle, both running evenly
// with t from 0 to 1. The axes need not be exactly of unit length.
//
// Requires: axes that are not opposite: certify_motion() sees to it.
class ToolMotion {
 public:
  ToolMotion(const Tool& tool, const ToolPose& from, const ToolPose& to);

  // A stretch of the motion, about the pose at its middle: in the time t of [-1, 1] the tip moves by
  // t half_step and the axis turns by t half_turn about `pivot`.
  struct Stretch {
    ToolPose middle;
    Vec3 tip, half_step, pivot;
    double half_turn;  // radians
  };
  Stretch stretch(double t0, double t1) const;
  ToolPose at(double t) const { return stretch(t, t).middle; }

  // mm, the largest coordinate of a tip.
  double magnitude() const;

  // Contains the tool all the way, the real axis being off by at most axis_deviation (radians).
  Box3 swept_box(const Tool& tool, double axis_deviation) const;

 private:
  double minor_radius_;
  Vec3 from_, to_, axis_, sideways_, pivot_;
  double turn_;
};

// What the surface of a cell does in the frame of the tool at the middle of a stretch: for every point s of
// the cell and every time there are x = (a, b, t) in [-1, 1]^3 with
//   |s seen from the tool - (c + sum_i x_i first[i] + sum_(i<=j) x_i x_j second[ij])| <= error.
struct MovingCell {
  Vec3 c;
  std::array<Vec3, 3> first;
  std::array<Vec3, 6> second;  // in the order of Quadratic3::h
  double error;                // mm
  double radius;               // mm: nothing is farther from c
  double travel;               // mm, the part of it that a shorter stretch would take away
  double allowance;            // mm, what axis_deviation may move c
};

// axis_deviation: radians by which the real axis may differ from the great circle at any time. It turns the
// tool about its tip, so that a point at distance L from the tip is off by at most axis_deviation L.
MovingCell moving_cell(const QuadraticCell& cell, const ToolMotion::Stretch& stretch, double axis_deviation);

// The tool in one stretch of a motion.
//
// Requires: the tool outlives it.
// Threads: any number may ask one.
class MotionBound {
 public:
  // `magnitude`: the largest coordinate of the motion's tips, mm, for the rounding margin.
  MotionBound(const Tool& tool, const ToolPose& middle, double magnitude);

  struct Answer {
    double lower;   // mm: the clearance of the moving tool from the cell is never smaller
    double center;  // mm: signed distance of c at the middle of the stretch
  };
  // Stops refining the bound when it has reached `enough`. First order by the radius, then second order with
  // the tool's signed curvature (docs/motion.md).
  Answer operator()(const MovingCell& cell, double enough) const;

 private:
  struct Meridian {  // c in the tool's half-plane
    double r, z;
    Vec3 radial;  // unit
  };
  double ring(const MovingCell& cell, const Meridian& at) const;
  Answer pieces(const MovingCell& cell, const Meridian& at, double enough) const;

  const Tool& tool_;
  ToolPose pose_;
  double size_;  // mm, of the numbers that are rounded here
};

}  // namespace mpm
