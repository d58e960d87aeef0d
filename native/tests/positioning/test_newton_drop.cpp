#include <gtest/gtest.h>

#include "mpm/positioning/contact_newton.h"
#include "mpm/positioning/newton_drop.h"
#include "planes.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kSlope = 0.25;
constexpr double kMost = 0.8;  // rad: beyond the tilt that is looked for

NewtonRules rules(bool analytic) {
  NewtonRules r;
  r.analytic = analytic;
  r.tolerance = 1e-9;
  return r;
}

// Upright on a plane the tool rests at a height that is known, on the uphill side of the ring. Started
// downhill, Newton finds the ring's inner tangent there, lower by what the plane falls across the major
// circle.
TEST(ContactNewton, ADropOntoAPlane) {
  const SurfaceModel model = testing::inclined_plane(kSlope);
  const Tool tool = testing::thesis_tool();
  const double rest = testing::rest_height(tool, kSlope, 40);
  Counters counters;
  const auto drop = [&](double u, bool analytic) {
    DropSolution start;
    start.contact.u = u, start.contact.v = 0.5;
    return solve_drop(model, tool, Vec2(40, 50), rules(analytic), start, counters);
  };
  for (const bool analytic : {false, true}) {
    const auto uphill = drop(0.5, analytic), downhill = drop(0.3, analytic);
    ASSERT_TRUE(uphill && downhill);
    EXPECT_NEAR(uphill->height, rest, 1e-8);
    EXPECT_NEAR(uphill->contact.s.y(), 50, 1e-7);
    EXPECT_NEAR(downhill->height, rest - 2 * kSlope * tool.major_radius, 1e-8);
  }
  EXPECT_EQ(counters.seeds, 4u);
  EXPECT_FALSE(solve_drop(model, tool, Vec2(300, 50), rules(true), {}, counters));  // beside the face
}

// Two planes that meet at x = 0: dropped onto one, the tool tilts to the other; the tilt by bisection.
TEST(ContactNewton, ATiltToASecondPlane) {
  const std::vector<double> knots{0, 0, 1, 1};
  std::vector<Face> faces;
  const auto add = [&](double x0, double x1, double z0, double z1) {
    faces.push_back(
        {"Face",
         BSplineSurface(
             1, 1, knots, knots, {Vec3(x0, -50, z0), Vec3(x0, 50, z0), Vec3(x1, -50, z1), Vec3(x1, 50, z1)}),
         {},
         false});
  };
  add(-50, 0, 25, 0), add(0, 50, 0, 40);
  const SurfaceModel model(std::move(faces));
  const Tool tool = testing::thesis_tool();
  const double left = 0.5, right = 0.8, x = 2;
  // Over x = 2 the right plane is the higher one.
  const double height = testing::rest_height(tool, right, x);
  ASSERT_GT(height, left * -x + left * tool.major_radius + std::hypot(left, 1) * tool.minor_radius);
  const Vec3 normal = Vec3(-right, 0, 1).normalized(), other = Vec3(left, 0, 1).normalized();
  const ToolPose pose{Vec3(x, 0, height), Vec3::UnitZ()};
  const Vec3 p = Vec3(x + tool.major_radius, 0, height) - tool.minor_radius * normal;
  const Insert insert = insert_through(tool, pose, p);
  const double tilt = testing::tilt_to_plane(
      tool, [&](double t) { return tilted(tool, insert, t); }, kMost, Vec3::Zero(), other);
  ASSERT_GT(tilt, 0.01);
  ASSERT_LT(tilt, 0.99 * kMost);
  Counters counters;
  TiltSolution start{{0, 0.8, 0.5, Vec3::Zero(), Vec3::UnitZ()}, 0.1, kPi / 2};
  const auto found = solve_tilt(model, tool, insert, rules(true), start, counters);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->beta, tilt, 1e-8);
  EXPECT_GT(counters.newton_steps, 0u);
}

TEST(NewtonDrop, TakesNoContactThatTheGridSeesCutIn) {
  const SurfaceModel model = testing::inclined_plane(kSlope);
  const Tool tool = testing::thesis_tool();
  const std::vector<Seed> faces{{0, 0.4, 0.5, Vec3(40, 50, 10)}};
  Counters counters;
  SeedSource random(Vec2(40, 50));
  const auto drop = [&](const ToolGrid& grid) {
    return newton_drop(model, tool, Vec2(40, 50), faces, rules(true), grid, 3, random, counters);
  };
  const auto found = drop({});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->height, testing::rest_height(tool, kSlope, 40), 1e-8);
  ToolGrid strict;
  strict.gouge = -1;  // asks for a millimetre of air, which no contact has
  EXPECT_FALSE(drop(strict));
}

TEST(NewtonDrop, RandomStartsLieOnTheFacesUnderTheTool) {
  const SurfaceModel model = testing::inclined_plane(kSlope);
  const std::vector<Seed> faces{{0, 0.4, 0.5, Vec3::Zero()}};
  SeedSource random(Vec2(1, 2)), same(Vec2(1, 2));
  for (int k = 0; k < 50; ++k) {
    const TangentPoint a = random_point(model, faces, random), b = random_point(model, faces, same);
    EXPECT_TRUE(a.u >= 0 && a.u < 1 && a.v >= 0 && a.v < 1);
    EXPECT_EQ(a.u, b.u);
  }
}

}  // namespace
}  // namespace mpm
