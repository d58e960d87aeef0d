#include <gtest/gtest.h>

#include <random>

#include "mpm/base/frame.h"
#include "mpm/contact/drop.h"
#include "mpm/contact/insert.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kTouch = 1e-10;  // mm

class Random {
 public:
  double operator()(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }

 private:
  std::mt19937 engine_{20260101};
};

TEST(Insert, TiltedToolStaysTangentAtTheFirstContact) {
  const Tool tool = testing::thesis_tool();
  const ToolPose pose{Vec3(3, -2, 7), Vec3::UnitZ()};
  const Vec3 contact =
      pose.torus_center +
      Vec3(tool.major_radius + tool.minor_radius * std::cos(-1.0), 0, tool.minor_radius * std::sin(-1.0));
  const Insert insert = insert_through(tool, pose, contact);
  for (double tilt : {0.0, 0.2, 0.7}) {
    const ToolPose there = tilted(tool, insert, tilt);
    EXPECT_NEAR(signed_distance(tool, there, contact), 0.0, kTouch);
    EXPECT_NEAR(there.axis.norm(), 1.0, kTouch);
    EXPECT_NEAR((there.torus_center - insert.center).norm(), tool.major_radius, kTouch);
  }
  EXPECT_LT(tilted(tool, insert, 0.2).torus_center.z(), pose.torus_center.z());  // the far side goes down
}

// The closed form against the definition: at that tilt, and no earlier, the point lies on the ring.
TEST(Insert, CircularRayIsTheFirstTiltAtWhichTheRingReachesThePoint) {
  const Tool tool = testing::thesis_tool();
  const ToolPose pose{Vec3::Zero(), Vec3::UnitZ()};
  const Insert insert = insert_through(tool, pose, Vec3(-8, 0, -5));
  Random random;
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 s(random(-6, 14), random(-14, 14), random(-14, -6.2));
    const double tilt = circular_ray(tool, insert.to_local(s));
    if (!(tilt > 0.001 && tilt < 1.0)) continue;
    ++met;
    const auto ring = [&](double at) {
      const ToolPose p = tilted(tool, insert, at);
      const Vec3 d = s - p.torus_center;
      const double z = d.dot(p.axis);
      return std::hypot((d - z * p.axis).norm() - tool.major_radius, z) - tool.minor_radius;
    };
    EXPECT_NEAR(ring(tilt), 0.0, kTouch);
    for (int k = 1; k < 20; ++k) EXPECT_GT(ring(tilt * k / 20), 0.0) << s.transpose();
  }
  EXPECT_GT(met, 200);
}

TEST(Insert, APointInsideTheInsertsBallIsNeverReached) {
  const Tool tool = testing::thesis_tool();
  EXPECT_TRUE(std::isnan(circular_ray(tool, Vec3(0.1, 1.0, -5.0))));
}

TEST(Drop, HeightPutsThePointOnTheRing) {
  const Tool tool = testing::thesis_tool();
  for (double x : {0.8, 4.0, 6.7, 11.0, 12.69}) {
    const Vec3 s(20 + x, 30, -3);
    const double height = drop_height(tool, Vec2(20, 30), s);
    EXPECT_NEAR(std::hypot(x - tool.major_radius, height - s.z()), tool.minor_radius, kTouch);
  }
  EXPECT_EQ(drop_height(tool, Vec2(0, 0), Vec3(12.71, 0, 0)), -kInfinity);
}

}  // namespace
}  // namespace mpm
