// The drop step of drop and tilt (paper A.2): Newton from seeds until a contact passes the gouge check.
#pragma once

#include "mpm/positioning/contact_newton.h"
#include "mpm/positioning/seed_source.h"
#include "mpm/positioning/tool_grid.h"

namespace mpm {

// A random start on one of the faces under the tool.
TangentPoint random_point(const SurfaceModel& model, const std::vector<Seed>& faces, SeedSource& random);

// The first start is the sample under the footprint point, the others are random, `most_seeds` in all.
// Nothing where none leads to a tangent contact free of gouging by the grid.
std::optional<DropSolution> newton_drop(const SurfaceModel& model,
                                        const Tool& tool,
                                        const Vec2& at,
                                        const std::vector<Seed>& faces,
                                        const NewtonRules& rules,
                                        const ToolGrid& grid,
                                        int most_seeds,
                                        SeedSource& random,
                                        Counters& counters);

}  // namespace mpm
