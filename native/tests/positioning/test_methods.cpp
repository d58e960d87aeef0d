#include <gtest/gtest.h>

#include <cstring>

#include "mpm/footprint/raster.h"
#include "mpm/gouge/clearance_sampler.h"
#include "mpm/gouge/sample_poses.h"
#include "mpm/positioning/place_all.h"
#include "mpm/positioning/registry.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kContact = 1e-9;  // mm

std::vector<Vec2> every(const std::vector<Vec2>& points, std::size_t step) {
  std::vector<Vec2> some;
  for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
  return some;
}

std::vector<Vec2> thesis_footprint() { return raster({0, 0}, {150, 150}, {kPi / 2, 18, 2, 0, false}).points; }

Placements place(const char* method,
                 const SurfaceModel& model,
                 const std::vector<Vec2>& points,
                 double spin = 0,
                 const Tool& tool = testing::thesis_tool()) {
  Context context(2);
  MethodOptions options;
  options.spin = spin;
  return place_all(*make_method(method, model, tool, options), points, context);
}

void judge_by_sampling(const SurfaceModel& model, const Tool& tool, Placements& placements) {
  std::vector<ToolPose> poses;
  for (const Placement& one : placements.positions) poses.push_back(one.pose);
  Context context(2);
  const std::vector<double> found = sample_poses(model, tool, poses, context);
  for (std::size_t i = 0; i < found.size(); ++i) placements.positions[i].clearance_hi = found[i];
}

std::size_t count(const Placements& p, PositionStatus status) {
  return std::size_t(
      std::count_if(p.positions.begin(), p.positions.end(), [&](auto& one) { return one.status == status; }));
}

class OnThesisSurface : public ::testing::TestWithParam<testing::Thesis> {
 protected:
  SurfaceModel model = testing::thesis_model(GetParam());
  Tool tool = testing::thesis_tool();
};

// Independent re-implementations of VCRF cut in by 3 to 8 um at their positions and find two contacts nearly
// everywhere.
TEST_P(OnThesisSurface, VcrfIsAsGoodAsItsSource) {
  Placements p = place("vcrf", model, every(thesis_footprint(), 5));
  judge_by_sampling(model, tool, p);
  EXPECT_GE(count(p, PositionStatus::two_contacts), p.positions.size() * 98 / 100);
  for (const Placement& one : p.positions) EXPECT_GT(one.clearance_hi, -0.008);
}

TEST_P(OnThesisSurface, ExactIsProvenAndTouchesTwice) {
  const Placements p = place("exact", model, every(thesis_footprint(), 5));
  const ClearanceSampler sampler(model, tool);
  EXPECT_EQ(count(p, PositionStatus::undecided), 0u);
  EXPECT_EQ(count(p, PositionStatus::off_part), 0u);
  EXPECT_GE(count(p, PositionStatus::two_contacts), p.positions.size() * 90 / 100);
  for (const Placement& one : p.positions) {
    EXPECT_GE(one.clearance_lo, -1e-3);
    EXPECT_GE(sampler(one.pose, 1.0).distance, one.clearance_lo);
    EXPECT_NEAR(signed_distance(tool, one.pose, one.first_contact), 0.0, kContact);
    if (one.status != PositionStatus::two_contacts) continue;
    EXPECT_NEAR(signed_distance(tool, one.pose, one.second_contact), 0.0, kContact);
    EXPECT_GT((one.second_contact - one.first_contact).norm(), 0.02);
  }
}

// Neither may tilt further than the other allows: the sampled method overshoots by its grid only.
TEST_P(OnThesisSurface, ExactNeverTiltsLessThanVcrfWhereVcrfIsFree) {
  const std::vector<Vec2> points = every(thesis_footprint(), 9);
  const Placements exact = place("exact", model, points);
  Placements vcrf = place("vcrf", model, points);
  judge_by_sampling(model, tool, vcrf);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool same_contact =
        (exact.positions[i].first_contact - vcrf.positions[i].first_contact).norm() < 0.01;
    if (same_contact && vcrf.positions[i].clearance_hi > -1e-5) {
      EXPECT_GT(exact.positions[i].tilt, vcrf.positions[i].tilt - radians(0.03)) << points[i].transpose();
    }
  }
}

// Dropped to a contact and tilted, or come down from the open side at that contact: two ways to one pose.
TEST_P(OnThesisSurface, AGivenContactHasThePoseOfTheDropThatFindsIt) {
  const std::vector<Vec2> points = every(thesis_footprint(), 7);
  const Placements dropped = place("exact", model, points);
  const auto method = make_method("exact", model, tool, {});
  int compared = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Placement& one = dropped.positions[i];
    const Vec3& p = one.first_contact;
    if (p.head<2>().minCoeff() < 1 || p.head<2>().maxCoeff() > 149) continue;  // an edge may hold it
    // The poles are even in x and y, so the parameters are the coordinates; u1 = v1 x z at the drop.
    const Vec2 inward = points[i] - p.head<2>();
    Counters counters;
    const Placement again =
        method->place(GivenContact{0, p.x() / 150, p.y() / 150, Vec3(inward.y(), -inward.x(), 0)}, counters);
    EXPECT_EQ(again.status, one.status);
    EXPECT_LT((again.pose.torus_center - one.pose.torus_center).norm(), 1e-8);
    EXPECT_LT((again.pose.axis - one.pose.axis).norm(), radians(1e-7));
    EXPECT_GE(again.clearance_lo, -1e-3);
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST_P(OnThesisSurface, ThreadsAndOrderDoNotChangeABit) {
  const std::vector<Vec2> points = every(thesis_footprint(), 31);
  std::vector<Vec2> reversed(points.rbegin(), points.rend());
  for (const char* method : {"vcrf", "exact"}) {
    Context one(1), two(2);
    const auto solver = make_method(method, model, tool, {});
    const Placements a = place_all(*solver, points, one), b = place_all(*solver, reversed, two);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ToolPose &p = a.positions[i].pose, &q = b.positions[points.size() - 1 - i].pose;
      EXPECT_EQ(0, std::memcmp(p.torus_center.data(), q.torus_center.data(), 3 * sizeof(double)));
      EXPECT_EQ(0, std::memcmp(p.axis.data(), q.axis.data(), 3 * sizeof(double)));
    }
    EXPECT_EQ(a.counters.evaluations, b.counters.evaluations);
  }
}
INSTANTIATE_TEST_SUITE_P(Surfaces,
                         OnThesisSurface,
                         ::testing::Values(testing::Thesis::convex,
                                           testing::Thesis::concave,
                                           testing::Thesis::saddle));

// A hollow tool may lean with an inclined plane until its ring lies flat on it, no further.
TEST(Exact, LeansWithAPlaneUntilTheRingLiesFlat) {
  const double slope = 0.2;
  const SurfaceModel model = testing::inclined_plane(slope);
  const Placement p = place("exact", model, {Vec2(50, 50)}).positions[0];
  EXPECT_NEAR(p.tilt, std::atan(slope), radians(1e-5));
  EXPECT_GE(p.clearance_lo, -1e-3);
}

TEST(Exact, AFlatBottomKeepsUprightOnConvexGround) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::convex);
  Tool flat = testing::thesis_tool();
  flat.recess = 0;
  const Placements p = place("exact", model, every(thesis_footprint(), 190), 0, flat);
  for (const Placement& one : p.positions) EXPECT_GE(one.clearance_hi, -1e-3);
}

TEST(Exact, SpinKeepsTheFirstContactAndStaysProven) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const std::vector<Vec2> points{Vec2(54, 60), Vec2(90, 70), Vec2(36, 90)};
  const Placements straight = place("exact", model, points),
                   spun = place("exact", model, points, radians(20));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((straight.positions[i].first_contact - spun.positions[i].first_contact).norm(), kContact);
    EXPECT_GE(spun.positions[i].clearance_lo, -1e-3);
  }
}

TEST(Methods, RefuseWhatTheyCannotDo) {
  const SurfaceModel model = testing::inclined_plane(0);
  EXPECT_THROW(make_method("vcfr", model, testing::thesis_tool(), {}), std::invalid_argument);
  MethodOptions spun;
  spun.spin = 0.1;
  EXPECT_THROW(make_method("vcrf", model, testing::thesis_tool(), spun), std::invalid_argument);
  MethodOptions unknown;
  unknown.numbers["division"] = 3;
  EXPECT_THROW(make_method("vcrf", model, testing::thesis_tool(), unknown), std::invalid_argument);
  EXPECT_THROW(make_method("exact", model, Tool{5, 0, 0, 20, {}}, {}), std::invalid_argument);
}

TEST(Methods, OffThePartIsAStatus) {
  const SurfaceModel model = testing::inclined_plane(0);
  for (const char* method : {"vcrf", "exact"})
    EXPECT_EQ(place(method, model, {Vec2(300, 50)}).positions[0].status, PositionStatus::off_part);
}

// A holder wider than the cutter meets a steep wall long before the cutter does; there is no closed form for
// it, and still every position ends free or within its budget.
TEST(Exact, AHolderInTheWayEndsWithinTheBudget) {
  const SurfaceModel model = testing::inclined_plane(8);
  Tool tool = testing::thesis_tool();
  tool.segments = {{40, 50, 60}};
  const auto method = make_method("exact", model, tool, {});
  int free = 0;
  for (double x : {20.0, 40.0, 60.0}) {
    Counters counters;
    const Placement one = method->place(Vec2(x, 50), counters);
    EXPECT_LE(counters.cells, 2 * 200'000u + 8);  // drop and tilt, each at most a group over
    if (one.status == PositionStatus::undecided) continue;
    ++free;
    EXPECT_GE(one.clearance_lo, -1e-3);
    EXPECT_GE(ClearanceSampler(model, tool)(one.pose, 1.0).distance, -1e-3);
  }
  EXPECT_EQ(free, 3);
}

// On a plane the contact angle that is asked for has one answer: the ring lies on it all round, or stops at
// the limit.
TEST(GivenContacts, OnAPlane) {
  const SurfaceModel model = testing::inclined_plane(0.2);
  const Tool tool = testing::thesis_tool();
  const auto method = make_method("exact", model, tool, {});
  Counters counters;
  const Placement one = method->place(GivenContact{0, 0.5, 0.5, Vec3(0, 1, 0)}, counters);
  const Vec3 normal = Vec3(-0.2, 0, 1).normalized();
  EXPECT_LT((one.pose.axis - normal).norm(), 1e-6) << one.pose.axis.transpose();
  EXPECT_NEAR(one.tilt, kPi / 2, 1e-6);
  EXPECT_GE(one.clearance_lo, -1e-3);
}

TEST(GivenContacts, MistakesAndPlacesThatAreNone) {
  const SurfaceModel model = testing::inclined_plane(0.2);
  const Tool tool = testing::thesis_tool();
  const auto exact = make_method("exact", model, tool, {}), vcrf = make_method("vcrf", model, tool, {});
  Context context(1);
  const GivenContact good{0, 0.5, 0.5, Vec3(0, 1, 0)};
  EXPECT_THROW(place_all(*vcrf, model, {good}, context), std::invalid_argument);
  EXPECT_THROW(place_all(*exact, model, {GivenContact{1, 0.5, 0.5, Vec3(0, 1, 0)}}, context),
               std::invalid_argument);
  EXPECT_THROW(place_all(*exact, model, {GivenContact{0, 0.5, 0.5, Vec3::Zero()}}, context),
               std::invalid_argument);
  const Placements none =
      place_all(*exact,
                model,
                {GivenContact{0, 1.5, 0.5, Vec3(0, 1, 0)}, GivenContact{0, 0.5, 0.5, Vec3(-0.2, 0, 1)}},
                context);
  EXPECT_EQ(none.positions[0].status, PositionStatus::off_part);
  EXPECT_EQ(none.positions[1].status, PositionStatus::undecided);
}

}  // namespace
}  // namespace mpm
