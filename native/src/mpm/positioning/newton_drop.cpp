#include "mpm/positioning/newton_drop.h"

#include <algorithm>

namespace mpm {

TangentPoint random_point(const SurfaceModel& model, const std::vector<Seed>& faces, SeedSource& random) {
  const std::size_t i = std::min(std::size_t(random(0, double(faces.size()))), faces.size() - 1);
  const ParamBox& d = model.faces()[faces[i].face].surface.domain();
  const double u = random(d.u0, d.u1), v = random(d.v0, d.v1);
  return {faces[i].face, u, v, Vec3::Zero(), Vec3::UnitZ()};
}

std::optional<DropSolution> newton_drop(const SurfaceModel& model,
                                        const Tool& tool,
                                        const Vec2& at,
                                        const std::vector<Seed>& faces,
                                        const NewtonRules& rules,
                                        const ToolGrid& grid,
                                        int most_seeds,
                                        SeedSource& random,
                                        Counters& counters) {
  for (int i = 0; i < most_seeds; ++i) {
    const std::size_t given = std::size_t(i);
    DropSolution start;
    if (given < faces.size())
      start.contact = {faces[given].face, faces[given].u, faces[given].v, Vec3::Zero(), Vec3::UnitZ()};
    else
      start.contact = random_point(model, faces, random);
    const auto found = solve_drop(model, tool, at, rules, start, counters);
    if (!found) continue;
    const ToolPose pose{Vec3(at.x(), at.y(), found->height), Vec3::UnitZ()};
    if (!grid.gouges(model, tool, pose, faces, counters)) return found;
  }
  return {};
}

}  // namespace mpm
