#include "mpm/removal/normal_rays.h"

#include <cmath>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/removal/ray_tile.h"

namespace mpm {
namespace {

constexpr double kUnitRayTolerance = 1e-9;

void check_rays(const NormalRays& rays) {
  require(rays.height.size() == rays.rays.size() && rays.move.size() == rays.rays.size(),
          "origins, directions, height and move must have the same length");
  require(std::isfinite(rays.below) && rays.below >= 0, "below_mm must be a finite number, 0 or more");
  for (const Ray& ray : rays.rays)
    require(ray.origin.allFinite() && std::abs(ray.direction.norm() - 1) < kUnitRayTolerance,
            "origins must be finite, directions unit vectors");
}

}  // namespace

void cut_rays(NormalRays& rays, const ToolSweep& sweep, Context& context) {
  check_rays(rays);
  const std::vector<std::uint32_t> order = near_together(rays.rays);
  context.start(order.size());
  for_each_range(order.size(), kTileRays, context, [&](std::size_t begin, std::size_t end) {
    RayTile(rays, sweep, order.data() + begin, end - begin).cut(context);
  });
}

}  // namespace mpm
