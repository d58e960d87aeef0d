// How deep points that are to stay lie inside what the tool sweeps: gouges in faces that are not machined.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/base/context.h"
#include "mpm/removal/stroke.h"

namespace mpm {

struct Overcut {
  std::vector<double> depth;       // mm, of each point below the tool's surface; 0: the tool never holds it
  std::vector<std::int32_t> move;  // the move during which it is deepest, -1: none
};

// Follows the motion of pose_between on the moves that remove material. The depth is that of signed_distance,
// at most the true one; unlike a ray it needs no outer side of the face, and near an edge it is no deeper
// than the tool is. It is looked for every kOvercutStep of the way wherever a greater one is possible, and
// refined round the deepest: exact but for a second dip that is less deep at all looks and deeper between
// two, by kOvercutStep^2 / (8 minor_radius), 0.05 um at Ri = 6 mm.
//
// Requires: points and path in one frame, mm.
// Guarantees: one depth and move a point, whatever the number of threads.
// Fails: std::invalid_argument as check_tool and check_swept_path do. A cancelled call leaves points at
//   depth 0.
Overcut find_overcut(const std::vector<Vec3>& points,
                     const Tool& tool,
                     const SweptPath& path,
                     Context& context);

inline constexpr double kOvercutStep = 0.05;  // mm

}  // namespace mpm
