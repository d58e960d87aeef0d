#include <gtest/gtest.h>

#include "mpm/positioning/place_all.h"
#include "thesis.h"

namespace mpm {
namespace {

// A method that says what it was asked: the point is the torus centre, the spin the tilt.
class Echo final : public Method {
 public:
  Placement place(const Vec2& at, Counters& counters) const override { return answer(at, 0, counters); }
  Placement place(const GivenContact& at, Counters& counters) const override {
    return answer({at.u, at.v}, at.face, counters);
  }
  std::unique_ptr<DroppedTool> drop(const Vec2& at, Counters&) const override {
    return std::make_unique<Dropped>(at);
  }

 private:
  struct Dropped final : DroppedTool {
    explicit Dropped(const Vec2& point) : at(point) {}
    Placement spun(double spin, Counters& counters) const override { return answer(at, spin, counters); }
    Vec2 at;
  };
  static Placement answer(const Vec2& at, double tilt, Counters& counters) {
    counters.seeds += 1, counters.cells += 10;
    Placement p;
    p.status = PositionStatus::one_contact;
    p.pose = {Vec3(at.x(), at.y(), 0), Vec3::UnitZ()};
    p.tilt = tilt;
    return p;
  }
};

class Plain final : public Method {
 public:
  Placement place(const Vec2&, Counters&) const override { return {}; }
};

std::vector<Vec2> points(std::size_t count) {
  std::vector<Vec2> all;
  for (std::size_t i = 0; i < count; ++i) all.emplace_back(double(i), 0.5);
  return all;
}

TEST(PlaceAll, KeepsTheOrderAndAddsUpTheWork) {
  Context context(2);
  const Placements all = place_all(Echo(), points(101), context);
  ASSERT_EQ(all.positions.size(), 101u);
  for (std::size_t i = 0; i < 101; ++i) EXPECT_EQ(all.positions[i].pose.torus_center.x(), double(i));
  EXPECT_EQ(all.counters.seeds, 101u);
  EXPECT_EQ(all.counters.cells, 1010u);
}

TEST(PlaceAll, EverySpinPointByPoint) {
  Context context(2);
  const std::vector<double> spins{-1, 0, 2};
  const Placements all = place_spins(Echo(), points(40), spins, context);
  ASSERT_EQ(all.positions.size(), 120u);
  for (std::size_t i = 0; i < 120; ++i) {
    EXPECT_EQ(all.positions[i].pose.torus_center.x(), double(i / 3));
    EXPECT_EQ(all.positions[i].tilt, spins[i % 3]);
  }
}

TEST(PlaceAll, ASpinForEachPoint) {
  Context context(2);
  const Placements all = place_spun(Echo(), points(2), std::vector<double>{3, -2}, context);
  EXPECT_EQ(all.positions[0].tilt, 3);
  EXPECT_EQ(all.positions[1].tilt, -2);
  EXPECT_THROW(place_spun(Echo(), points(2), std::vector<double>{3}, context), std::invalid_argument);
  EXPECT_THROW(place_spun(Echo(), points(1), std::vector<double>{kNaN}, context), std::invalid_argument);
  EXPECT_THROW(place_spins(Echo(), points(1), std::vector<double>{kInfinity}, context),
               std::invalid_argument);
}

TEST(PlaceAll, GivenContactsAreChecked) {
  const SurfaceModel model = testing::inclined_plane(0);
  Context context(1);
  const auto place = [&](const GivenContact& one) { return place_all(Echo(), model, {one}, context); };
  EXPECT_EQ(place({0, 0.25, 0.5, Vec3::UnitX()}).positions[0].pose.torus_center.x(), 0.25);
  EXPECT_THROW(place({1, 0.25, 0.5, Vec3::UnitX()}), std::invalid_argument);
  EXPECT_THROW(place({0, kNaN, 0.5, Vec3::UnitX()}), std::invalid_argument);
  EXPECT_THROW(place({0, 0.25, 0.5, Vec3::Zero()}), std::invalid_argument);
}

TEST(PlaceAll, WhatACancelLeavesOutIsNotComputed) {
  Context context(1);
  context.cancel();
  const Placements all = place_all(Echo(), points(3), context);
  for (const Placement& one : all.positions) EXPECT_EQ(one.status, PositionStatus::not_computed);
  EXPECT_EQ(all.counters.seeds, 0u);
}

TEST(PlaceAll, AMethodThatCannotSaysSo) {
  Context context(1);
  const SurfaceModel model = testing::inclined_plane(0);
  EXPECT_THROW(place_spins(Plain(), points(1), std::vector<double>{0}, context), std::invalid_argument);
  EXPECT_THROW(place_all(Plain(), model, {{0, 0.5, 0.5, Vec3::UnitX()}}, context), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
