#include <gtest/gtest.h>

#include "mpm/base/direction.h"
#include "mpm/base/pose_motion.h"

namespace mpm {
namespace {

Vec3 tilted(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }

TEST(PoseMotion, MidPoseOfAGreatCircle) {
  const TipPose middle = pose_between({{0, 0, 0}, tilted(0.2)}, {{4, 2, 0}, tilted(0.8)}, 0.5);
  EXPECT_LT((middle.tip - Vec3(2, 1, 0)).norm(), 1e-15);
  EXPECT_LT((middle.axis - tilted(0.5)).norm(), 1e-15);
}

TEST(PoseMotion, AxisTurnsEvenly) {
  const TipPose a{{0, 0, 0}, Vec3::UnitZ()}, b{{0, 0, 0}, Vec3(0, 1, 1).normalized()};
  for (double t : {0.0, 0.1, 0.7, 1.0}) {
    const TipPose p = pose_between(a, b, t);
    EXPECT_NEAR(p.axis.norm(), 1, 1e-15);
    EXPECT_NEAR(angle_between(a.axis, p.axis), t * kPi / 4, 1e-15);
  }
}

TEST(PoseMotion, EqualAxesStay) {
  const TipPose a{{0, 0, 0}, tilted(0.3)}, b{{1, 0, 0}, tilted(0.3)};
  EXPECT_LT((pose_between(a, b, 0.4).axis - a.axis).norm(), 1e-15);
}

}  // namespace
}  // namespace mpm
