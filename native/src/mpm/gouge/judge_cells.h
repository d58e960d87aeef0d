// The cells that the judges of poses and motions work on: made once for a model and a tool, then shared.
#pragma once

#include "mpm/surface/cell_tree.h"
#include "mpm/tool/tool.h"

namespace mpm {

// Its smallest cells are a sixth of the cutter's radius; proofs go on below them.
//
// Requires: the model outlives it.
inline CellTree judge_cells(const SurfaceModel& model, const Tool& tool) {
  constexpr double kLeafPerRadius = 1.0 / 6;
  return CellTree(model, tool.radius() * kLeafPerRadius);
}

}  // namespace mpm
