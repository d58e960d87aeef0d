#include <gtest/gtest.h>

#include <random>

#include "mpm/surface/trim_region.h"

namespace mpm {
namespace {

using Loop = std::vector<Vec2>;

Loop circle(double radius, int sides) {
  Loop loop;
  for (int i = 0; i < sides; ++i)
    loop.push_back(radius * Vec2(std::cos(2 * kPi * i / sides), std::sin(2 * kPi * i / sides)));
  return loop;
}

// A disc of radius 2 with a hole of radius 1.
TrimRegion ring() { return TrimRegion({circle(2, 400), circle(1, 300)}); }

TEST(TrimRegion, RingAgreesWithItsEquation) {
  const TrimRegion region = ring();
  std::mt19937 random(1);
  std::uniform_real_distribution coordinate(-2.5, 2.5);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec2 p(coordinate(random), coordinate(random));
    const double r = p.norm();
    if (std::abs(r - 1) < 1e-3 || std::abs(r - 2) < 1e-3) continue;  // within the polygons' chord error
    EXPECT_EQ(region.contains(p.x(), p.y()), r > 1 && r < 2) << p.transpose();
    ++compared;
  }
  EXPECT_GT(compared, 19000);
}

TEST(TrimRegion, DirectionAndStartOfALoopDoNotMatter) {
  Loop loop = circle(2, 40);
  const TrimRegion region({loop});
  std::reverse(loop.begin(), loop.end());
  std::rotate(loop.begin(), loop.begin() + 7, loop.end());
  const TrimRegion same({loop});
  for (double u = -2.1; u < 2.2; u += 0.1)
    for (double v = -2.1; v < 2.2; v += 0.1) EXPECT_EQ(region.contains(u, v), same.contains(u, v));
}

TEST(TrimRegion, PointsOnThePolygonAreInside) {
  const TrimRegion region({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}});
  for (const Vec2& p : {Vec2(0, 0), Vec2(2, 0), Vec2(2, 1), Vec2(1, 1), Vec2(1, 3), Vec2(0, 3)})
    EXPECT_TRUE(region.contains(p.x(), p.y())) << p.transpose();
  for (const Vec2& p : {Vec2(1, 0), Vec2(2, 0.5), Vec2(1.5, 1), Vec2(1, 2), Vec2(0.5, 3), Vec2(0, 1.5)})
    EXPECT_TRUE(region.contains(p.x(), p.y())) << p.transpose();
  for (const Vec2& p : {Vec2(1.5, 2), Vec2(-1, 0), Vec2(-1, 1), Vec2(3, 1), Vec2(2, 3), Vec2(0.5, 3.1)})
    EXPECT_FALSE(region.contains(p.x(), p.y())) << p.transpose();
}

TEST(TrimRegion, NoLoopIsEverything) {
  EXPECT_TRUE(TrimRegion().contains(1e9, -1e9));
  EXPECT_EQ(TrimRegion().cover({0, 1, 0, 1}), TrimRegion::Cover::inside);
}

TEST(TrimRegion, CoverIsNeverWrong) {
  const TrimRegion region = ring();
  std::mt19937 random(2);
  std::uniform_real_distribution at(-2.5, 2.5), size(0.01, 0.6), f(0.0, 1.0);
  int inside = 0, outside = 0;
  for (int i = 0; i < 3000; ++i) {
    const double u = at(random), v = at(random);
    const ParamBox box{u, u + size(random), v, v + size(random)};
    const TrimRegion::Cover cover = region.cover(box);
    inside += cover == TrimRegion::Cover::inside;
    outside += cover == TrimRegion::Cover::outside;
    if (cover == TrimRegion::Cover::crossing) continue;
    for (int k = 0; k < 10; ++k) {
      const double pu = box.u0 + f(random) * (box.u1 - box.u0), pv = box.v0 + f(random) * (box.v1 - box.v0);
      EXPECT_EQ(region.contains(pu, pv), cover == TrimRegion::Cover::inside);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

TEST(TrimRegion, SidesAreClippedToTheRectangle) {
  const TrimRegion square({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}});
  std::vector<Vec2> ends;
  square.visit_sides({1, 5, -1, 1}, [&](const Vec2& a, const Vec2& b) { ends.insert(ends.end(), {a, b}); });
  ASSERT_EQ(ends.size(), 4u);
  EXPECT_EQ(ends[0], Vec2(1, 0));
  EXPECT_EQ(ends[1], Vec2(4, 0));
  EXPECT_EQ(ends[2], Vec2(4, 0));
  EXPECT_EQ(ends[3], Vec2(4, 1));
}

TEST(TrimRegion, RefusesLoopsThatEncloseNothing) {
  EXPECT_THROW(TrimRegion({{{0, 0}, {1, 1}}}), std::invalid_argument);
  EXPECT_THROW(TrimRegion({{{0, 0}, {1, 0}, {2, 0}}}), std::invalid_argument);
  EXPECT_THROW(TrimRegion({{{0, 0}, {1, 0}, {kNaN, 1}}}), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
