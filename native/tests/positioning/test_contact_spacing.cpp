// Spins of one drop, and the spin that sets the contacts a wanted distance apart.
#include <gtest/gtest.h>

#include <cstring>

#include "mpm/positioning/contact_spacing.h"
#include "mpm/positioning/registry.h"
#include "mpm/positioning/spin_candidates.h"
#include "thesis.h"

namespace mpm {
namespace {

std::vector<Vec2> a_pass() {
  std::vector<Vec2> points;
  for (int i = 0; i < 12; ++i) points.emplace_back(60, 40 + 2 * i);
  return points;
}

SpacingRules direct(double wanted) {
  SpacingRules rules;
  rules.wanted = wanted, rules.measure = SpacingMeasure::direct;
  return rules;
}

bool same_bytes(const Placement& a, const Placement& b) {
  return a.status == b.status && std::memcmp(&a.pose, &b.pose, sizeof a.pose) == 0 &&
         std::memcmp(&a.second_contact, &b.second_contact, sizeof a.second_contact) == 0;
}

class Spins : public ::testing::TestWithParam<const char*> {};

TEST_P(Spins, OneDropServesAllSpinsAsIfEachHadItsOwnMethod) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const Tool tool = testing::thesis_tool();
  const std::vector<double> spins{0, 0.4, -2.5};
  Context context(2);
  const Placements all =
      place_spins(*make_method(GetParam(), model, tool, {}), {{60, 40}, {90, 110}}, spins, context);
  for (std::size_t k = 0; k < spins.size(); ++k) {
    MethodOptions options;
    options.spin = spins[k];
    const auto method = make_method(GetParam(), model, tool, options);
    Counters work;
    EXPECT_TRUE(same_bytes(all.positions[k], method->place(Vec2(60, 40), work)));
    EXPECT_TRUE(same_bytes(all.positions[spins.size() + k], method->place(Vec2(90, 110), work)));
  }
}

// The contact at P persists, and so does the angle of the axis to the normal up to the tilt.
TEST_P(Spins, EveryCandidateTouchesAtTheSameFirstContact) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::convex);
  const Tool tool = testing::thesis_tool();
  Counters work;
  const Context context(1);
  const auto method = make_method(GetParam(), model, tool, {});
  const auto dropped = method->drop({50, 60}, work);
  const Vec3 p = dropped->spun(0, work).first_contact;
  const auto candidates = spin_candidates(*dropped, direct(8), work, context);
  EXPECT_GE(candidates.size(), 2u);
  for (const SpinCandidate& one : candidates) {
    EXPECT_TRUE(one.reached());
    EXPECT_EQ(one.placement.first_contact, p);
    EXPECT_NEAR(signed_distance(tool, one.placement.pose, p), 0, 1e-5);
    EXPECT_NEAR((one.placement.second_contact - p).norm(), 8, 8 * kSpacingTolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Spins, ::testing::Values("exact", "dstm"));

TEST(ContactSpacing, IsSeenAlongTheFeedOrDirect) {
  Placement placement;
  placement.status = PositionStatus::two_contacts;
  placement.first_contact = Vec3(1, 2, 3), placement.second_contact = Vec3(1 + 3, 2 + 12, 3 + 4);
  SpacingRules rules;
  rules.feed = Vec3::UnitY();
  EXPECT_DOUBLE_EQ(contact_spacing(placement, rules), 5);
  EXPECT_DOUBLE_EQ(contact_spacing(placement, direct(1)), 13);
  placement.status = PositionStatus::curvature_matched;
  EXPECT_EQ(contact_spacing(placement, rules), 0);
}

TEST(ContactSpacing, AWholePassHasItAndMovesEvenly) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::convex);
  const auto method = make_method("exact", model, testing::thesis_tool(), {});
  Context context(2);
  const std::vector<Vec2> points = a_pass();
  const SpacedPlacements found =
      place_spaced(*method, points, std::vector<std::int64_t>(points.size(), 0), direct(10), context);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Placement& one = found.placed.positions[i];
    EXPECT_EQ(one.status, PositionStatus::two_contacts);
    EXPECT_NEAR((one.second_contact - one.first_contact).norm(), 10, 0.1);
    EXPECT_GE(one.clearance_lo, -0.001);
    // On this smooth ground the spin follows the pass; a change of sides would shift the tip by millimetres.
    if (i > 0) {
      EXPECT_LT((one.pose.torus_center - found.placed.positions[i - 1].pose.torus_center).norm(), 3);
    }
  }
}

TEST(ContactSpacing, WhatNoSpinGivesIsNearlyReached) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const auto method = make_method("exact", model, testing::thesis_tool(), {});
  Context context(1);
  const SpacedPlacements found = place_spaced(*method, {{72, 40}}, {0}, direct(20), context);
  // Independently: the widest of many spins.
  std::vector<double> spins;
  for (int k = 0; k < 720; ++k) spins.push_back(-kPi + 2 * kPi * k / 720);
  double widest = 0;
  for (const Placement& one : place_spins(*method, {{72, 40}}, spins, context).positions)
    widest = std::max(widest, (one.second_contact - one.first_contact).norm());
  EXPECT_GT(widest, 12);
  EXPECT_NEAR(found.spacing[0], widest, 0.005);
  EXPECT_EQ(found.nearest[0], found.spacing[0]);
}

TEST(ContactSpacing, DoesNotDependOnThreads) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const auto method = make_method("exact", model, testing::thesis_tool(), {});
  const std::vector<Vec2> points = a_pass();
  const std::vector<std::int64_t> passes{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  Context one(1), two(2);
  const SpacedPlacements a = place_spaced(*method, points, passes, direct(9), one),
                         b = place_spaced(*method, points, passes, direct(9), two);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_TRUE(same_bytes(a.placed.positions[i], b.placed.positions[i]));
  EXPECT_EQ(a.placed.counters.cells, b.placed.counters.cells);
}

TEST(ContactSpacing, ACancelledContextComputesNothing) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const auto method = make_method("exact", model, testing::thesis_tool(), {});
  Context context(2);
  context.cancel();
  const SpacedPlacements found = place_spaced(*method, {{72, 40}}, {0}, direct(8), context);
  EXPECT_EQ(found.placed.positions[0].status, PositionStatus::not_computed);
}

TEST(ContactSpacing, RefusesWhatCannotBe) {
  const SurfaceModel model = testing::inclined_plane(0);
  Context context(1);
  const auto exact = make_method("exact", model, testing::thesis_tool(), {});
  EXPECT_THROW(place_spaced(*exact, {{50, 50}}, {0}, direct(0), context), std::invalid_argument);
  EXPECT_THROW(place_spaced(*exact, {{50, 50}}, {}, direct(8), context), std::invalid_argument);
  for (const char* name : {"vcrf", "drd", "dtm", "pam"}) {
    const auto method = make_method(name, model, testing::thesis_tool(), {});
    EXPECT_THROW(place_spaced(*method, {{50, 50}}, {0}, direct(8), context), std::invalid_argument);
  }
}

}  // namespace
}  // namespace mpm
