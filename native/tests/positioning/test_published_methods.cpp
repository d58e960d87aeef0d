// drd, dtm, dstm and pam: what each promises, on surfaces whose answers are known.
#include <gtest/gtest.h>

#include <cstring>

#include "mpm/base/frame.h"
#include "mpm/positioning/place_all.h"
#include "mpm/positioning/registry.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr const char* kMethods[] = {"drd", "dtm", "dstm", "pam"};
constexpr double kContact = 1e-5;  // mm: Newton's tolerance is 1e-6

std::vector<Vec2> some_points() {
  return {{18, 30}, {36, 54}, {54, 90}, {72, 40}, {90, 110}, {108, 62}, {126, 84}, {72, 128}};
}

Placements place(const char* method,
                 const SurfaceModel& model,
                 const std::vector<Vec2>& points,
                 MethodOptions options = {},
                 int threads = 2) {
  Context context(threads);
  return place_all(*make_method(method, model, testing::thesis_tool(), options), points, context);
}

class Published : public ::testing::TestWithParam<const char*> {};

TEST_P(Published, TouchesAtItsContacts) {
  const Tool tool = testing::thesis_tool();
  for (const auto which : {testing::Thesis::convex, testing::Thesis::concave, testing::Thesis::saddle}) {
    const SurfaceModel model = testing::thesis_model(which);
    for (const Placement& one : place(GetParam(), model, some_points()).positions) {
      if (one.status == PositionStatus::undecided) continue;
      ASSERT_TRUE(one.pose.axis.allFinite() && one.pose.torus_center.allFinite());
      EXPECT_NEAR(one.pose.axis.norm(), 1.0, 1e-12);
      EXPECT_NEAR(signed_distance(tool, one.pose, one.first_contact), 0.0, kContact);
      if (one.status != PositionStatus::two_contacts) continue;
      // drd accepts a drop difference of 0.01 mm, so its second contact may lie that deep.
      const double deep = std::strcmp(GetParam(), "drd") == 0 ? 0.011 : kContact;
      EXPECT_NEAR(signed_distance(tool, one.pose, one.second_contact), 0.0, deep);
    }
  }
}

TEST_P(Published, ThreadsAndOrderDoNotChangeABit) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const std::vector<Vec2> points = some_points(), reversed(points.rbegin(), points.rend());
  const Placements a = place(GetParam(), model, points, {}, 1), b = place(GetParam(), model, reversed);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ToolPose &p = a.positions[i].pose, &q = b.positions[points.size() - 1 - i].pose;
    EXPECT_EQ(0, std::memcmp(p.torus_center.data(), q.torus_center.data(), 3 * sizeof(double)));
    EXPECT_EQ(0, std::memcmp(p.axis.data(), q.axis.data(), 3 * sizeof(double)));
  }
  EXPECT_EQ(a.counters.newton_steps, b.counters.newton_steps);
  EXPECT_EQ(a.counters.seeds, b.counters.seeds);
}

// On a plane rising by k along x the ring touches uphill: the centre of its tube is Ro from the axis, the
// contact Ri k / sqrt(1 + k^2) beyond it.
TEST_P(Published, DropsOnAPlaneAsTheClosedFormSays) {
  const double slope = 0.2;
  const Tool tool = testing::thesis_tool();
  const SurfaceModel model = testing::inclined_plane(slope);
  const Placement p = place(GetParam(), model, {Vec2(50, 50)}).positions[0];
  ASSERT_TRUE(p.pose.axis.allFinite());
  const double length = std::sqrt(1 + slope * slope);
  const double x = 50 + tool.major_radius + tool.minor_radius * slope / length;
  const double grid = std::strcmp(GetParam(), "drd") == 0 ? 0.02 : kContact;  // the last grid of rays
  EXPECT_NEAR(p.first_contact.x(), x, grid);
  EXPECT_NEAR(p.first_contact.y(), 50, grid);
}

TEST_P(Published, OffThePartIsAStatus) {
  const SurfaceModel model = testing::inclined_plane(0);
  EXPECT_EQ(place(GetParam(), model, {Vec2(300, 50)}).positions[0].status, PositionStatus::off_part);
}

INSTANTIATE_TEST_SUITE_P(Methods, Published, ::testing::ValuesIn(kMethods));

// A plane does not bend: the ring lies flat on it, tilted by the slope.
TEST(Pam, LeansWithAPlaneUntilTheRingLiesFlat) {
  const SurfaceModel model = testing::inclined_plane(0.2);
  const Placement p = place("pam", model, {Vec2(50, 50)}).positions[0];
  EXPECT_NEAR(p.tilt, std::atan(0.2), 1e-6);
}

// 100 mm square about `middle`, rising by `slope`, bent by `curvature` (1/mm), then turned about z.
SurfaceModel nearly_plane(double slope, double curvature, double turn, const Vec3& middle) {
  const std::vector<double> knots{0, 0, 0, 1, 1, 1}, side{-50, 0, 50}, square{2500, -2500, 2500};
  std::vector<Vec3> poles;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double height = slope * side[i] + curvature / 2 * (square[i] + square[j]);
      poles.push_back(middle + rotation(Vec3::UnitZ(), turn) * Vec3(side[i], side[j], height));
    }
  return testing::one_face(BSplineSurface(2, 2, knots, knots, poles));
}

// However it lies, and a metre off the origin, where more is rounded.
TEST(Pam, MatchesAPlane) {
  for (const double slope : {0.0, 0.2})
    for (const double turn_deg : {0.0, 37.0, 101.0, 210.0, 333.0})
      for (const Vec3& middle : {Vec3(0, 0, 0), Vec3(1e3, -1e3, 1e3)}) {
        const SurfaceModel model = nearly_plane(slope, 0, radians(turn_deg), middle);
        EXPECT_EQ(place("pam", model, {middle.head<2>()}).positions[0].status,
                  PositionStatus::curvature_matched)
            << slope << " turned by " << turn_deg << " at " << middle.x();
      }
}

// A ball of 1 km is no plane yet: it falls away by 1.25 micrometres over 50 mm.
TEST(Pam, NothingMatchesABallHoweverLarge) {
  const SurfaceModel model = nearly_plane(0.2, -1e-6, 0, Vec3::Zero());
  EXPECT_EQ(place("pam", model, {Vec2(30, 20)}).positions[0].status, PositionStatus::one_contact);
}

TEST(Dtm, AnalyticAndExtrapolatedDerivativesAgree) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::convex);
  MethodOptions analytic;
  analytic.numbers["analytic"] = 1;
  const Placements a = place("dtm", model, some_points()), b = place("dtm", model, some_points(), analytic);
  for (std::size_t i = 0; i < some_points().size(); ++i)
    EXPECT_NEAR((a.positions[i].first_contact - b.positions[i].first_contact).norm(), 0, kContact);
  EXPECT_LT(b.counters.evaluations, a.counters.evaluations);
}

TEST(Dstm, SpinKeepsTheFirstContact) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  MethodOptions spun;
  spun.spin = radians(20);
  const Placements a = place("dstm", model, some_points()), b = place("dstm", model, some_points(), spun);
  for (std::size_t i = 0; i < some_points().size(); ++i) {
    if (b.positions[i].status == PositionStatus::undecided) continue;
    EXPECT_EQ(a.positions[i].first_contact, b.positions[i].first_contact);
  }
}

TEST(PublishedMethods, RefuseWhatTheyCannotDo) {
  const SurfaceModel model = testing::inclined_plane(0);
  MethodOptions spun, wrong;
  spun.spin = 0.1;
  for (const char* method : {"drd", "dtm", "pam"})
    EXPECT_THROW(make_method(method, model, testing::thesis_tool(), spun), std::invalid_argument);
  wrong.numbers["seeds"] = 0.5;
  EXPECT_THROW(make_method("dtm", model, testing::thesis_tool(), wrong), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
