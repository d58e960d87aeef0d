#include <gtest/gtest.h>

#include "mpm/contact/lowest_point.h"
#include "planes.h"
#include "thesis.h"

namespace mpm {
namespace {

// A plane's nearest point to the ring, and how near it is, have closed forms.
TEST(LowestPoint, OfAPlane) {
  const double slope = 0.3;
  const SurfaceModel model = testing::inclined_plane(slope);
  const Vec3 normal = Vec3(-slope, 0, 1).normalized();
  const Tool tool = testing::thesis_tool();
  for (const double lean : {-0.4, 0.1, 0.9}) {
    const ToolPose pose{Vec3(50, 40, 27), Vec3(std::sin(lean), 0.2, std::cos(lean)).normalized()};
    const PatchMinimum lowest =
        lowest_point(tool, pose, model.faces()[0].surface.patches()[0], 0.5, 0.4, kInfinity);
    EXPECT_NEAR(lowest.value, testing::ring_over_plane(tool, pose, Vec3::Zero(), normal), 1e-9);
    EXPECT_NEAR(signed_distance(tool, pose, lowest.s), lowest.value, 1e-9);
    EXPECT_FALSE(lowest.on_border_u || lowest.on_border_v);
  }
}

// What cannot lead under the floor is left where it is.
TEST(LowestPoint, StopsWhereTheFloorIsOutOfReach) {
  const SurfaceModel model = testing::inclined_plane(0.3);
  const ToolPose pose{Vec3(50, 40, 40), Vec3(0.4, 0, 1).normalized()};
  const BezierPatch& patch = model.faces()[0].surface.patches()[0];
  const Tool tool = testing::thesis_tool();
  EXPECT_LT(lowest_point(tool, pose, patch, 0.48, 0.41, -100).newton_steps,
            lowest_point(tool, pose, patch, 0.48, 0.41, 100).newton_steps);
}

}  // namespace
}  // namespace mpm
