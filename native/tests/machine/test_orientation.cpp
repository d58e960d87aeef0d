#include <gtest/gtest.h>

#include "machine/chains.h"
#include "mpm/base/frame.h"
#include "mpm/machine/forward.h"
#include "mpm/machine/orientation.h"

namespace mpm {
namespace {

using namespace mpm::testing;

constexpr double kResidual = 1e-12;  // the contract asks for 1e-9

void expect_met(const KinematicChain& chain, const Vec3& axis) {
  const OrientationSolutions solutions = OrientationInverse(chain).solve(axis);
  ASSERT_TRUE(solutions.reachable) << axis.transpose();
  for (const Vec2& rotary : solutions.rotary)
    EXPECT_LE((tool_axis(chain, rotary) - axis).norm(), kResidual)
        << axis.transpose() << " by " << rotary.transpose();
}

TEST(Orientation, BothSolutionsOfRandomAxisPairsMeetTheAxis) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  for (int i = 0; i < 2000; ++i) {
    KinematicChain chain =
        chain_of(table('C', random_direction(random)), head('B', random_direction(random)));
    chain.spindle_axis = random_direction(random);
    chain.rotary[0].sense = i % 2 ? 1 : -1;
    chain.rotary[1].zero_offset = angle(random);
    expect_met(checked(chain), tool_axis(chain, {angle(random), angle(random)}));
  }
}

TEST(Orientation, SolutionsDifferAwayFromPoleAndReach) {
  const OrientationSolutions s = OrientationInverse(inclined_head()).solve(direction(0.3, 1.0));
  EXPECT_GT(s.rotary[0][1], 0.4);
  EXPECT_LT(s.rotary[1][1], -0.4);
}

TEST(Orientation, PosesAtEveryDistanceFromThePoleAreMet) {
  for (double tilt = 1.0; tilt > 1e-18; tilt *= 0.3)
    for (double azimuth = -3.0; azimuth < 3.2; azimuth += 0.7)
      expect_met(inclined_head(), direction(tilt, azimuth));
  expect_met(inclined_head(), Vec3::UnitZ());
}

TEST(Orientation, PoleLeavesTheFirstAxisFree) {
  const OrientationSolutions s = OrientationInverse(inclined_head()).solve(Vec3::UnitZ());
  EXPECT_EQ(s.pole_distance, 0.0);
  EXPECT_EQ(s.rotary[0][0], 0.0);
  EXPECT_NEAR(OrientationInverse(inclined_head()).solve(direction(0.01, 2.0)).pole_distance, 0.01, 1e-15);
}

TEST(Orientation, EndOfReachIsMetAndBeyondIsToldWithTheNearest) {
  for (double gap : {0.0, 1e-15, 1e-9, 1e-5}) expect_met(inclined_head(), direction(kPi / 2 - gap, 0.4));
  const OrientationSolutions beyond =
      OrientationInverse(inclined_head()).solve(direction(kPi / 2 + 0.1, 0.4));
  EXPECT_FALSE(beyond.reachable);
  EXPECT_LE((tool_axis(inclined_head(), beyond.rotary[0]) - direction(kPi / 2, 0.4)).norm(), kResidual);
}

TEST(Orientation, HoleOfTheReachIsTold) {
  // The head cannot bring the spindle nearer than 5 degrees to the table's axis.
  KinematicChain chain = inclined_head();
  chain.spindle_axis = rotation(Vec3::UnitX(), radians(5.0)) * Vec3::UnitZ();
  EXPECT_FALSE(OrientationInverse(checked(chain)).solve(Vec3::UnitZ()).reachable);
  expect_met(checked(chain), direction(radians(5.0) + 1e-9, 1.0));
}

TEST(Orientation, InclinedHeadHasTheKnownAnglesAndLag) {
  // tilt -> B and lag of C, from B = arccos(2 cos(tilt) - 1)
  const double rows[][3] = {{1, 1.414, 0.5}, {20, 28.43, 10.16}, {45, 65.53, 24.47}, {60, 90, 35.26}};
  for (const auto& [tilt, b, lag] : rows) {
    const Vec2 r =
        OrientationInverse(inclined_head()).solve(direction(radians(tilt), radians(100))).rotary[0];
    EXPECT_NEAR(degrees(r[1]), b, 0.006);
    EXPECT_NEAR(100 - degrees(r[0]), lag, 0.006);
  }
}

TEST(Orientation, OrthogonalPairsHaveTheTextbookAngles) {
  const Vec3 t = direction(0.5, 1.2);
  const Vec2 bc =
      OrientationInverse(chain_of(table('C', Vec3::UnitZ()), head('B', Vec3::UnitY()))).solve(t).rotary[0];
  EXPECT_NEAR(bc[1], 0.5, kResidual);
  EXPECT_NEAR(bc[0], 1.2, kResidual);
  const Vec2 ac =
      OrientationInverse(chain_of(table('C', Vec3::UnitZ()), table('A', Vec3::UnitX()))).solve(t).rotary[0];
  EXPECT_NEAR(ac[1], 0.5, kResidual);
  EXPECT_NEAR(ac[0], std::atan2(t.x(), -t.y()), kResidual);
}

TEST(Orientation, ReadingsFollowSenseAndZeroOffset) {
  KinematicChain chain = inclined_head();
  const Vec2 plain = OrientationInverse(chain).solve(direction(0.3, 1.0)).rotary[0];
  chain.rotary[1].sense = -1;
  chain.rotary[1].zero_offset = 0.25;
  const Vec2 turned = OrientationInverse(chain).solve(direction(0.3, 1.0)).rotary[0];
  EXPECT_NEAR(turned[1], 0.25 - plain[1], kResidual);
  EXPECT_NEAR(turned[0], plain[0], kResidual);
}

TEST(KinematicChain, ImpossibleOnesAreRefused) {
  EXPECT_THROW(chain_of(table('C', Vec3::UnitZ()), head('B', Vec3::UnitZ())), std::invalid_argument);
  EXPECT_THROW(chain_of(table('A', Vec3::UnitX()), head('C', Vec3::UnitZ())), std::invalid_argument);
  EXPECT_THROW(chain_of(head('B', Vec3::UnitY()), table('A', Vec3::UnitX())), std::invalid_argument);
  EXPECT_THROW(chain_of(table('C', Vec3::UnitZ()), head('C', Vec3::UnitY())), std::invalid_argument);
  EXPECT_THROW(chain_of(table('C', Vec3::Zero()), head('B', Vec3::UnitY())), std::invalid_argument);
  RotaryAxis b = head('B', Vec3::UnitY());
  b.sense = 0;
  EXPECT_THROW(chain_of(table('C', Vec3::UnitZ()), b), std::invalid_argument);
  b.sense = 1, b.min_limit = 1, b.max_limit = 0;
  EXPECT_THROW(chain_of(table('C', Vec3::UnitZ()), b), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
