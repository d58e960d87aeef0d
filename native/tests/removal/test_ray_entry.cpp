#include <gtest/gtest.h>

#include <random>

#include "mpm/removal/ray_entry.h"

namespace mpm {
namespace {

constexpr double kTolerance = 1e-6;

TEST(RayEntry, BallIsASphere) {
  const Tool ball{0, 5, 0, 30, {}};
  const ToolPose pose = ToolPose::from_tip(ball, {1, 2, 3}, Vec3(0.2, -0.1, 1).normalized());
  for (double r : {0.0, 1.0, 3.0, 4.5}) {
    const double expected = pose.torus_center.z() - std::sqrt(25 - r * r);
    EXPECT_NEAR(lowest_point(ball, pose, pose.torus_center.x() + r, pose.torus_center.y(), kTolerance),
                expected,
                1e-5);
  }
}

TEST(RayEntry, TiltedFlatEndIsAPlaneUpToItsRim) {
  const Tool flat{5, 0, 0, 30, {}};
  const double tilt = 0.4;
  const ToolPose pose = ToolPose::from_tip(flat, Vec3::Zero(), Vec3(std::sin(tilt), 0, std::cos(tilt)));
  for (double x : {-4.0, 0.0, 4.0})
    EXPECT_NEAR(lowest_point(flat, pose, x, 0, kTolerance), -x * std::tan(tilt), 1e-12);
  EXPECT_EQ(lowest_point(flat, pose, 0, 5.01, kTolerance), kInfinity);
  // Beyond the raised rim the ray meets the side of the flutes... on the low side there is nothing but the
  // rim.
  EXPECT_EQ(lowest_point(flat, pose, -5 * std::cos(tilt) - 0.01, 0, kTolerance), kInfinity);
}

TEST(RayEntry, UprightTorus) {
  const Tool torus{6.7, 6.0, 6.0, 30, {}};
  const ToolPose pose = ToolPose::from_tip(torus, {0, 0, 0}, Vec3::UnitZ());
  EXPECT_NEAR(lowest_point(torus, pose, 6.7, 0, kTolerance), 0, 1e-5);
  EXPECT_NEAR(lowest_point(torus, pose, 0, 9.7, kTolerance), 6 - std::sqrt(36 - 9), 1e-5);
  EXPECT_NEAR(lowest_point(torus, pose, 3.7, 0, kTolerance), 6 - std::sqrt(36 - 9), 1e-5);  // inside the ring
  EXPECT_NEAR(lowest_point(torus, pose, 0, 0, kTolerance), 6, 1e-5);  // roof of the recess
}

TEST(RayEntry, ConeOpensUpwards) {
  const Tool tool{5, 0, 0, 10, {{5, 15, 10}}};
  const ToolPose pose = ToolPose::from_tip(tool, Vec3::Zero(), Vec3::UnitZ());
  EXPECT_NEAR(lowest_point(tool, pose, 10, 0, kTolerance), 15, 1e-12);
  EXPECT_EQ(lowest_point(tool, pose, 15.1, 0, kTolerance), kInfinity);
}

TEST(RayEntry, LimitCutsOff) {
  const Tool ball{0, 5, 0, 30, {}};
  const ToolPose pose = ToolPose::from_tip(ball, Vec3::Zero(), Vec3::UnitZ());
  EXPECT_EQ(lowest_point(ball, pose, 0, 0, kTolerance, -0.1), kInfinity);
  EXPECT_NEAR(lowest_point(ball, pose, 0, 0, kTolerance, 0.1), 0, 1e-5);
}

// Against the tool's own distance: nothing of the body below the entry, the body (to the tolerance) at it.
TEST(RayEntry, AgreesWithSignedDistance) {
  const Tool tools[] = {{6.7, 6.0, 6.0, 30, {{9, 9, 10}, {20, 30, 25}}},
                        {6.7, 3.0, 1.0, 20, {{12, 8, 10}}},
                        {0, 4, 0, 20, {{4, 10, 8}}},
                        {8, 0, 0, 20, {}}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  int hits = 0;
  for (const Tool& tool : tools)
    for (int n = 0; n < 500; ++n) {
      const ToolPose pose =
          ToolPose::from_tip(tool, Vec3::Zero(), Vec3(unit(random), unit(random), 1).normalized());
      const double x = 15 * unit(random), y = 15 * unit(random);
      const double z = lowest_point(tool, pose, x, y, kTolerance);
      const double top = std::min(z, 60.0);
      for (double below = -40; below < top; below += 0.5)
        EXPECT_GT(signed_distance(tool, pose, {x, y, below}), -1e-9);
      if (z == kInfinity) continue;
      ++hits;
      EXPECT_LT(signed_distance(tool, pose, {x, y, z}), 2 * kTolerance);
    }
  EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace mpm
