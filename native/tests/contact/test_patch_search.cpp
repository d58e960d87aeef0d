#include <gtest/gtest.h>

#include "mpm/contact/patch_search.h"
#include "thesis.h"

namespace mpm {
namespace {

// The square of the distance from a point in plan: on a plane its minimum is known.
struct PlanDistance {
  Vec2 to;
  double value(const Vec3& s) const { return (s.head<2>() - to).squaredNorm(); }
  Derivatives derivatives(const SurfacePoint& p, double value) const {
    Derivatives a;
    a.value = value;
    const Vec2 off = p.s.head<2>() - to, u = p.su.head<2>(), v = p.sv.head<2>();
    a.gradient = {2 * off.dot(u), 2 * off.dot(v)};
    a.hessian << 2 * u.dot(u), 2 * u.dot(v), 2 * u.dot(v), 2 * v.dot(v);
    return a;
  }
};

// The plane covers [0, 100]^2 mm with parameters 0 to 1.
PatchMinimum nearest(const Vec2& to, double floor = kInfinity) {
  const SurfaceModel model = testing::inclined_plane(0);
  const PlanDistance objective{to};
  return PatchSearch<PlanDistance>(objective, model.faces()[0].surface.patches()[0]).run(0.5, 0.5, floor);
}

TEST(PatchSearch, FindsAMinimumInside) {
  const PatchMinimum found = nearest({20, 70});
  EXPECT_NEAR(found.u, 0.2, 1e-12);
  EXPECT_NEAR(found.v, 0.7, 1e-12);
  EXPECT_NEAR(found.value, 0, 1e-18);
  EXPECT_FALSE(found.on_border_u || found.on_border_v);
}

TEST(PatchSearch, SaysWhichBorderHoldsIt) {
  const PatchMinimum side = nearest({130, 70});
  EXPECT_EQ(side.u, 1.0);
  EXPECT_NEAR(side.v, 0.7, 1e-12);
  EXPECT_TRUE(side.on_border_u && !side.on_border_v);
  const PatchMinimum corner = nearest({130, -5});
  EXPECT_NEAR(corner.value, 30 * 30 + 5 * 5, 1e-9);
  EXPECT_TRUE(corner.on_border_u && corner.on_border_v);
}

TEST(PatchSearch, LeavesWhatCannotComeUnderTheFloor) {
  EXPECT_EQ(nearest({20, 70}, -1e6).newton_steps, 0);
  EXPECT_GT(nearest({20, 70}, 1).newton_steps, 0);
}

TEST(PatchSearch, DescendsWhereTheObjectiveIsNotConvex) {
  Derivatives a;
  a.gradient = {1, -2};
  a.hessian << -3, 1, 1, 2;
  EXPECT_LT(a.gradient.dot(descent_step(a, {true, true})), 0);
  EXPECT_LT(a.gradient.dot(descent_step(a, {true, false})), 0);
  EXPECT_EQ(descent_step(a, {false, false}), Vec2(0, 0));
  EXPECT_FALSE(is_convex(a, {true, true}));
  EXPECT_TRUE(is_convex(a, {false, true}));
}

// On a plane the bend puts the step's end on the circle to second order.
TEST(PatchSearch, BendsWithTheRing) {
  const SurfaceModel model = testing::inclined_plane(0);
  const SurfacePoint p = model.faces()[0].surface.evaluate(0.5, 0.5);
  const double radius = 10, step = 1;  // mm
  Derivatives a;
  a.ring_tangent = Vec3::UnitX(), a.ring_curvature = Vec3::UnitY() / radius;
  const Vec2 bend = ring_bend(a, p, Vec2(step / 100, 0));
  const Vec3 end = p.s + (step / 100 + bend.x()) * p.su + bend.y() * p.sv;
  EXPECT_NEAR((end - (p.s + radius * Vec3::UnitY())).norm(), radius, 0.002);
  EXPECT_GT((p.s + step * Vec3::UnitX() - (p.s + radius * Vec3::UnitY())).norm(), radius + 0.04);
}

}  // namespace
}  // namespace mpm
