#include <gtest/gtest.h>

#include <algorithm>

#include "machine/chains.h"
#include "mpm/machine/direction.h"
#include "mpm/machine/refine.h"

namespace mpm {
namespace {

using namespace mpm::testing;

PosePath two_poses(const Vec3& from, const Vec3& to) {
  return {{Vec3(0, 0, 0), Vec3(10, 0, 0)}, {from, to}, {0, 1}};
}

// Densely sampled, independently of the bound that refine uses.
double dense_deviation(const KinematicChain& chain, const RefinedPath& refined) {
  double worst = 0;
  for (std::size_t i = 1; i < refined.poses.size(); ++i)
    for (int k = 0; k <= 40; ++k) {
      const double s = k / 40.0;
      const Vec2 &a = refined.joints.rotary[i - 1], &b = refined.joints.rotary[i];
      const Vec3 meant = great_circle(refined.poses.axis[i - 1], refined.poses.axis[i], s);
      worst = std::max(worst, angle_between(tool_axis(chain, a + s * (b - a)), meant));
    }
  return worst;
}

TEST(Refine, CutsKeepTheTolerance) {
  for (double tolerance : {1e-3, 1e-5}) {
    const RefineOptions options{{}, tolerance};
    const RefinedPath refined =
        refine(inclined_head(), two_poses(direction(0.4, 0.0), direction(0.5, 1.5)), options);
    EXPECT_LE(dense_deviation(inclined_head(), refined), tolerance);
    EXPECT_GT(refined.poses.size(), 4u);
  }
}

TEST(Refine, GivenPosesAreKeptBitForBitAndPiecesKnowTheirMove) {
  PosePath path = two_poses(direction(0.4, 0.0), direction(0.5, 1.5));
  path.tip.push_back({20, 0, 0}), path.axis.push_back(direction(0.5, 1.5)), path.cutting.push_back(1);
  const RefinedPath refined = refine(inclined_head(), path, {{}, 1e-4});
  EXPECT_EQ(refined.poses.axis.front(), path.axis[0]);
  EXPECT_EQ(refined.poses.axis[refined.poses.size() - 2], path.axis[1]);
  EXPECT_EQ(refined.poses.tip.back(), path.tip[2]);
  EXPECT_EQ(refined.source.front(), 0u);
  EXPECT_EQ(refined.source[1], 1u);
  EXPECT_EQ(refined.source.back(), 2u);  // no turn: not split
}

TEST(Refine, MovesThatDoNotCutAreLeftAlone) {
  PosePath path = two_poses(direction(0.4, 0.0), direction(0.5, 1.5));
  path.cutting[1] = 0;
  const RefinedPath refined = refine(inclined_head(), path, {{}, 1e-6});
  EXPECT_EQ(refined.poses.size(), 2u);
  EXPECT_EQ(refined.keeps.back(), 0);
}

// Of the tip from its straight line while the joints run evenly.
double dense_tip_deviation(const KinematicChain& chain, const PartSetup& setup, const RefinedPath& refined) {
  double worst = 0;
  for (std::size_t i = 1; i < refined.poses.size(); ++i)
    for (int k = 0; k <= 40; ++k) {
      const double s = k / 40.0;
      const JointPath& j = refined.joints;
      const Joints at{j.linear[i - 1] + s * (j.linear[i] - j.linear[i - 1]),
                      j.rotary[i - 1] + s * (j.rotary[i] - j.rotary[i - 1])};
      const Vec3 meant = refined.poses.tip[i - 1] + s * (refined.poses.tip[i] - refined.poses.tip[i - 1]);
      worst = std::max(worst, (forward(chain, setup, at).tip - meant).norm());
    }
  return worst;
}

TEST(Refine, WithoutTipControlTheTipKeepsItsLineInRapidsToo) {
  for (std::uint8_t cutting : {0, 1}) {
    PosePath path = two_poses(direction(0.4, 0.0), direction(0.5, 1.5));
    path.cutting[1] = cutting;
    RefineOptions options{{{Vec3(80, 20, 50), 150}, 0}, 1e-3};
    options.tip_tolerance = 0.002;
    const RefinedPath refined = refine(inclined_head(), path, options);
    const double off = dense_tip_deviation(inclined_head(), options.joints.setup, refined);
    EXPECT_LE(off, 0.002);
    EXPECT_GE(off, 0.0005);  // not split for nothing
    EXPECT_EQ(std::count(refined.keeps.begin(), refined.keeps.end(), 1),
              std::ptrdiff_t(refined.keeps.size()));
  }
}

TEST(Refine, LargestStepIsKept) {
  RefineOptions options{{}, 1.0};
  options.max_rotary_step = radians(5.0);
  const RefinedPath refined =
      refine(inclined_head(), two_poses(direction(0.4, 0.0), direction(0.4, 1.5)), options);
  for (std::size_t i = 1; i < refined.poses.size(); ++i)
    EXPECT_LE((refined.joints.rotary[i] - refined.joints.rotary[i - 1]).cwiseAbs().maxCoeff(),
              radians(5.0001));
}

TEST(Refine, PassingNearThePoleKeepsTheTolerance) {
  const Vec3 from = Vec3(-0.1, 0.001, 1).normalized(), to = Vec3(0.1, 0.001, 1).normalized();
  const RefinedPath refined = refine(inclined_head(), two_poses(from, to), {{}, 1e-4});
  EXPECT_LE(dense_deviation(inclined_head(), refined), 1e-4);
}

// In the pole cone the head does not go where the poses say: no split helps, and it must be told.
TEST(Refine, WhatThePoleConeTakesCounts) {
  PosePath path = two_poses(direction(5e-5, 0.0), direction(5e-5, 1.5));
  path.tip.push_back({20, 0, 0}), path.axis.push_back(direction(0.3, 1.0)), path.cutting.push_back(1);
  const JointPathOptions cone{{}, 1e-4};
  const RefinedPath wide = refine(inclined_head(), path, {cone, 1e-3});
  EXPECT_LE(dense_deviation(inclined_head(), wide), 1e-3);
  EXPECT_EQ(std::count(wide.keeps.begin(), wide.keeps.end(), 0), 0);
  const RefinedPath narrow = refine(inclined_head(), path, {cone, 2e-5});
  EXPECT_GT(dense_deviation(inclined_head(), narrow), 2e-5);
  EXPECT_GT(std::count(narrow.keeps.begin(), narrow.keeps.end(), 0), 0);
  EXPECT_LT(narrow.poses.size(), 1000u);
}

TEST(Refine, TolerancesMustBePositive) {
  EXPECT_THROW(refine(inclined_head(), {}, {}), std::invalid_argument);
  EXPECT_THROW(refine(inclined_head(), {}, {{}, 1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(refine(inclined_head(), {}, {{}, 1.0, 1.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
