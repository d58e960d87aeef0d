#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "machine/chains.h"
#include "mpm/base/direction.h"
#include "mpm/machine/joint_motion.h"

namespace mpm {
namespace {

using namespace mpm::testing;

const PartSetup kSetup{Vec3(30, -40, 120), 137};

Joints random_joints(std::mt19937& random) {
  std::uniform_real_distribution<double> linear(-200, 200), rotary(-2, 2);
  return {{linear(random), linear(random), linear(random)}, {rotary(random), rotary(random)}};
}

Joints between(const Joints& a, const Joints& b, double s) {
  return {a.linear + s * (b.linear - a.linear), a.rotary + s * (b.rotary - a.rotary)};
}

// The joints meet both ends of what was meant.
AxisWay own_way(const KinematicChain& chain, const Vec2& from, const Vec2& to) {
  return {tool_axis(chain, from), tool_axis(chain, to)};
}

MotionDeviation bound_of(const KinematicChain& chain,
                         const PartSetup& setup,
                         const Joints& from,
                         const Joints& to) {
  return deviation_bound(chain, setup, from, to, own_way(chain, from.rotary, to.rotary));
}

double sampled_axis(const KinematicChain& chain, const Vec2& from, const Vec2& to, const AxisWay& meant) {
  double worst = 0;
  for (int k = 0; k <= 200; ++k) {
    const double s = k / 200.0;
    const Vec3 axis = tool_axis(chain, from + s * (to - from));
    worst = std::max(worst, angle_between(axis, great_circle(meant.from, meant.to, s)));
  }
  return worst;
}

MotionDeviation sampled(const KinematicChain& chain, const Joints& from, const Joints& to) {
  const TipPose a = forward(chain, kSetup, from), b = forward(chain, kSetup, to);
  MotionDeviation worst{0, sampled_axis(chain, from.rotary, to.rotary, {a.axis, b.axis})};
  for (int k = 0; k <= 200; ++k) {
    const double s = k / 200.0;
    const TipPose at = forward(chain, kSetup, between(from, to, s));
    worst.tip = std::max(worst.tip, (at.tip - a.tip - s * (b.tip - a.tip)).norm());
  }
  return worst;
}

// Over 400 random motions on each chain, scaled by `size`.
struct Comparison {
  double least_ratio = kInfinity;  // of bound to sampled deviation, tip and axis alike
  MotionDeviation bounds, seen;    // sums
};

Comparison compare(double size) {
  std::mt19937 random(11);
  Comparison result;
  for (const KinematicChain& chain : chains())
    for (int n = 0; n < 400; ++n) {
      const Joints from = random_joints(random), to = between(from, random_joints(random), size);
      const MotionDeviation bound = bound_of(chain, kSetup, from, to), seen = sampled(chain, from, to);
      result.least_ratio = std::min({result.least_ratio, bound.tip / seen.tip, bound.axis / seen.axis});
      result.bounds.tip += bound.tip, result.bounds.axis += bound.axis;
      result.seen.tip += seen.tip, result.seen.axis += seen.axis;
    }
  return result;
}

TEST(JointMotion, TheBoundIsNeverExceeded) {
  for (double size : {1.0, 0.3, 0.1, 0.01}) EXPECT_GE(compare(size).least_ratio, 1.0 - 1e-4) << size;
}

TEST(JointMotion, TheBoundIsCloseForShortMotions) {
  const Comparison at = compare(0.01);
  EXPECT_LE(at.bounds.tip, 1.05 * at.seen.tip);
  EXPECT_LE(at.bounds.axis, 1.05 * at.seen.axis);
}

TEST(JointMotion, ATableThatTurnsAloneLeavesTheChordByItsSagitta) {
  const KinematicChain chain = chain_of(table('C', Vec3::UnitZ()), head('B', Vec3::UnitY()));
  const double radius = 80, turn = radians(2);
  const Joints from{{radius, 0, 0}, {0, 0}}, to{{radius, 0, 0}, {turn, 0}};
  const double sagitta = radius * (1 - std::cos(turn / 2));
  const MotionDeviation bound = bound_of(chain, {}, from, to);
  EXPECT_GE(bound.tip, sagitta);
  EXPECT_LE(bound.tip, 1.01 * sagitta);
}

TEST(JointMotion, StraightMotionsDoNotDeviate) {
  const MotionDeviation bound =
      bound_of(inclined_head(), kSetup, {{0, 0, 0}, {0.3, 0.4}}, {{50, -20, 10}, {0.3, 0.4}});
  EXPECT_LE(bound.tip, 1e-12);
  EXPECT_LE(bound.axis, 1e-12);
}

TEST(JointMotion, TheAxisOfAnOrthogonalMachineIsOffByTheKnownAngle) {
  // (dC^2 / 8) sin(tilt) cos(tilt): 30 degrees, 10 degree turn -> 0.095 degrees
  const KinematicChain chain = chain_of(table('C', Vec3::UnitZ()), head('B', Vec3::UnitY()));
  const Vec2 from(0, radians(30)), to(radians(10), radians(30));
  EXPECT_NEAR(degrees(axis_deviation_bound(chain, from, to, own_way(chain, from, to))), 0.095, 0.005);
}

TEST(JointMotion, EndsThatTheJointsDoNotMeetCountToo) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> off(-0.01, 0.01);
  for (const KinematicChain& chain : chains())
    for (int n = 0; n < 400; ++n) {
      const Vec2 from = random_joints(random).rotary, to = from + 0.05 * random_joints(random).rotary;
      AxisWay meant = own_way(chain, from, to);
      meant.from = (meant.from + Vec3(off(random), off(random), off(random))).normalized();
      meant.to = (meant.to + Vec3(off(random), off(random), off(random))).normalized();
      const double seen = sampled_axis(chain, from, to, meant);
      EXPECT_GE(axis_deviation_bound(chain, from, to, meant), seen * (1 - 1e-9));
      EXPECT_LE(axis_end_error(chain, from, to, meant), seen * (1 + 1e-9));
    }
}

}  // namespace
}  // namespace mpm
