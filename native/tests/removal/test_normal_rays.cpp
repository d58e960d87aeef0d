#include <gtest/gtest.h>

#include <random>

#include "mpm/removal/normal_rays.h"
#include "mpm/removal/ray_order.h"

namespace mpm {
namespace {

const Tool kBall{0, 5, 0, 30, {}};
const Tool kFlat{5, 0, 0, 30, {}};
const Tool kTorus{6.7, 6.0, 6.0, 30.0, {}};

SweptPath polyline(const std::vector<TipPose>& poses) {
  SweptPath path{poses, std::vector<std::uint8_t>(poses.size(), 1)};
  path.removes[0] = 0;
  return path;
}

SweptPath straight(const Vec3& from, const Vec3& to, const Vec3& axis = Vec3::UnitZ()) {
  return polyline({{from, axis}, {to, axis}});
}

// Heights above z = 0 on rays along z from these points, of stock up to `top`.
NormalRays upright(const std::vector<Vec2>& at, double top) {
  NormalRays rays;
  for (const Vec2& p : at) rays.rays.push_back({{p.x(), p.y(), 0}, Vec3::UnitZ()});
  rays.height.assign(at.size(), top);
  rays.move.assign(at.size(), -1);
  rays.below = 5;
  return rays;
}

NormalRays cut(NormalRays rays, const Tool& tool, const SweptPath& path, int threads = 1) {
  Context context(threads);
  cut_rays(rays, ToolSweep(tool, path), context);
  return rays;
}

TEST(NormalRays, BallLeavesItsScallop) {
  const double side_step = 4.0, scallop = 5 - std::sqrt(25 - side_step * side_step / 4);
  std::vector<TipPose> poses;
  for (int pass = -2; pass <= 12; ++pass)
    for (const double y : {-10.0, 20.0}) poses.push_back({{side_step * pass, y, 0}, Vec3::UnitZ()});
  SweptPath path = polyline(poses);
  for (std::size_t i = 0; i < poses.size(); i += 2) path.removes[i] = 0;
  std::vector<Vec2> at;
  for (double x = 0; x <= 30; x += 0.25) at.emplace_back(x, 3.3);
  const NormalRays rays = cut(upright(at, 5), kBall, path);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double aside = std::remainder(at[i].x(), side_step);
    EXPECT_NEAR(rays.height[i], 5 - std::sqrt(25 - aside * aside), 1e-6) << at[i].x();
  }
  EXPECT_NEAR(rays.height[8], scallop, 1e-6);  // x = 2, between two passes
}

TEST(NormalRays, TorusLeavesItsSlotProfile) {
  std::vector<Vec2> at;
  for (double x = -14; x <= 14; x += 0.1) at.emplace_back(x, 1.0);
  const NormalRays rays = cut(upright(at, 20), kTorus, straight({0, -30, 0}, {0, 32, 0}));
  for (std::size_t i = 0; i < at.size(); ++i) {
    // The ring's lowest circle sweeps the slot's floor; beside it stands a quarter of the minor circle.
    const double x = std::abs(at[i].x());
    if (std::abs(x - 6.7) < 0.01 || std::abs(x - 12.7) < 0.01) continue;
    const double wall = 6 - std::sqrt(36 - std::clamp((x - 6.7) * (x - 6.7), 0.0, 36.0));
    EXPECT_NEAR(rays.height[i], x < 6.7 ? 0 : x < 12.7 ? wall : 20, 1e-6) << x;
  }
}

// Tilted across the feed by beta the ring sweeps an elliptic torus section: its lowest line is a circle of
// radius Ri round the lowest point of the major circle.
TEST(NormalRays, TiltedTorusLeavesAGroove) {
  const double tilt = 0.3;
  const Vec3 axis(std::sin(tilt), 0, std::cos(tilt));
  const Vec3 lowest =
      6.0 * axis + 6.7 * Vec3(std::cos(tilt), 0, -std::sin(tilt));  // of the major circle, tip at 0
  std::vector<Vec2> at;
  for (double x = 0; x <= 3; x += 0.25) at.emplace_back(lowest.x() + x, 0.0);
  const NormalRays rays = cut(upright(at, 20), kTorus, straight({0, -30, 0}, {0, 30, 0}, axis));
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double x = at[i].x() - lowest.x();
    EXPECT_NEAR(rays.height[i], lowest.z() - std::sqrt(36 - x * x), 1e-6) << x;
  }
}

TEST(NormalRays, FlatEndLeavesAPocketWithUprightWalls) {
  const std::vector<Vec2> at{{20, 20}, {24.99, 20}, {25.01, 20}, {20, 5.01}, {20, 4.99}, {15.1, 30.5}};
  const NormalRays rays = cut(upright(at, 10), kFlat, straight({20, 10, 2}, {20, 30, 2}));
  const double expected[] = {2, 2, 10, 2, 10, 2};
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(rays.height[i], expected[i], 1e-6) << i;
}

TEST(NormalRays, HolderCutsToo) {
  const Tool tool{2, 0, 0, 10, {{8, 8, 10}}};
  const NormalRays rays = cut(upright({{0, 0}, {5, 0}, {10, 0}}, 15), tool, straight({0, 0, 0}, {0, 0, 0}));
  EXPECT_NEAR(rays.height[0], 0.0, 1e-6);
  EXPECT_NEAR(rays.height[1], 10.0, 1e-6);
  EXPECT_DOUBLE_EQ(rays.height[2], 15.0);
}

TEST(NormalRays, GougesAreBelowZeroAndNameTheMove) {
  const SweptPath path = polyline({{{0, 0, 5}, Vec3::UnitZ()},
                                   {{0, 0, -0.02}, Vec3::UnitZ()},
                                   {{0, 0, 5}, Vec3::UnitZ()},
                                   {{9, 0, 1}, Vec3::UnitZ()}});
  const NormalRays rays = cut(upright({{0, 0}, {9, 0}}, 3), kBall, path);
  EXPECT_NEAR(rays.height[0], -0.02, 1e-6);
  EXPECT_EQ(rays.move[0], 1);
  EXPECT_NEAR(rays.height[1], 1, 1e-6);
  EXPECT_EQ(rays.move[1], 3);
}

// What a cutter does on the far side of a thin wall is no gouge of this side.
TEST(NormalRays, ACutBehindTheMaterialDoesNotCount) {
  const Vec3 from_below = -Vec3::UnitZ();
  const NormalRays rays = cut(upright({{0, 0}}, 1), kBall, straight({-20, 0, -2}, {20, 0, -2}, from_below));
  EXPECT_DOUBLE_EQ(rays.height[0], 1.0);
}

TEST(NormalRays, RapidsTakeNothing) {
  SweptPath path = straight({0, 0, 0}, {10, 0, 0});
  path.removes = {1, 0};
  EXPECT_EQ(cut(upright({{5, 0}}, 5), kBall, path).height[0], 5.0);
}

// Square of `side` x `side` rays 0.5 mm apart about the origin.
std::vector<Vec2> square(int side) {
  std::vector<Vec2> at;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) at.emplace_back(0.5 * i - 0.25 * side, 0.5 * j - 0.25 * side);
  return at;
}

// How many tiles of rays each stroke of a path is tried on.
double tiles_a_stroke(const std::vector<Ray>& rays, const ToolSweep& sweep) {
  const std::vector<std::uint32_t> order = near_together(rays);
  std::size_t tried = 0;
  std::vector<std::uint32_t> strokes;
  for (std::size_t first = 0; first < order.size(); first += kTileRays) {
    Box3 box;
    for (std::size_t i = first; i < std::min(first + kTileRays, order.size()); ++i)
      box.extend(rays[order[i]].origin);
    sweep.low_strokes_near(box, strokes);
    tried += strokes.size();
  }
  return double(tried) / double(sweep.strokes().size());
}

// The rays of a tile lie together, so the same path costs the same on a larger part.
TEST(NormalRays, AMoveCostsTheRaysNearItWhateverThePartsSize) {
  std::vector<TipPose> poses;
  for (int i = 0; i < 40; ++i)
    poses.push_back({{i % 2 ? 9.0 : -9.0, 0.5 * i - 10, 0}, Vec3(0.1, 0.2, 1).normalized()});
  const ToolSweep sweep(kTorus, polyline(poses));
  const double small = tiles_a_stroke(upright(square(128), 5).rays, sweep);
  // The cutter's square, 27.4 mm wide with the stroke, over tiles of 4 mm and their border.
  EXPECT_LT(small, 75);
  EXPECT_GT(small, 25);
  EXPECT_NEAR(tiles_a_stroke(upright(square(256), 5).rays, sweep), small, 0.1 * small);
  EXPECT_NEAR(tiles_a_stroke(upright(square(512), 5).rays, sweep), small, 0.1 * small);
}

TEST(NormalRays, SameBytesForAnyThreadCountAndOrder) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 40);
  std::vector<Vec2> at(3000);
  for (Vec2& p : at) p = {place(random), place(random)};
  std::vector<TipPose> poses;
  for (int i = 0; i < 30; ++i)
    poses.push_back(
        {{place(random), place(random), 1 + 0.05 * i}, Vec3(0.02 * i - 0.3, 0.2, 1).normalized()});
  const NormalRays one = cut(upright(at, 12), kTorus, polyline(poses), 1);
  EXPECT_EQ(one.height, cut(upright(at, 12), kTorus, polyline(poses), 2).height);
  std::reverse(poses.begin(), poses.end());
  const NormalRays back = cut(upright(at, 12), kTorus, polyline(poses));
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(back.height[i], one.height[i], 1e-4);
}

TEST(NormalRays, NamesWhatIsWrong) {
  NormalRays rays = upright({{0, 0}}, 1);
  rays.rays[0].direction *= 2;
  EXPECT_THROW(cut(rays, kBall, straight({0, 0, 0}, {1, 0, 0})), std::invalid_argument);
  EXPECT_THROW(cut(upright({{0, 0}}, 1), kBall, straight({0, 0, 0}, {1, 0, 0}, {1, 1, 0})),
               std::invalid_argument);
  EXPECT_THROW(cut(upright({{0, 0}}, 1), kBall, {{}, {1}}), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
