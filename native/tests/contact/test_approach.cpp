#include <gtest/gtest.h>

#include "mpm/contact/approach.h"
#include "mpm/contact/curvature_limit.h"
#include "mpm/contact/first_arrival.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kStep = 1e-4;        // of the parameter, for central differences
constexpr double kSlopeError = 2e-4;  // relative

template <class Approach>
void expect_derivatives(const Approach& approach, const BSplineSurface& surface, double u, double v) {
  const Tool tool = testing::thesis_tool();
  const auto x = [&](double du, double dv) { return approach.arrival(surface.point(u + du, v + dv)); };
  ASSERT_LT(x(0, 0), kInfinity);
  const Derivatives d = arrival_derivatives(tool, approach, surface.evaluate(u, v), x(0, 0));
  const double h = kStep, size = d.hessian.norm() + d.gradient.norm();
  EXPECT_NEAR(d.gradient.x(), (x(h, 0) - x(-h, 0)) / (2 * h), kSlopeError * size);
  EXPECT_NEAR(d.gradient.y(), (x(0, h) - x(0, -h)) / (2 * h), kSlopeError * size);
  EXPECT_NEAR(d.hessian(0, 0), (x(h, 0) - 2 * x(0, 0) + x(-h, 0)) / (h * h), kSlopeError * size);
  EXPECT_NEAR(d.hessian(1, 1), (x(0, h) - 2 * x(0, 0) + x(0, -h)) / (h * h), kSlopeError * size);
  EXPECT_NEAR(d.hessian(0, 1), (x(h, h) - x(h, -h) - x(-h, h) + x(-h, -h)) / (4 * h * h), kSlopeError * size);
}

TEST(Approach, DropDerivativesMatchDifferences) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const Tool tool = testing::thesis_tool();
  const Drop drop(tool, Vec2(70, 60));
  for (const Vec2& at : {Vec2(78, 60), Vec2(70, 68), Vec2(65, 53), Vec2(70, 57)})
    expect_derivatives(drop, model.faces()[0].surface, at.x() / 150, at.y() / 150);
}

TEST(Approach, TiltDerivativesMatchDifferences) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const BSplineSurface& surface = model.faces()[0].surface;
  const Tool tool = testing::thesis_tool();
  const Drop drop(tool, Vec2(70, 60));
  const PatchMinimum first = first_arrival(tool, drop, model.faces()[0], 0.5, 0.42);
  const Insert insert = insert_through(tool, drop.pose(first.value), first.s);
  const Tilt tilt(tool, insert);
  int tried = 0;
  for (const Vec2& at : {Vec2(72, 70), Vec2(64, 56), Vec2(75, 52), Vec2(61, 63)}) {
    if (!(tilt.arrival(surface.point(at.x() / 150, at.y() / 150)) < 1.5)) continue;
    ++tried;
    expect_derivatives(tilt, surface, at.x() / 150, at.y() / 150);
  }
  EXPECT_GE(tried, 2);
}

TEST(FirstArrival, DropTouchesTangentially) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::concave);
  const Tool tool = testing::thesis_tool();
  const Drop drop(tool, Vec2(60, 80));
  const PatchMinimum touch = first_arrival(tool, drop, model.faces()[0], 0.35, 0.5);
  ASSERT_LT(touch.value, kInfinity);
  const RingDistance d = ring_distance(tool, drop.pose(touch.value), touch.s);
  EXPECT_NEAR(1 / d.bend_across, tool.minor_radius, 1e-10);
  const SurfacePoint p = model.faces()[0].surface.evaluate(touch.u, touch.v);
  EXPECT_LT(d.gradient.cross(p.su.cross(p.sv).normalized()).norm(), 1e-9);  // rad between the normals
}

TEST(FirstArrival, StaysOnTheEdgeThatHoldsIt) {
  const SurfaceModel model = testing::inclined_plane(0.5);
  const Tool tool = testing::thesis_tool();
  const PatchMinimum touch = first_arrival(
      tool, Drop(tool, Vec2(92, 50)), model.faces()[0], 0.99, 0.5);  // the ring overhangs the top edge
  EXPECT_EQ(touch.u, 1.0);
  EXPECT_TRUE(touch.on_border_u);
  EXPECT_FALSE(touch.on_border_v);
}

// On a plane the curvature limit is where the ring's curvature at the contact vanishes: the tilt equals the
// slope.
TEST(CurvatureLimit, OfAPlaneIsItsSlope) {
  const double slope = 0.3;
  const SurfaceModel model = testing::inclined_plane(slope);
  const Tool tool = testing::thesis_tool();
  const Drop drop(tool, Vec2(50, 50));
  const PatchMinimum first = first_arrival(tool, drop, model.faces()[0], 0.6, 0.5);
  const Insert insert = insert_through(tool, drop.pose(first.value), first.s);
  const SurfacePoint p = model.faces()[0].surface.evaluate(first.u, first.v);
  EXPECT_NEAR(curvature_limit(tool, insert, p, first), std::atan(slope), 1e-9);
}

}  // namespace
}  // namespace mpm
