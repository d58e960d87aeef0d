#include <gtest/gtest.h>

#include <functional>

#include "machine/chains.h"
#include "mpm/base/frame.h"
#include "mpm/machine/forward.h"

namespace mpm {
namespace {

using namespace mpm::testing;

// Offsets of the four usual arrangements, each with its own formula, as textbooks give them.
const Vec3 kTableAxis(11, -7, 30);    // a point of the table's (or trunnion's) outer axis
const Vec3 kBetween(3, 2, -40);       // from one rotary axis to the next, at zero
const Vec3 kPivot(1, -2, -150);       // from the head's tilt axis to the spindle gauge point
const Vec3 kPartOrigin(60, -20, 35);  // of the part, machine frame
constexpr double kLength = 123.0;
const Vec3 kTool(0, 0, kLength);

Mat3 turn_z(double angle) { return rotation(Vec3::UnitZ(), angle); }

struct Arrangement {
  const char* name;
  KinematicChain chain;
  std::function<Vec3(const Vec3&, double, double)> tip;  // of linear readings, first and second angle
};

std::vector<Arrangement> arrangements() {
  std::vector<Arrangement> all;
  for (const Vec3& n : {kInclined, Vec3(Vec3::UnitY())}) {
    const auto head_turn = [n](double b) -> Vec3 { return rotation(n, b) * (kPivot - kTool); };
    all.push_back({"head B, table C",
                   chain_of(table('C', Vec3::UnitZ(), kTableAxis), head('B', n, -kPivot)),
                   [=](const Vec3& p, double c, double b) -> Vec3 {
                     const Vec3 o = kPartOrigin - kTableAxis;
                     return turn_z(c) * (p - kPivot + head_turn(b) - kTableAxis) - o;
                   }});
    all.push_back({"table B under table C",
                   chain_of(table('C', Vec3::UnitZ(), kTableAxis + kBetween), table('B', n, kTableAxis)),
                   [=](const Vec3& p, double c, double b) -> Vec3 {
                     const Vec3 o = kPartOrigin - kTableAxis - kBetween;
                     return turn_z(c) * (rotation(n, b) * (p - kTool - kTableAxis) - kBetween) - o;
                   }});
    all.push_back({"heads C and B",
                   chain_of(head('C', Vec3::UnitZ(), -kPivot - kBetween), head('B', n, -kPivot)),
                   [=](const Vec3& p, double c, double b) -> Vec3 {
                     return p - kBetween - kPivot + turn_z(c) * (kBetween + head_turn(b)) - kPartOrigin;
                   }});
  }
  all.push_back(
      {"trunnion A under table C",
       chain_of(table('C', Vec3::UnitZ(), kTableAxis + kBetween), table('A', Vec3::UnitX(), kTableAxis)),
       [](const Vec3& p, double c, double a) -> Vec3 {
         const Vec3 o = kPartOrigin - kTableAxis - kBetween;
         return turn_z(c) * (rotation(Vec3::UnitX(), a) * (p - kTool - kTableAxis) - kBetween) - o;
       }});
  return all;
}

TEST(Forward, EachArrangementFollowsItsOwnFormula) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-kPi, kPi), place(-300, 300);
  for (const Arrangement& one : arrangements())
    for (int i = 0; i < 100; ++i) {
      const Vec3 linear(place(random), place(random), place(random));
      const Vec2 rotary(angle(random), angle(random));
      const TipPose at = forward(one.chain, {kPartOrigin, kLength}, {linear, rotary});
      EXPECT_LE((at.tip - one.tip(linear, rotary[0], rotary[1])).norm(), 1e-10) << one.name;
    }
}

TEST(Forward, LinearReadingsInvertIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-kPi, kPi), place(-300, 300);
  for (const Arrangement& one : arrangements())
    for (int i = 0; i < 100; ++i) {
      const Vec3 linear(place(random), place(random), place(random));
      const Vec2 rotary(angle(random), angle(random));
      const PartSetup setup{kPartOrigin, kLength};
      const TipPose at = forward(one.chain, setup, {linear, rotary});
      EXPECT_LE((linear_readings(one.chain, setup, at.tip, rotary) - linear).norm(), 1e-10) << one.name;
    }
}

TEST(Forward, HeadTurnedToTheTableAxisSampleOfARealControl) {
  // A public TNC sample at B-90 C-75 plunges along (0.259, -0.966, 0): minus the tool axis, sense +1 for
  // both.
  const KinematicChain chain = chain_of(table('C', Vec3::UnitZ()), head('B', Vec3::UnitY()));
  const Vec3 axis = tool_axis(chain, {radians(-75), radians(-90)});
  EXPECT_LE((axis - Vec3(-0.258819, 0.965926, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace mpm
