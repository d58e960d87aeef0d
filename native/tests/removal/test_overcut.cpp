#include <gtest/gtest.h>

#include <random>

#include "mpm/removal/overcut.h"

namespace mpm {
namespace {

SweptPath way(const std::vector<TipPose>& poses) {
  SweptPath path{poses, std::vector<std::uint8_t>(poses.size(), 1)};
  path.removes[0] = 0;
  return path;
}

Overcut find(const std::vector<Vec3>& points, const Tool& tool, const SweptPath& path, int threads = 1) {
  Context context(threads);
  return find_overcut(points, tool, path, context);
}

// A ball of radius 5 along x with its lowest point at z = -0.3 over points of the plane z = 0.
TEST(Overcut, BallInAPlaneIsAsDeepAsItsSegment) {
  std::vector<Vec3> points;
  for (double y = -3; y <= 3; y += 0.25) points.emplace_back(7.3, y, 0);
  const Overcut found =
      find(points, {0, 5, 0, 30, {}}, way({{{-20, 0, -0.3}, Vec3::UnitZ()}, {{20, 0, -0.3}, Vec3::UnitZ()}}));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double depth = std::max(0.0, 5 - hypotenuse(4.7, points[i].y()));
    EXPECT_NEAR(found.depth[i], depth, 1e-9) << points[i].y();
    EXPECT_EQ(found.move[i], depth > 0 ? 1 : -1);
  }
}

// A flat end is as deep all along: nothing to choose from, and no time lost over it.
TEST(Overcut, FlatEndIsAsDeepAsItsBottom) {
  const Overcut found = find({{0, 0, 0}, {0, 4.9, 0}, {0, 5.1, 0}},
                             {5, 0, 0, 30, {}},
                             way({{{-500, 0, -0.2}, Vec3::UnitZ()}, {{500, 0, -0.2}, Vec3::UnitZ()}}));
  EXPECT_NEAR(found.depth[0], 0.2, 1e-12);
  EXPECT_NEAR(found.depth[1], 0.1, 1e-6);  // nearer to the side than to the bottom
  EXPECT_EQ(found.depth[2], 0);
}

// The wall of a step: the tool runs beside it and comes 0.05 mm too near in one of its moves.
TEST(Overcut, NamesTheMoveAndLeavesOutRapids) {
  SweptPath path = way({{{0, 5, 0}, Vec3::UnitZ()},
                        {{10, 5, 0}, Vec3::UnitZ()},
                        {{20, 4.95, 0}, Vec3::UnitZ()},
                        {{30, 5, 0}, Vec3::UnitZ()},
                        {{30, 0, 0}, Vec3::UnitZ()},
                        {{0, 5, 0}, Vec3::UnitZ()}});
  path.removes[4] = path.removes[5] = 0;
  const std::vector<Vec3> wall{{5, -1e-6, 3}, {19, 0, 3}, {20, 0, 3}, {32, 0, 3}};
  const Overcut found = find(wall, {3, 2, 0, 30, {}}, path);
  EXPECT_EQ(found.depth[0], 0);
  EXPECT_EQ(found.move[1], 2);
  EXPECT_NEAR(found.depth[2], 0.05, 1e-6);
  EXPECT_EQ(found.depth[3], 0);
  EXPECT_EQ(found.move[3], -1);
}

// Turning moves of the thesis' cutter with a shank against 2000 looks a move.
TEST(Overcut, AgreesWithDenseSampling) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-15, 15), lean(-0.4, 0.4);
  const Tool tool{6.7, 6.0, 3.0, 20.0, {{20, 25, 40}}};
  int inside = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const TipPose from{{side(random), side(random), 0}, Vec3(lean(random), lean(random), 1).normalized()};
    const TipPose to{{side(random), side(random), 3}, Vec3(lean(random), lean(random), 1).normalized()};
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i) points.emplace_back(side(random), side(random), 2 * side(random) + 25);
    const Overcut found = find(points, tool, way({from, to}));
    for (std::size_t i = 0; i < points.size(); ++i) {
      double least = 0;
      for (int k = 0; k <= 2000; ++k) {
        const TipPose at = pose_between(from, to, k / 2000.0);
        least = std::min(least, signed_distance(tool, ToolPose::from_tip(tool, at.tip, at.axis), points[i]));
      }
      EXPECT_GE(found.depth[i], -least - 1e-5);
      EXPECT_LE(found.depth[i], -least + 1e-2);  // half a look's way
      inside += least < 0;
    }
  }
  EXPECT_GT(inside, 300);
}

TEST(Overcut, IsTheSameForAnyThreads) {
  std::vector<Vec3> points;
  for (int i = 0; i < 5000; ++i) points.emplace_back(0.01 * i, 0.3, 0.1);
  const SweptPath path = way(
      {{{0, 0, 0}, Vec3::UnitZ()}, {{20, 0, 0}, Vec3(0.1, 0, 1).normalized()}, {{50, 1, 0}, Vec3::UnitZ()}});
  const Overcut one = find(points, {6.7, 6.0, 6.0, 40.0, {}}, path, 1),
                two = find(points, {6.7, 6.0, 6.0, 40.0, {}}, path, 2);
  EXPECT_EQ(one.depth, two.depth);
  EXPECT_EQ(one.move, two.move);
}

}  // namespace
}  // namespace mpm
