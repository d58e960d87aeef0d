// Proven lower bounds of the clearance between a tool and a piece of surface.
#pragma once

#include "mpm/contact/ring_kernel.h"
#include "mpm/surface/quadratic_cell.h"
#include "mpm/tool/tool.h"

namespace mpm {

// Least value of f + g1 a + g2 b + h11 a^2 + h12 a b + h22 b^2 over a, b in [-1, 1].
double least_quadratic(double f, double g1, double g2, double h11, double h12, double h22);

// One tool at one pose.
//
// Requires: the tool outlives it; a finite pose with a unit axis, in the frame of the cells.
// Threads: any number may ask one.
class ClearanceBound {
 public:
  ClearanceBound(const Tool& tool, const ToolPose& pose);

  struct Answer {
    double lower;   // mm: no point of the cell has a smaller signed distance from the tool's body
    double center;  // mm: signed distance of the cell's centre point; only as large as it is known to be
  };
  // The rest of the body alone; stops refining the bound when it has reached `enough`.
  Answer pieces(const QuadraticCell& cell, double enough) const;

  // The ring, and cheaply the rest of the body, over the cells of two batches at once (they may be the same):
  // first order by the cell's radius, then second order with the tool's signed curvature
  // (docs/methods/exact.md, section "Bound").
  void ring(const CellBatch& first,
            const CellBatch& second,
            const BoundAsk& ask,
            RingAnswer& first_answer,
            RingAnswer& second_answer) const {
    kernel_.bound(frame_, first, second, ask, first_answer, second_answer);
  }

  // The four quarters of one cell of a batch; their error is the whole's.
  void quarter(const CellBatch& whole, int lane, CellBatch& quarters) const {
    kernel_.quarter(whole, lane, quarters);
  }

  double rounding() const { return frame_.rounding; }

 private:
  struct Meridian {  // the cell's centre in the tool's half-plane
    double r, z;
    Vec3 radial;  // unit
  };
  Meridian meridian(const Vec3& s) const;

  const Tool& tool_;
  ToolPose pose_;
  const RingKernel& kernel_;
  RingFrame frame_;  // its rounding (mm) is the error of everything computed here (docs/numerics.md)
};

}  // namespace mpm
