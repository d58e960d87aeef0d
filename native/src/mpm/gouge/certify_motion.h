// The judge of a move between two poses: branch and bound over the whole surface set, the whole tool and the
// whole time of the move. Uses nothing of the positioning.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/base/context.h"
#include "mpm/base/verdict.h"
#include "mpm/surface/cell_tree.h"
#include "mpm/tool/tool.h"

namespace mpm {

struct MotionCertificate {
  Verdict verdict = Verdict::undecided;
  double lo = -kInfinity;         // mm: proven never to be less (nothing near: 0, or what was asked for)
  double hi = kInfinity;          // mm: the clearance at the witness
  double time = kNaN;             // of the witness, 0 to 1
  Vec3 s = Vec3::Constant(kNaN);  // the witness: a surface point
  std::uint64_t cells = 0;        // pairs of sub-patch and time interval bounded
};

struct CertifyMotionOptions {
  double tolerance = 0.01;         // mm: what a free motion may cut in; negative: the clearance it must keep
  double axis_deviation = 0.0;     // radians: what the real axis may be off the great circle
  std::uint32_t budget = 100'000;  // cells; beyond it the verdict is undecided
};

// Proves a lower bound of the clearance of the tool from every face all the way from pose `from` to pose `to`
// (tip on a straight line, axis on a great circle, both even in time), the real axis being off by at most
// axis_deviation. A motion whose swept box keeps off that of all faces takes no cell. Pieces of trimmed faces
// too small to tell from their border count as surface (quarters.h says how small).
//
// Requires: finite poses with unit axes, a tree of the tool's judge_cells().
//
// Guarantees: free: lo >= -tolerance; gouge: the tool on the great circle cuts deeper than the tolerance at
// the witness. Unless free, lo is -infinity.
//
// Fails: undecided when the budget ran out, or a point was found so deep that the deviation could take it
// beyond the tolerance, or the call was cancelled, or the axes are opposite. Nothing is checked: that is up
// to certify_motions().
//
// Threads: any number may share the tree.
MotionCertificate certify_motion(const CellTree& tree,
                                 const Tool& tool,
                                 const ToolPose& from,
                                 const ToolPose& to,
                                 const CertifyMotionOptions& options,
                                 const Context& context);

// One move, and what is asked of it.
struct Motion {
  ToolPose from, to;
  CertifyMotionOptions options;
};

// Every motion, in parallel.
//
// Requires: a tree of the tool's judge_cells().
// Guarantees: one certificate a motion, in their order, whatever the number of threads.
// Fails: std::invalid_argument for a wrong tool (check_tool), numbers that are not finite, axes that are not
//   unit vectors, and a deviation that is negative. What a cancel left out, or broke off, is undecided.
std::vector<MotionCertificate> certify_motions(const CellTree& tree,
                                               const Tool& tool,
                                               const std::vector<Motion>& motions,
                                               Context& context);

}  // namespace mpm
