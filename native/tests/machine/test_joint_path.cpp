#include <gtest/gtest.h>

#include "machine/chains.h"
#include "mpm/machine/joint_path.h"

namespace mpm {
namespace {

using namespace mpm::testing;

// All moves cut but the first.
PosePath path_of(const std::vector<Vec3>& axes) {
  PosePath path{
      std::vector<Vec3>(axes.size(), Vec3::Zero()), axes, std::vector<std::uint8_t>(axes.size(), 1)};
  if (!axes.empty()) path.cutting[0] = 0;
  return path;
}

std::vector<Vec3> circles(double tilt, int turns, int per_turn) {
  std::vector<Vec3> axes;
  for (int i = 0; i <= turns * per_turn; ++i) axes.push_back(direction(tilt, 2 * kPi * i / per_turn));
  return axes;
}

void expect_met(const KinematicChain& chain,
                const PosePath& path,
                const JointPath& joints,
                double tolerance) {
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_LE((tool_axis(chain, joints.rotary[i]) - path.axis[i]).norm(), tolerance) << "pose " << i;
}

double largest_step(const JointPath& joints, int axis) {
  double largest = 0;
  for (std::size_t i = 1; i < joints.rotary.size(); ++i)
    largest = std::max(largest, std::abs(joints.rotary[i][axis] - joints.rotary[i - 1][axis]));
  return largest;
}

void expect_all(const JointPath& joints, JointStatus status) {
  for (JointStatus s : joints.status) EXPECT_EQ(s, status);
}

TEST(JointPath, TableIsUnwoundOverManyTurns) {
  const PosePath path = path_of(circles(0.3, 5, 36));
  const JointPath joints = joint_path(inclined_head(), path, {});
  expect_met(inclined_head(), path, joints, 1e-12);
  EXPECT_NEAR(joints.rotary.back()[0] - joints.rotary.front()[0], 10 * kPi, 1e-9);
  EXPECT_NEAR(largest_step(joints, 0), radians(10), 1e-9);
  expect_all(joints, JointStatus::ok);
}

TEST(JointPath, PreferenceChoosesTheSolution) {
  KinematicChain chain = inclined_head();
  for (auto [preference, sign] :
       {std::pair(SolutionPreference::positive, 1.0), std::pair(SolutionPreference::negative, -1.0)}) {
    chain.solution_preference = preference;
    for (const Vec2& rotary : joint_path(chain, path_of(circles(0.3, 1, 12)), {}).rotary)
      EXPECT_GT(sign * rotary[1], 0);
  }
}

TEST(JointPath, LimitsOfTheTiltOverrideThePreference) {
  KinematicChain chain = inclined_head();
  chain.solution_preference = SolutionPreference::positive;
  chain.rotary[1].min_limit = -kPi, chain.rotary[1].max_limit = 0.1;
  const JointPath joints = joint_path(chain, path_of(circles(0.3, 1, 12)), {});
  expect_all(joints, JointStatus::ok);
  EXPECT_LT(joints.rotary[3][1], 0);
}

TEST(JointPath, LaterPosesDecideTheSolutionOfTheWholeCut) {
  // Up to pose 5 both solutions do; after it the tilt leaves the upper limit, so the cut must start on the
  // lower one.
  KinematicChain chain = inclined_head();
  chain.solution_preference = SolutionPreference::positive;
  chain.rotary[1].min_limit = -2.0, chain.rotary[1].max_limit = 0.8;
  std::vector<Vec3> axes;
  for (int i = 0; i < 12; ++i) axes.push_back(direction(0.2 + 0.06 * i, 0.5));
  const JointPath joints = joint_path(chain, path_of(axes), {});
  expect_all(joints, JointStatus::ok);
  for (const Vec2& rotary : joints.rotary) EXPECT_LT(rotary[1], 0);
}

TEST(JointPath, SolutionChangesOnlyWhereTheMoveDoesNotCut) {
  KinematicChain chain = inclined_head();
  chain.solution_preference = SolutionPreference::positive;
  chain.rotary[1].min_limit = -2.0, chain.rotary[1].max_limit = 0.8;
  PosePath path = path_of({direction(0.2, 0), direction(0.3, 0), direction(0.85, 0), direction(0.9, 0)});
  path.cutting[2] = 0;
  JointPath joints = joint_path(chain, path, {});
  EXPECT_EQ(joints.branch, (std::vector<std::uint8_t>{0, 0, 1, 1}));
  expect_all(joints, JointStatus::ok);

  chain.allow_flip = false;
  joints = joint_path(chain, path, {});
  EXPECT_EQ(joints.branch, (std::vector<std::uint8_t>{1, 1, 1, 1}));
}

TEST(JointPath, LimitedTableKeepsTheTurnThatFitsTheWholeCut) {
  KinematicChain chain = inclined_head();
  chain.rotary[0].min_limit = radians(-200), chain.rotary[0].max_limit = radians(400);
  chain.solution_preference = SolutionPreference::positive;
  std::vector<Vec3> axes;
  for (int i = 0; i <= 55; ++i) axes.push_back(direction(0.3, radians(-170 + 10 * i)));
  const JointPath joints = joint_path(chain, path_of(axes), {});
  expect_all(joints, JointStatus::ok);
  EXPECT_LE(largest_step(joints, 0), radians(10.001));
}

TEST(JointPath, RewindHappensAtTheLinkAndIsMarkedInACut) {
  KinematicChain chain = inclined_head();
  chain.rotary[0].min_limit = radians(-270), chain.rotary[0].max_limit = radians(270);
  chain.solution_preference = SolutionPreference::positive;
  chain.allow_flip = false;
  PosePath path = path_of(circles(0.3, 2, 36));
  for (std::size_t i : {20u, 40u, 60u}) path.cutting[i] = 0;
  expect_all(joint_path(chain, path, {}), JointStatus::ok);

  path = path_of(circles(0.3, 2, 36));
  const JointPath forced = joint_path(chain, path, {});
  EXPECT_EQ(std::count(forced.status.begin(), forced.status.end(), JointStatus::forced_turn), 1);
}

TEST(JointPath, PosesBeyondLimitsAreMarkedNotLost) {
  KinematicChain chain = inclined_head();
  chain.rotary[1].min_limit = radians(-20), chain.rotary[1].max_limit = radians(20);
  chain.linear[2].max_limit = 100.0;
  PosePath path = path_of({direction(0.1, 0), direction(0.6, 0), direction(2.0, 0), direction(0.1, 0)});
  path.tip[3] = {0, 0, 200};
  const JointPath joints = joint_path(chain, path, {});
  EXPECT_EQ(
      joints.status,
      (std::vector<JointStatus>{
          JointStatus::ok, JointStatus::rotary_limit, JointStatus::unreachable, JointStatus::linear_limit}));
  EXPECT_TRUE(joints.rotary[2].allFinite());
}

TEST(JointPath, TableStandsStillInsideThePoleCone) {
  const double cone = radians(4e-4);
  std::vector<Vec3> axes;  // straight through the pole and beyond, with noise for an azimuth near it
  for (double tilt : {0.2, 0.1, 0.5 * cone, 0.0, 0.7 * cone, 0.1, 0.2})
    axes.push_back(direction(tilt, axes.size()));
  PosePath path = path_of(axes);
  path.axis[4] = direction(0.7 * cone, -2.0);
  path.cutting[4] = 0;
  const JointPath joints = joint_path(inclined_head(), path, {{}, cone});
  EXPECT_EQ(joints.rotary[2][0], joints.rotary[1][0]);
  EXPECT_EQ(joints.rotary[3][0], joints.rotary[1][0]);
  EXPECT_EQ(joints.rotary[4][0], joints.rotary[5][0]);
  EXPECT_EQ(joints.at_pole, (std::vector<std::uint8_t>{0, 0, 1, 1, 1, 0, 0}));
  expect_met(inclined_head(), path, joints, 2 * cone);
}

TEST(JointPath, CutThroughThePoleTurnsTheTableEvenly) {
  std::vector<Vec3> axes;
  for (int i = -2; i <= 2; ++i) axes.push_back(direction(std::abs(0.1 * i), i < 0 ? 0.3 : 0.3 + kPi));
  axes.insert(axes.begin() + 2, Vec3::UnitZ());
  const JointPath joints = joint_path(inclined_head(), path_of(axes), {{}, radians(4e-4)});
  expect_met(inclined_head(), path_of(axes), joints, 1e-12);
  EXPECT_LT(largest_step(joints, 0), 0.4 * kPi);
  expect_all(joints, JointStatus::ok);
}

TEST(JointPath, PoleEverywhereAndEmptyPath) {
  const JointPath joints = joint_path(inclined_head(), path_of({Vec3::UnitZ(), Vec3::UnitZ()}), {{}, 1e-6});
  EXPECT_EQ(joints.rotary[1], Vec2(0, 0));
  EXPECT_TRUE(joint_path(inclined_head(), {}, {}).rotary.empty());
}

TEST(JointPath, BadPosesAreTheCallersMistake) {
  PosePath path = path_of({Vec3::UnitZ()});
  path.tip[0].x() = kNaN;
  EXPECT_THROW(joint_path(inclined_head(), path, {}), std::invalid_argument);
  EXPECT_THROW(joint_path(inclined_head(), path_of({Vec3(0, 0, 2)}), {}), std::invalid_argument);
  path.axis.clear();
  EXPECT_THROW(joint_path(inclined_head(), path, {}), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
