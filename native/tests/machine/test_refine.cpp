#include <gtest/gtest.h>

#include <algorithm>

#include "machine/chains.h"
#include "mpm/base/direction.h"
#include "mpm/machine/orientation.h"
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

constexpr double kCone = 7e-6, kTolerance = 2e-4, kStep = 0.17;  // as the shipped machines have them, radians

// A cut whose axis passes the pole of the chain (its first axis) at the angle `distance`.
RefinedPath past_the_pole(const KinematicChain& chain, double distance, double cone = kCone) {
  const Vec3 pole = chain.rotary[0].rotation_vector, along = pole.unitOrthogonal(),
             across = pole.cross(along);
  const auto pose = [&](double s) -> Vec3 {
    return (std::cos(distance) * (std::cos(s) * pole + std::sin(s) * along) + std::sin(distance) * across)
        .normalized();
  };
  RefineOptions options{{}, kTolerance};
  options.joints.pole_cone = cone;
  options.max_rotary_step = kStep;
  return refine(chain, two_poses(pose(-0.1), pose(0.13)), options);
}

double largest_step(const JointPath& joints) {
  double largest = 0;
  for (std::size_t i = 1; i < joints.rotary.size(); ++i)
    largest = std::max(largest, (joints.rotary[i] - joints.rotary[i - 1]).cwiseAbs().maxCoeff());
  return largest;
}

void expect_good(const KinematicChain& chain, const RefinedPath& refined) {
  EXPECT_LE(dense_deviation(chain, refined), kTolerance);
  EXPECT_LE(largest_step(refined.joints), kStep * (1 + 1e-9));
  EXPECT_EQ(std::count(refined.keeps.begin(), refined.keeps.end(), 1), std::ptrdiff_t(refined.keeps.size()));
  for (JointStatus s : refined.joints.status) EXPECT_EQ(s, JointStatus::ok);
}

TEST(Refine, ThroughThePoleAndNearItTheToolKeepsItsWay) {
  for (KinematicChain chain : chains())
    for (bool may_flip : {false, true})
      for (double distance : {0.0, 1e-9, 3e-6, 6.9e-6, 7.1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        SCOPED_TRACE(std::string(1, chain.rotary[0].name) + chain.rotary[1].name + ", " +
                     std::to_string(1e6 * distance) + " µrad" + (may_flip ? ", may flip" : ""));
        chain.allow_flip = may_flip;
        // the last chain is out of square: it comes no nearer to its pole than 15 mrad
        if (OrientationInverse(chain).solve(chain.rotary[0].rotation_vector).reachable)
          expect_good(chain, past_the_pole(chain, distance));
      }
}

TEST(Refine, ThroughThePoleTheFirstAxisTurnsOnTheSpotOrTheSecondGoesOnThroughZero) {
  KinematicChain chain = chain_of(table('C', Vec3::UnitZ()), head('B', Vec3::UnitY()));
  const RefinedPath through = past_the_pole(chain, 0);
  EXPECT_LE(std::abs(through.joints.rotary.back()[0] - through.joints.rotary.front()[0]), 1e-9);
  EXPECT_LT(through.joints.rotary.back()[1] * through.joints.rotary.front()[1], 0);

  chain.rotary[1].min_limit = 0;
  const RefinedPath turned = past_the_pole(chain, 0);
  EXPECT_NEAR(std::abs(turned.joints.rotary.back()[0] - turned.joints.rotary.front()[0]), kPi, 1e-9);
  double tilt = 0;  // where the first axis turns
  for (std::size_t i = 1; i < turned.poses.size(); ++i)
    if (turned.joints.rotary[i][0] != turned.joints.rotary[i - 1][0])
      tilt = std::max({tilt, turned.joints.rotary[i][1], turned.joints.rotary[i - 1][1]});
  EXPECT_GT(tilt, 0);
  EXPECT_LE(tilt, 2 * kCone);
}

TEST(Refine, AMachineOutOfSquareStandsUprightWithinTheCone) {
  const Vec3 first = Vec3(0, std::sin(5e-5), std::cos(5e-5));  // 50 µrad: 0.015 mm in 300 mm
  const KinematicChain chain = chain_of(table('C', first), head('B', Vec3::UnitY()));
  expect_good(chain, past_the_pole(chain, 0, 6e-5));
  const JointPath small = past_the_pole(chain, 0, 1e-5).joints;
  EXPECT_GT(std::count(small.status.begin(), small.status.end(), JointStatus::unreachable), 0);
}

TEST(Refine, WhatThePoleConeTakesCounts) {
  PosePath path = two_poses(direction(5e-5, 0.0), direction(5e-5, 1.5));
  path.tip.push_back({20, 0, 0}), path.axis.push_back(direction(0.3, 1.0)), path.cutting.push_back(1);
  for (double tolerance : {1e-3, 2e-5}) {
    const RefinedPath refined = refine(inclined_head(), path, {{{}, 1e-4}, tolerance});
    EXPECT_LE(dense_deviation(inclined_head(), refined), tolerance);
    EXPECT_EQ(std::count(refined.keeps.begin(), refined.keeps.end(), 0), 0);
  }
}

TEST(Refine, ALargeConeIsCutDownToTheTolerance) {
  const KinematicChain chain = inclined_head();
  for (double cone : {1e-4, 1e-2}) expect_good(chain, past_the_pole(chain, 5e-5, cone));
}

TEST(Refine, TolerancesMustBePositive) {
  EXPECT_THROW(refine(inclined_head(), {}, {}), std::invalid_argument);
  EXPECT_THROW(refine(inclined_head(), {}, {{}, 1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(refine(inclined_head(), {}, {{}, 1.0, 1.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
