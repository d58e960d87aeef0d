// From positions to a path: cuts along the passes, and safe links over every gap.
#pragma once

#include "mpm/base/context.h"
#include "mpm/path/tool_path.h"
#include "mpm/surface/cell_tree.h"
#include "mpm/tool/tool.h"

namespace mpm {

// Where the tool is to stand, in machining order (structure of arrays, set-up frame, mm). A position that is
// not usable is left out; its tip and axis are not read.
struct PathPositions {
  std::vector<Vec3> tip;
  std::vector<Vec3> axis;  // unit, tip to spindle, z > 0
  std::vector<std::int32_t> pass;
  std::vector<std::uint8_t> usable;
  // mm, proven least clearance of the cut that ends in each position, NaN: it must not be cut. Empty: nothing
  // was proven, sampling decides.
  std::vector<double> cut_clearance;
};

struct LinkOptions {
  double safe_clearance = 5.0;         // mm from the highest surface to the tool's lowest point, on the plane
  double approach_distance = 2.0;      // mm, how near to the surfaces a rapid may come
  double gouge = 0.01;                 // mm, how much deeper than its position a plunge or retract may cut
  double cut_gouge = 0.2;              // mm, the same for a cut between its two positions
  double check_step = 1.0;             // mm between checked poses
  double cut_length_max = 10.0;        // mm of the tip, between two positions that one cut may join
  double cut_turn_max = radians(15);   // radians of the axis, the same
  double rapid_turn_max = radians(5);  // radians of the axis in one rapid move
  double depth = 0.01;        // mm, what a proven plunge or retract may cut in, its deviations included
  double tip_deviation = 0;   // mm, what the control may be off: the tip from its line ...
  double axis_deviation = 0;  // radians, ... and the axis from its great circle
};

// Joins the usable positions in their order. Every usable position is the end of exactly one cut or plunge,
// and the moves that name it.
//
// A cut joins a position with the next one (index + 1) when both are usable and of one pass, their tips and
// axes are within cut_length_max and cut_turn_max, and the cut was proven, or, where nothing is proven, the
// tool at poses check_step apart between them cuts no more than cut_gouge deeper than at its ends. Every
// other gap, the start and the end are bridged by: retract along the axis (or, where that cannot be proven,
// more along z: escape.h) to the safe plane; rapids on the plane, turning the axis on a great circle; rapid
// down to approach_distance; plunge.
//
// Guarantees: the first and last poses lie on the safe plane, where the whole tool (shank and holder too) is
// at least safe_clearance above all surfaces; so do all rapids but those down to a position, which keep
// approach_distance clear as far as sampling tells. Plunges and retracts that are `proven` cut in no deeper
// than `depth`, rapids that are `proven` not at all, the real tip and axis being off by their deviations; the
// others are sampled, and `blocked` where a sample is more than `gouge` deeper than their position. One-way
// and zigzag passes differ only in the positions' order.
//
// Clearances other than the proven ones are sampled (gouge/clearance_sampler.h), of the tool's whole body
// against all faces: no proof.
//
// Requires: a tree of the tool's judge_cells().
// Fails: std::invalid_argument for a wrong tool (check_tool), arrays of different length, usable positions
//   with a tip that is not finite or an axis that is not a unit vector from the +z side, options that are not
//   positive, and deviations that are negative or, of the tip, more than `depth`. A cancelled call returns an
//   empty path.
ToolPath link_passes(const CellTree& cells,
                     const Tool& tool,
                     const PathPositions& positions,
                     const LinkOptions& options,
                     Context& context);

}  // namespace mpm
