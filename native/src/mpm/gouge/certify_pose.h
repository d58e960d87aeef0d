// The judge of one pose: branch and bound over the whole surface set and the whole tool. Uses nothing of the
// positioning.
#pragma once

#include <cstdint>

#include "mpm/base/verdict.h"
#include "mpm/surface/cell_tree.h"
#include "mpm/tool/tool.h"

namespace mpm {

struct Witness {
  std::uint32_t face = 0;
  double u = kNaN, v = kNaN;
  Vec3 s = Vec3::Constant(kNaN);
  double distance = kInfinity;  // signed, mm
};

struct PoseCertificate {
  Verdict verdict = Verdict::undecided;
  double lo = -kInfinity;   // mm: the clearance is proven to be at least this (0 where nothing came near)
  double hi = kInfinity;    // mm: the clearance is at most this (the witness has it)
  Witness witness;          // the lowest surface point met
  std::uint64_t cells = 0;  // sub-patches bounded
};

struct CertifyPoseOptions {
  double tolerance = 1e-3;  // mm: what may be cut in and still be called free
  double sharpness = 1e-3;  // mm: while the sharp budget lasts, points deeper than this are searched for
  double enough = 0.0;      // mm: lower bounds beyond this are not sharpened
  std::uint32_t sharp_budget = 0;  // cells
  std::uint32_t budget = 200'000;  // cells; beyond it the verdict is undecided
  bool stop_at_violation = false;  // return at the first surface point deeper than `sharpness`
};

// Proves a lower bound of the clearance of the tool at `pose` from every face. Cells are split until proven
// to the tolerance, and until what they may hold of points deeper than the sharpness was looked for: by an
// estimate of their least clearance, or by Newton's iteration; that part is searched, not proven. Pieces of
// trimmed faces too small to tell from their border count as surface (quarters.h says how small).
//
// Requires: a finite pose with a unit axis, a tree of the tool's judge_cells(), 0 < sharpness <= tolerance.
//
// Guarantees: free: lo >= -tolerance; gouge: a surface point deeper than the tolerance is in `witness`.
//
// Fails: undecided, with lo = -infinity, when the budget ran out or the search stopped at a violation that is
// within the tolerance. Nothing is checked, and no cancel is looked at: a budget ends it.
//
// Threads: any number may share the tree.
PoseCertificate certify_pose(const CellTree& tree,
                             const Tool& tool,
                             const ToolPose& pose,
                             const CertifyPoseOptions& options);

}  // namespace mpm
