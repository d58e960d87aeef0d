#include <gtest/gtest.h>

#include "mpm/gouge/sample_poses.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kRefined = 1e-6;  // mm: a plane is sampled to the last refinement

ToolPose upright(double x, double z) { return {Vec3(x, 50, z), Vec3::UnitZ()}; }

// Over a level plane the clearance is the height of the ring's lowest circle.
TEST(SamplePoses, OverAPlane) {
  const SurfaceModel model = testing::inclined_plane(0);
  const Tool tool = testing::thesis_tool();
  std::vector<ToolPose> poses;
  for (int i = 0; i < 40; ++i) poses.push_back(upright(30 + i, tool.minor_radius + 0.1 * (i - 20)));
  poses.push_back({Vec3::Constant(kNaN), Vec3::UnitZ()});
  poses.push_back(upright(50, 1000));
  Context one(1), two(2);
  const std::vector<double> found = sample_poses(model, tool, poses, one);
  for (int i = 0; i < 40; ++i) EXPECT_NEAR(found[std::size_t(i)], 0.1 * (i - 20), kRefined) << i;
  EXPECT_EQ(found[40], kInfinity);
  EXPECT_EQ(found[41], tool.radius());  // no farther than that is looked
  EXPECT_EQ(sample_poses(model, tool, poses, two), found);
}

TEST(SamplePoses, WhatACancelLeavesOutIsInfinite) {
  const SurfaceModel model = testing::inclined_plane(0);
  Context context(1);
  context.cancel();
  EXPECT_EQ(sample_poses(model, testing::thesis_tool(), {upright(50, 0)}, context)[0], kInfinity);
}

}  // namespace
}  // namespace mpm
