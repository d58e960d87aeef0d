#include "mpm/positioning/tool_grid.h"

#include "mpm/contact/vertical_ray.h"

namespace mpm {
namespace {

constexpr double kPlanTolerance = 1e-6;  // mm, well below any gouge tolerance: so no part of the tool
constexpr RayLimits kRay{kPlanTolerance, 20};

}  // namespace

bool ToolGrid::gouges(const SurfaceModel& model,
                      const Tool& tool,
                      const ToolPose& pose,
                      const std::vector<Seed>& seeds,
                      Counters& counters) const {
  const Vec3 e1 = pose.axis.unitOrthogonal(), e2 = pose.axis.cross(e1);
  RayWork work;
  const auto below = [&](Seed seed) {
    for (int i = 0; i <= theta_divisions; ++i)
      for (int j = 0; j < phi_divisions; ++j) {
        const double theta = kPi * (1 + double(i) / theta_divisions), phi = 2 * kPi * j / phi_divisions;
        const double r = tool.major_radius + tool.minor_radius * std::cos(theta);
        const Vec3 x = pose.torus_center + r * (std::cos(phi) * e1 + std::sin(phi) * e2) +
                       tool.minor_radius * std::sin(theta) * pose.axis;
        Vec3 s;
        if (meet_vertical_ray(model.faces()[seed.face], {}, x.head<2>(), kRay, seed.u, seed.v, s, work) &&
            x.z() < s.z() - gouge)
          return true;
      }
    return false;
  };
  bool any = false;
  for (const Seed& seed : seeds) any = any || below(seed);
  counters.evaluations += work.evaluations;
  return any;
}

}  // namespace mpm
