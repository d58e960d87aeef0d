#include <gtest/gtest.h>

#include "mpm/gouge/judge_cells.h"
#include "mpm/positioning/first_touch.h"
#include "planes.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kSlope = 0.3;
constexpr double kGouge = 1e-3;  // mm
constexpr std::uint32_t kBudget = 200'000;

class OnAPlane : public ::testing::Test {
 protected:
  SurfaceModel model = testing::inclined_plane(kSlope);
  Tool tool = testing::thesis_tool();
  CellTree cells = judge_cells(model, tool);
  FirstTouch first_touch{cells, tool, kGouge, kBudget};
  Vec2 at{40, 50};
  Drop approach{tool, at};
  double rest = -testing::rest_height(tool, kSlope, 40);  // the drop's parameter
  Counters counters;

  Stop stop(double from, double least) { return first_touch(approach, {from, least, from, {}}, counters); }
};

TEST_F(OnAPlane, ADropStopsWhereTheToolRests) {
  std::vector<Start> starts;
  first_touch.starts_under(at, starts);
  const Touch start = first_touch.best_start(approach, starts, kInfinity, counters);
  EXPECT_NEAR(start.at.value, rest, 1e-9);
  const Stop found = stop(rest + 3, first_touch.highest_drop());  // 3 mm too deep
  EXPECT_NEAR(found.x, rest, 1e-8);
  EXPECT_TRUE(found.judged.is_free());
  EXPECT_NEAR(signed_distance(tool, found.judged.pose(), found.last.at.s), 0, 1e-8);
}

// The certificate is of the pose that comes with it, wherever the search ends.
TEST_F(OnAPlane, PoseAndCertificateBelongTogether) {
  for (const double least : {first_touch.highest_drop(), rest - 1, rest + 0.5, rest + 3}) {
    const Stop found = stop(rest + 3, least);
    EXPECT_GE(found.x, least);
    EXPECT_EQ(found.judged.pose().torus_center, approach.pose(found.x).torus_center);
    const double clearance =
        testing::ring_over_plane(tool, found.judged.pose(), Vec3::Zero(), Vec3(-kSlope, 0, 1).normalized());
    EXPECT_LE(found.judged.certificate().lo, clearance + 1e-9);
    EXPECT_GE(found.judged.certificate().hi, clearance - 1e-9);
    EXPECT_EQ(found.judged.is_free(), clearance > -kGouge) << least - rest;
  }
}

TEST_F(OnAPlane, ABudgetThatRunsOutIsNotFree) {
  const FirstTouch hasty(cells, tool, kGouge, 1);
  EXPECT_FALSE(hasty(approach, {rest, rest - 1, rest, {}}, counters).judged.is_free());
}

TEST_F(OnAPlane, StartsLieWhereTheToolReaches) {
  std::vector<Start> under, round;
  first_touch.starts_under(at, under);
  first_touch.starts_round(Vec3(40, 50, 12), tool.radius(), round);
  ASSERT_FALSE(under.empty() || round.empty());
  const double farthest = tool.radius() * 1.5;  // a cell's radius more
  for (const Start& s : under) EXPECT_LT((s.s.head<2>() - at).norm(), farthest);
  for (const Start& s : round) EXPECT_LT((s.s - Vec3(40, 50, 12)).norm(), farthest);
}

TEST_F(OnAPlane, WhatIsOneContactScalesWithTheTool) {
  Tool small = tool;
  small.major_radius /= 100, small.minor_radius /= 100, small.recess /= 100;
  EXPECT_NEAR(first_touch.merged(), 0.02, 1e-12);  // the thesis' cutter
  EXPECT_NEAR(FirstTouch(cells, small, kGouge, kBudget).merged(), 0.0002, 1e-12);
}

// A trough that the lying tool does not fit: its flutes are in the other wall, and yet a free tilt is found.
TEST(FirstTouch, FindsTheFreeTiltWhereTheBeginningIsBlocked) {
  const std::vector<double> knots_u{0, 0, 0, 1, 1, 1}, knots_v{0, 0, 1, 1};
  const SurfaceModel model = testing::one_face(BSplineSurface(2,
                                                              1,
                                                              knots_u,
                                                              knots_v,
                                                              {Vec3(-30, -30, 20),
                                                               Vec3(-30, 30, 20),
                                                               Vec3(0, -30, -20),
                                                               Vec3(0, 30, -20),
                                                               Vec3(30, -30, 20),
                                                               Vec3(30, 30, 20)}));
  const Tool tool{4, 1, 1, 40, {}};
  const CellTree cells = judge_cells(model, tool);
  const FirstTouch first_touch(cells, tool, kGouge, kBudget);
  const SurfacePoint p = model.faces()[0].surface.evaluate(0.7, 0.5);
  const Vec3 normal = p.su.cross(p.sv).normalized(), u1 = Vec3::UnitY();
  const Insert insert{p.s + tool.minor_radius * normal, u1, normal, u1.cross(normal)};
  const Tilt approach(tool, insert);
  Touch kept{0, {}, false};
  kept.at.u = 0.7, kept.at.v = 0.5, kept.at.s = p.s, kept.at.value = 0;
  Counters counters;
  const double most = kPi / 2;
  const Stop found = first_touch(approach, {most, 0, most, {}, &kept}, counters);
  CertifyPoseOptions options;
  double highest = -1;  // by trying all tilts
  for (int k = 0; k <= 900; ++k)
    if (certify_pose(cells, tool, approach.pose(most * k / 900), options).verdict == Verdict::free)
      highest = most * k / 900;
  EXPECT_NE(certify_pose(cells, tool, approach.pose(0), options).verdict, Verdict::free);
  ASSERT_GT(highest, 0);
  EXPECT_TRUE(found.judged.is_free());
  EXPECT_NEAR(found.x, highest, most / 900);
}

}  // namespace
}  // namespace mpm
