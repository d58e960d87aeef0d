#include <gtest/gtest.h>

#include "mpm/base/direction.h"
#include "mpm/gouge/judge_cells.h"
#include "mpm/path/escape.h"
#include "mpm/path/link_passes.h"

namespace mpm {
namespace {

const Tool kShort{6.7, 6.0, 6.0, 30.0, {}};
const Tool kTool{6.7, 6.0, 6.0, 30.0, {{12.7, 12.7, 20.0}, {30.0, 30.0, 40.0}}};

// The bilinear face through four corners.
Face bilinear(const Vec3& p00, const Vec3& p01, const Vec3& p10, const Vec3& p11) {
  return {
      "face", BSplineSurface(1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {p00, p01, p10, p11}), TrimRegion(), false};
}

Face floor_100() { return bilinear({0, 0, 0}, {0, 100, 0}, {100, 0, 0}, {100, 100, 0}); }

// A wall at x = `at` that leans over the floor towards -x above it.
Face leaning_wall(double at, double lean) {
  return bilinear({at, 0, 0}, {at, 100, 0}, {at - lean, 0, 60}, {at - lean, 100, 60});
}

SurfaceModel model_of(std::vector<Face> faces) { return SurfaceModel(std::move(faces)); }

// Upright positions on the floor, `per_pass` points 2 mm apart along y, passes 10 mm apart along x.
PathPositions raster_on_floor(int passes, int per_pass, bool zigzag) {
  PathPositions p;
  for (int i = 0; i < passes; ++i)
    for (int j = 0; j < per_pass; ++j) {
      const int k = zigzag && i % 2 == 1 ? per_pass - 1 - j : j;
      p.tip.push_back({30.0 + 10 * i, 30.0 + 2 * k, 0});
      p.axis.push_back(Vec3::UnitZ());
      p.pass.push_back(i);
      p.usable.push_back(1);
    }
  return p;
}

std::size_t count(const ToolPath& path, MoveKind kind) {
  return std::size_t(std::count(path.kind.begin(), path.kind.end(), kind));
}

ToolPath link(const SurfaceModel& model,
              const PathPositions& positions,
              const LinkOptions& options = {},
              const Tool& tool = kTool) {
  Context context(1);
  return link_passes(judge_cells(model, tool), tool, positions, options, context);
}

PathPositions one_position(const Vec3& tip, const Vec3& axis) { return {{tip}, {axis}, {0}, {1}, {}}; }

// Every usable position ends exactly one cut or plunge, in order, where it stands.
void expect_complete(const ToolPath& path, const PathPositions& positions) {
  std::vector<std::int64_t> visited, usable;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool ends_in_position = path.kind[i] == MoveKind::cut || path.kind[i] == MoveKind::plunge;
    EXPECT_EQ(path.position[i] >= 0, ends_in_position);
    if (!ends_in_position) continue;
    visited.push_back(path.position[i]);
    EXPECT_EQ(path.tip[i], positions.tip[std::size_t(path.position[i])]);
    EXPECT_EQ(path.axis[i], positions.axis[std::size_t(path.position[i])]);
  }
  for (std::size_t i = 0; i < positions.usable.size(); ++i)
    if (positions.usable[i]) usable.push_back(std::int64_t(i));
  EXPECT_EQ(visited, usable);
}

// Independent of the path's own check: the whole of every move that is no cut, against the model's box and a
// dense grid.
double least_clearance_of_links(const SurfaceModel& model, const ToolPath& path, const Tool& tool = kTool) {
  double least = kInfinity;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] == MoveKind::cut) continue;
    for (int k = 0; k <= 20; ++k) {
      const TipPose at =
          pose_between({path.tip[i - 1], path.axis[i - 1]}, {path.tip[i], path.axis[i]}, k / 20.0);
      const ToolPose pose = ToolPose::from_tip(tool, at.tip, at.axis);
      for (const Face& face : model.faces())
        for (int u = 0; u <= 60; ++u)
          for (int v = 0; v <= 60; ++v)
            least = std::min(least, signed_distance(tool, pose, face.surface.point(u / 60.0, v / 60.0)));
    }
  }
  return least;
}

TEST(LinkPasses, JoinsPassesOverTheSafePlane) {
  const SurfaceModel model = model_of({floor_100()});
  for (bool zigzag : {false, true}) {
    const PathPositions positions = raster_on_floor(3, 5, zigzag);
    const ToolPath path = link(model, positions);
    expect_complete(path, positions);
    EXPECT_EQ(count(path, MoveKind::cut), 12u);
    EXPECT_EQ(count(path, MoveKind::plunge), 3u);
    EXPECT_EQ(count(path, MoveKind::retract), 3u);
    EXPECT_EQ(count(path, MoveKind::link), 0u);
    for (std::size_t i = 0; i < path.size(); ++i)  // nobody proved the cuts
      EXPECT_EQ(path.proven[i], path.kind[i] != MoveKind::cut);
    EXPECT_GT(least_clearance_of_links(model, path), -1e-9);
  }
}

TEST(LinkPasses, StartsAndEndsOnTheSafePlane) {
  const ToolPath path = link(model_of({floor_100()}), raster_on_floor(2, 3, false), {.safe_clearance = 7.0});
  EXPECT_EQ(path.kind.front(), MoveKind::rapid);
  EXPECT_DOUBLE_EQ(path.tip.front().z(), 7.0);  // upright: nothing of the tool is below its tip
  EXPECT_EQ(path.kind.back(), MoveKind::retract);
  EXPECT_DOUBLE_EQ(path.tip.back().z(), 7.0);
}

TEST(LinkPasses, RapidsEndAtApproachDistance) {
  const ToolPath path =
      link(model_of({floor_100()}), raster_on_floor(1, 3, false), {.approach_distance = 3.0});
  const auto plunge =
      std::size_t(std::find(path.kind.begin(), path.kind.end(), MoveKind::plunge) - path.kind.begin());
  EXPECT_EQ(path.kind[plunge - 1], MoveKind::rapid);
  EXPECT_NEAR(path.tip[plunge - 1].z(), 3.0, 1e-9);
}

TEST(LinkPasses, LeavesOutUnusablePositions) {
  PathPositions positions = raster_on_floor(1, 6, false);
  positions.usable[2] = 0;
  positions.tip[2] = Vec3::Constant(kNaN);
  const ToolPath path = link(model_of({floor_100()}), positions);
  expect_complete(path, positions);
  EXPECT_EQ(count(path, MoveKind::plunge), 2u);
  EXPECT_EQ(count(path, MoveKind::cut), 3u);
}

// Proven clearances stand in for sampling: none, no cut; and they are what the cut reports.
TEST(LinkPasses, CutsOnlyWhatIsProvenWhereThereIsAProof) {
  PathPositions positions = raster_on_floor(1, 4, false);
  positions.cut_clearance = {kNaN, -0.004, kNaN, -0.002};
  const ToolPath path = link(model_of({floor_100()}), positions);
  expect_complete(path, positions);
  EXPECT_EQ(count(path, MoveKind::plunge), 2u);
  std::vector<double> cuts;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (path.kind[i] == MoveKind::cut) cuts.push_back(path.clearance[i]);
  EXPECT_EQ(cuts, (std::vector<double>{-0.004, -0.002}));
  positions.cut_clearance.pop_back();
  EXPECT_THROW(link(model_of({floor_100()}), positions), std::invalid_argument);
}

TEST(LinkPasses, NoUsablePositionGivesAnEmptyPath) {
  PathPositions positions = raster_on_floor(1, 2, false);
  positions.usable = {0, 0};
  EXPECT_EQ(link(model_of({floor_100()}), positions).size(), 0u);
}

TEST(LinkPasses, BreaksACutThatIsTooLong) {
  PathPositions positions = raster_on_floor(1, 4, false);
  positions.tip[2].y() += 20, positions.tip[3].y() += 20;
  const ToolPath path = link(model_of({floor_100()}), positions, {.cut_length_max = 10.0});
  EXPECT_EQ(count(path, MoveKind::plunge), 2u);
}

TEST(LinkPasses, BreaksACutThatTurnsTooFar) {
  PathPositions positions = raster_on_floor(1, 4, false);
  for (int i : {2, 3}) {
    positions.axis[i] = Vec3(std::sin(0.4), 0, std::cos(0.4));
    positions.tip[i].z() = 10;  // high enough to be clear when tilted
  }
  const ToolPath path = link(model_of({floor_100()}), positions, {.cut_turn_max = radians(20)});
  EXPECT_EQ(count(path, MoveKind::plunge), 2u);
  // The axis turns on the safe plane only, in steps of at most 5 degrees, and the tilted tool keeps its
  // distance there.
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double turn = angle_between(path.axis[i - 1], path.axis[i]);
    EXPECT_LE(turn, radians(5) + 1e-12);
    if (turn < 1e-12) continue;
    EXPECT_EQ(path.kind[i], MoveKind::rapid);
    EXPECT_DOUBLE_EQ(path.tip[i].z(), path.tip.front().z());
    EXPECT_GE(tool_bounds(kTool, ToolPose::from_tip(kTool, path.tip[i], path.axis[i]), 0).lo.z(), 5.0 - 1e-9);
  }
}

TEST(LinkPasses, BreaksACutThroughARidge) {
  // A thin upright ridge that the tool clears at both positions stands between them.
  const Face ridge = bilinear({50, 0, -9}, {50, 100, -9}, {50, 0, 9}, {50, 100, 9});
  const PathPositions positions{
      {{36, 50, 0}, {64, 50, 0}}, {Vec3::UnitZ(), Vec3::UnitZ()}, {0, 0}, {1, 1}, {}};
  EXPECT_EQ(count(link(model_of({ridge}), positions, {.cut_length_max = 50.0}), MoveKind::plunge), 2u);
}

TEST(LinkPasses, RetractsAlongZWhereTheAxisLeadsIntoAWall) {
  // The top of the tool leans towards a wall higher than itself.
  const SurfaceModel model =
      model_of({floor_100(), bilinear({85, 0, 0}, {85, 100, 0}, {85, 0, 60}, {85, 100, 60})});
  const PathPositions positions = one_position({50, 50, 10}, {std::sin(0.6), 0, std::cos(0.6)});
  const ToolPath path = link(model, positions, {}, kShort);
  EXPECT_EQ(std::count(path.blocked.begin(), path.blocked.end(), 1), 0);
  EXPECT_LT((path.tip.back() - positions.tip[0]).normalized().head<2>().norm(), 1e-12);
  EXPECT_GT(least_clearance_of_links(model, path, kShort), 0.0);
}

TEST(LinkPasses, RetractsAlongTheAxisWhereThatIsFree) {
  const PathPositions positions = one_position({50, 50, 10}, {std::sin(0.6), 0, std::cos(0.6)});
  const ToolPath path = link(model_of({floor_100()}), positions);
  EXPECT_LT(angle_between((path.tip.back() - positions.tip[0]).normalized(), positions.axis[0]), 1e-12);
}

TEST(LinkPasses, MarksAPositionThatHasNoWayOut) {
  // Walls lean over the tool from both sides: nothing leads up.
  const SurfaceModel model = model_of({floor_100(), leaning_wall(70, 25), leaning_wall(30, -25)});
  const ToolPath path = link(model, one_position({50, 50, 0}, Vec3::UnitZ()));
  EXPECT_EQ(path.kind.back(), MoveKind::retract);
  EXPECT_EQ(path.blocked.back(), 1);
  EXPECT_LT(path.clearance.back(), -1.0);
}

// A level plate of 0.3 mm, all that is left of a large one: no sample meets it.
Face speck(const Vec3& at) {
  Face face = bilinear({0, 0, at.z()}, {0, 100, at.z()}, {100, 0, at.z()}, {100, 100, at.z()});
  const double u = at.x() / 100, v = at.y() / 100, d = 0.0015;
  face.trim = TrimRegion({{{u - d, v - d}, {u + d, v - d}, {u + d, v + d}, {u - d, v + d}}});
  return face;
}

TEST(LinkPasses, AWayThatCannotBeProvenIsNotTakenWhereAnotherCan) {
  const Vec3 axis(std::sin(0.6), 0, std::cos(0.6)), tip(40, 50, 10);
  // Above the position, 9 mm from the way along the axis; more upright ones pass it by.
  const Vec3 above = tip + 45 * axis + 9 * Vec3(axis.z(), 0, -axis.x());
  const SurfaceModel model = model_of({floor_100(), speck(above)});
  const ToolPath path = link(model, one_position(tip, axis), {}, kShort);
  EXPECT_GT(angle_between((path.tip.back() - tip).normalized(), axis), 0.1);
  EXPECT_EQ(path.proven.back(), 1);
  EXPECT_EQ(std::count(path.proven.begin(), path.proven.end(), 0), 0);
}

TEST(LinkPasses, WhatSamplingCallsFreeIsNotProvenWhenItIsNot) {
  const SurfaceModel model = model_of({floor_100(), speck({50.37, 50.37, 60})});
  const ToolPath path = link(model, one_position({50, 50, 0}, Vec3::UnitZ()), {}, kShort);
  EXPECT_EQ(std::count(path.blocked.begin(), path.blocked.end(), 1), 0);
  EXPECT_EQ(path.kind.back(), MoveKind::retract);
  EXPECT_EQ(path.proven.back(), 0);
}

// The proof leaves room for what the control is off by, here beside a wall of 20 mm.
TEST(LinkPasses, DeviationsCountInTheProof) {
  struct Case {
    double gap, lean, shift;
    int proven;
  };
  for (const auto& [gap, lean, shift, proven] : {Case{0.5, 0.01, 0, 1},
                                                 Case{0.5, 0.03, 0, 0},  // 20 mm up it is off by 0.6 mm
                                                 Case{-0.02, 0, 0.02, 1},
                                                 Case{-0.02, 0, 0.04, 0}}) {
    const double x = 50 + kShort.radius() + gap;
    const SurfaceModel model = model_of({bilinear({x, 0, 0}, {x, 100, 0}, {x, 0, 20}, {x, 100, 20})});
    const LinkOptions options{.gouge = 1, .depth = 0.05, .tip_deviation = shift, .axis_deviation = lean};
    const ToolPath path = link(model, one_position({50, 50, 0}, Vec3::UnitZ()), options, kShort);
    EXPECT_EQ(path.proven.back(), proven) << gap << ' ' << lean << ' ' << shift;
    if (!proven) continue;
    EXPECT_LE(path.clearance.back(), std::min(gap, 0.0) - shift + 1e-9);
    EXPECT_GE(path.clearance.back(), -options.depth);
  }
}

TEST(LinkPasses, SameBytesForAnyThreadCount) {
  const SurfaceModel model = model_of({floor_100()});
  const PathPositions positions = raster_on_floor(4, 9, true);
  Context one(1), two(2);
  const CellTree cells = judge_cells(model, kTool);
  const ToolPath a = link_passes(cells, kTool, positions, {}, one),
                 b = link_passes(cells, kTool, positions, {}, two);
  EXPECT_EQ(a.tip, b.tip);
  EXPECT_EQ(a.clearance, b.clearance);
}

TEST(LinkPasses, NamesWhatIsWrong) {
  const SurfaceModel model = model_of({floor_100()});
  PathPositions positions = raster_on_floor(1, 3, false);
  EXPECT_THROW(link(model, positions, {.check_step = 0}), std::invalid_argument);
  positions.axis[1] = -Vec3::UnitZ();
  EXPECT_THROW(link(model, positions), std::invalid_argument);
  positions.axis.pop_back();
  EXPECT_THROW(link(model, positions), std::invalid_argument);
}

TEST(LinkPasses, CancelledCallReturnsNothing) {
  Context context(1);
  context.cancel();
  const SurfaceModel model = model_of({floor_100()});
  const ToolPath path =
      link_passes(judge_cells(model, kTool), kTool, raster_on_floor(2, 3, false), {}, context);
  EXPECT_EQ(path.size(), 0u);
}

}  // namespace
}  // namespace mpm
