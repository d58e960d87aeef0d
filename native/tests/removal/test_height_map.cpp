#include <gtest/gtest.h>

#include "mpm/removal/height_map.h"

namespace mpm {
namespace {

const Tool kBall{0, 5, 0, 30, {}};
const Tool kFlat{5, 0, 0, 30, {}};
const Tool kTorus{6.7, 6.0, 6.0, 30.0, {}};

SweptPath straight(const Vec3& from, const Vec3& to, const Vec3& axis = Vec3::UnitZ()) {
  return {{{from, axis}, {to, axis}}, {0, 1}};
}

void sweep(HeightMap& stock, const Tool& tool, const SweptPath& path, double step = 0.1) {
  Context context;
  remove_material(stock, tool, path, {step, 1e-5}, context);
}

TEST(HeightMap, BallLeavesItsScallop) {
  HeightMap stock = make_stock({0, 0}, {30, 10}, 0.25, 5.0);
  const double side_step = 4.0;
  for (double x = -4; x <= 34; x += side_step) sweep(stock, kBall, straight({x, -10, 0}, {x, 20, 0}));
  const double scallop = 5 - std::sqrt(25 - side_step * side_step / 4);
  // Cusps (x = 2, 6, ...) and grooves (x = 0, 4, ...) lie on nodes: only the step along the feed is left as
  // an error.
  const double feed_error = 0.1 * 0.1 / (8 * 5) + 1e-4;
  const auto [least, most] = std::minmax_element(stock.height.begin(), stock.height.end());
  EXPECT_NEAR(*least, 0.0, feed_error);
  EXPECT_NEAR(*most, scallop, feed_error);
}

TEST(HeightMap, FlatEndLeavesAPocketWithUprightWalls) {
  HeightMap stock = make_stock({0, 0}, {40, 40}, 0.5, 10.0);
  sweep(stock, kFlat, straight({20, 10, 2}, {20, 30, 2}));
  for (std::size_t j = 0; j < stock.rows; ++j)
    for (std::size_t i = 0; i < stock.columns; ++i) {
      const double dx = stock.x(i) - 20, dy = stock.y(j) - std::clamp(stock.y(j), 10.0, 30.0);
      const double r = std::hypot(dx, dy), z = stock.height[j * stock.columns + i];
      if (r < 4.99) EXPECT_DOUBLE_EQ(z, 2.0);
      if (r > 5.01) EXPECT_DOUBLE_EQ(z, 10.0);
    }
}

TEST(HeightMap, TorusLeavesItsSlotProfile) {
  HeightMap stock = make_stock({-15, 0}, {15, 2}, 0.1, 20.0);
  sweep(stock, kTorus, straight({0, -30, 0}, {0, 32, 0}));
  for (std::size_t i = 0; i < stock.columns; ++i) {
    const double x = std::abs(stock.x(i)), z = stock.height[i];
    // The ring's lowest circle sweeps the slot's floor; beside it stands a quarter of the minor circle.
    if (x < 6.69) EXPECT_NEAR(z, 0, 1e-3);
    if (x > 6.7 && x < 12.6) EXPECT_NEAR(z, 6 - std::sqrt(36 - (x - 6.7) * (x - 6.7)), 1e-3);
    if (x > 12.71) EXPECT_DOUBLE_EQ(z, 20.0);
  }
}

TEST(HeightMap, TiltedTorusLeavesAnElevatedGroove) {
  // Tilted across the feed by beta, the ring reaches Ro sin(beta) + Ri below its centre.
  const double tilt = 0.3;
  HeightMap stock = make_stock({-20, 0}, {20, 1}, 0.05, 20.0);
  sweep(stock, kTorus, straight({0, -30, 0}, {0, 30, 0}, {std::sin(tilt), 0, std::cos(tilt)}));
  const double lowest = 6 * std::cos(tilt) - 6.7 * std::sin(tilt) - 6;
  EXPECT_NEAR(*std::min_element(stock.height.begin(), stock.height.end()), lowest, 1e-3);
}

TEST(HeightMap, HolderCutsToo) {
  const Tool tool{2, 0, 0, 10, {{8, 8, 10}}};
  HeightMap stock = make_stock({-10, -10}, {10, 10}, 0.5, 15.0);
  sweep(stock, tool, straight({0, 0, 0}, {0, 0, 0}));
  EXPECT_DOUBLE_EQ(stock.height[20 * stock.columns + 20], 0.0);
  EXPECT_DOUBLE_EQ(stock.height[20 * stock.columns + 30], 10.0);
  EXPECT_DOUBLE_EQ(stock.height[20 * stock.columns + 40], 15.0);
}

TEST(HeightMap, OnlyRemovingMovesCut) {
  HeightMap stock = make_stock({0, 0}, {10, 10}, 1.0, 5.0);
  SweptPath path = straight({0, 5, 0}, {10, 5, 0});
  path.removes = {1, 0};
  sweep(stock, kBall, path);
  EXPECT_EQ(*std::min_element(stock.height.begin(), stock.height.end()), 5.0);
}

TEST(HeightMap, SameBytesForAnyThreadCount) {
  HeightMap one = make_stock({0, 0}, {40, 40}, 0.5, 10.0), two = one;
  const SweptPath path{{{{5, 5, 0}, Vec3::UnitZ()}, {{35, 30, 2}, Vec3(0.3, 0.2, 1).normalized()}}, {0, 1}};
  Context first(1), second(2);
  remove_material(one, kTorus, path, {}, first);
  remove_material(two, kTorus, path, {}, second);
  EXPECT_EQ(one.height, two.height);
}

TEST(HeightMap, NamesWhatIsWrong) {
  EXPECT_THROW(make_stock({0, 0}, {0, 5}, 1, 0), std::invalid_argument);
  EXPECT_THROW(make_stock({0, 0}, {5, 5}, 0, 0), std::invalid_argument);
  EXPECT_THROW(make_stock({0, 0}, {1000, 1000}, 1e-3, 0), std::invalid_argument);
  HeightMap stock = make_stock({0, 0}, {5, 5}, 1, 0);
  EXPECT_THROW(sweep(stock, kBall, straight({0, 0, 0}, {1, 0, 0}, {1, 0, 0})), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
