#include <gtest/gtest.h>

#include <random>

#include "mpm/base/pose_motion.h"
#include "mpm/contact/motion_bound.h"
#include "mpm/gouge/certify_motion.h"
#include "mpm/gouge/clearance_sampler.h"
#include "mpm/gouge/judge_cells.h"
#include "surface/random_surface.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kTolerance = 0.01;  // mm
constexpr double kTiny = 1e-9;       // mm, rounding

struct Move {
  TipPose from, to;
};

Vec3 direction(double tilt, double azimuth) {
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

MotionCertificate certify(const SurfaceModel& model,
                          const Tool& tool,
                          const Move& move,
                          const CertifyMotionOptions& options = {}) {
  const CellTree tree = judge_cells(model, tool);
  return certify_motion(tree,
                        tool,
                        ToolPose::from_tip(tool, move.from.tip, move.from.axis),
                        ToolPose::from_tip(tool, move.to.tip, move.to.axis),
                        options,
                        Context{});
}

std::vector<Move> random_moves(const Vec3& lo, const Vec3& hi, double step, double turn, int count) {
  std::mt19937 engine(17);
  const auto pick = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
  std::vector<Move> moves;
  for (int i = 0; i < count; ++i) {
    const Vec3 tip(pick(lo.x(), hi.x()), pick(lo.y(), hi.y()), pick(lo.z(), hi.z()));
    const Vec3 axis = direction(pick(0, 0.8), pick(0, 2 * kPi));
    const Vec3 by(pick(-step, step), pick(-step, step), pick(-step, step));
    const Vec3 side = Vec3(pick(-1, 1), pick(-1, 1), pick(-1, 1)).normalized();
    moves.push_back({{tip, axis}, {tip + by, (axis + turn * pick(0, 1) * side).normalized()}});
  }
  return moves;
}

// The least clearance at poses close together, the real axis being off the great circle by up to `deviation`
// in directions all round.
double sampled(const ClearanceSampler& sampler, const Tool& tool, const Move& move, double deviation) {
  constexpr int kTimes = 8, kLeans = 3;
  double least = kInfinity;
  for (int k = 0; k <= kTimes; ++k) {
    const TipPose at = pose_between(move.from, move.to, double(k) / kTimes);
    const Vec3 u = at.axis.unitOrthogonal(), v = at.axis.cross(u);
    for (int j = 0; j < (deviation > 0 ? kLeans : 1); ++j) {
      const double a = 2 * kPi * j / kLeans;
      const Vec3 lean =
          std::cos(deviation) * at.axis + std::sin(deviation) * (std::cos(a) * u + std::sin(a) * v);
      least = std::min(least, sampler(ToolPose::from_tip(tool, at.tip, lean), tool.radius()).distance);
    }
  }
  return least;
}

// No motion may be sampled below what was proven; returns how many were proven free.
int expect_sound(const SurfaceModel& model,
                 const Tool& tool,
                 const std::vector<Move>& moves,
                 double deviation) {
  const ClearanceSampler sampler(model, tool);
  CertifyMotionOptions options;
  options.axis_deviation = deviation;
  int proven = 0;
  for (const Move& move : moves) {
    const MotionCertificate c = certify(model, tool, move, options);
    const double found = sampled(sampler, tool, move, deviation);
    EXPECT_GE(found, c.lo - kTiny);
    EXPECT_LE(c.lo, c.hi);
    if (c.verdict == Verdict::gouge) {
      const TipPose at = pose_between(move.from, move.to, c.time);
      const double there = signed_distance(tool, ToolPose::from_tip(tool, at.tip, at.axis), c.s);
      EXPECT_LT(there, -kTolerance);
      EXPECT_LE(there, c.hi + kTiny);
    }
    EXPECT_FALSE(found < -kTolerance && c.verdict == Verdict::free);
    proven += c.verdict == Verdict::free;
  }
  return proven;
}

TEST(CertifyMotion, AgreesWithSamplingOnTheThesisSurfaces) {
  const Tool tool{6.7, 6.0, 2.0, 30.0, {{12.7, 12.7, 20}, {25, 30, 40}}};
  for (auto which : {testing::Thesis::convex, testing::Thesis::concave, testing::Thesis::saddle}) {
    const auto moves = random_moves({0, 0, 60}, {150, 150, 110}, 3, 0.1, 10);
    for (double deviation : {0.0, 0.002}) {
      const int proven = expect_sound(testing::thesis_model(which), tool, moves, deviation);
      EXPECT_GT(proven, 0);
      EXPECT_LT(proven, 10);
    }
  }
}

TEST(CertifyMotion, LongMovesAndWideTurnsAreProvenToo) {
  const Tool tool{6.7, 6.0, 2.0, 30.0, {{12.7, 12.7, 20}, {25, 30, 40}}};
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  EXPECT_GT(expect_sound(model, tool, random_moves({0, 0, 80}, {150, 150, 160}, 40, 1.5, 12), 0.0), 0);
}

TEST(CertifyMotion, AgreesWithSamplingOnRationalFolds) {
  for (unsigned seed : {1u, 2u, 3u}) {
    testing::SurfaceMaker make{seed};
    const SurfaceModel model = testing::one_face(make.data(3, 4, true, true).surface());
    const double size = model.bounds().diagonal();
    const Tool tool{size / 20, size / 25, size / 50, size / 6, {}};
    expect_sound(model, tool, random_moves(model.bounds().lo, model.bounds().hi, size / 30, 0.2, 10), 0.001);
  }
}

// Over a plane the least height of the tool is that of one of the two ends for an axis that does not turn.
TEST(CertifyMotion, ATipThatSinksIntoAPlaneIsMeasuredAtItsEnd) {
  const SurfaceModel model = testing::inclined_plane(0);
  const Tool tool = testing::thesis_tool();
  const Vec3 up = Vec3::UnitZ();
  const MotionCertificate good = certify(model, tool, {{{50, 50, 1}, up}, {{53, 51, -0.009}, up}});
  EXPECT_EQ(good.verdict, Verdict::free);
  EXPECT_LE(good.lo, -0.009 + kTiny);
  EXPECT_GE(good.lo, -kTolerance);
  EXPECT_EQ(certify(model, tool, {{{50, 50, 1}, up}, {{53, 51, -0.011}, up}}).verdict, Verdict::gouge);
}

TEST(CertifyMotion, ANegativeToleranceAsksForClearance) {
  const SurfaceModel model = testing::inclined_plane(0);
  const Vec3 up = Vec3::UnitZ();
  const Move move{{{50, 50, 1}, up}, {{60, 51, 2}, up}};
  CertifyMotionOptions options;
  options.tolerance = -0.99;
  const MotionCertificate clear = certify(model, testing::thesis_tool(), move, options);
  EXPECT_EQ(clear.verdict, Verdict::free);
  EXPECT_GE(clear.lo, 0.99);
  EXPECT_LE(clear.lo, 1 + kTiny);
  options.tolerance = -1.01;
  EXPECT_NE(certify(model, testing::thesis_tool(), move, options).verdict, Verdict::free);
}

TEST(CertifyMotion, AboveEverythingItTakesNoCell) {
  const SurfaceModel model = testing::inclined_plane(0);
  const Tool tool = testing::thesis_tool();
  const double reach = tool.radius() * std::sin(0.5);  // below the tip when it leans
  const Move high{{{50, 50, reach + 1}, Vec3::UnitZ()}, {{90, 50, reach + 1}, direction(0.4, 1)}};
  const MotionCertificate c = certify(model, tool, high);
  EXPECT_EQ(c.verdict, Verdict::free);
  EXPECT_EQ(c.cells, 0u);
  EXPECT_EQ(c.lo, 0);
  const Move low{{{50, 50, 0.1}, Vec3::UnitZ()}, {{90, 50, 0.1}, direction(0.4, 1)}};
  EXPECT_EQ(certify(model, tool, low).verdict, Verdict::gouge);
}

// A tool that rocks through the upright from one side to the other: with the torus centre at height
// Ri cos(angle) + h the ring's lowest point is at h + Ri cos - Ri - Ro |sin|; here the ends just touch.
TEST(CertifyMotion, ARockingToolIsDeepestWhereTheClosedFormSays) {
  const SurfaceModel model = testing::inclined_plane(0);
  const Tool tool = testing::thesis_tool();
  const double angle = 0.05;
  const auto height = [&](double tilt) {  // of the tip over a plane that the ring touches
    return tool.minor_radius * (1 - std::cos(tilt)) + tool.major_radius * std::abs(std::sin(tilt));
  };
  // The tip stays at the height where the ends touch; in between the tool is higher by height(angle) -
  // height(t).
  const double z = height(angle);
  const Move move{{{50, 50, z}, direction(angle, 0)}, {{50, 50, z}, direction(angle, kPi)}};
  EXPECT_EQ(certify(model, tool, move).verdict, Verdict::free);
  const Move low{{{50, 50, z - 0.012}, move.from.axis}, {{50, 50, z - 0.012}, move.to.axis}};
  const MotionCertificate gouge = certify(model, tool, low);
  EXPECT_EQ(gouge.verdict, Verdict::gouge);
  EXPECT_TRUE(gouge.time < 0.1 || gouge.time > 0.9) << gouge.time;
}

// A ball that runs along the chord of two touching positions cuts into a convex crown by the sagitta.
TEST(CertifyMotion, TheSagittaOfAChordDecides) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::convex);
  const Tool ball{0, 6, 6, 40, {}};
  const ClearanceSampler sampler(model, ball);
  const auto touching = [&](double x) {  // the tip's height by bisection, upright
    double low = 60, high = 120;
    for (int k = 0; k < 60; ++k) {
      const double z = 0.5 * (low + high);
      (sampler(ToolPose::from_tip(ball, {x, 75, z}, Vec3::UnitZ()), 6).distance < 0 ? low : high) = z;
    }
    return TipPose{{x, 75, high}, Vec3::UnitZ()};
  };
  int free = 0, gouging = 0;
  for (double step : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    const Move move{touching(75 - step / 2), touching(75 + step / 2)};
    const double middle = move.from.tip.z() - touching(75).tip.z();  // minus the sagitta
    const MotionCertificate c = certify(model, ball, move);
    EXPECT_EQ(c.verdict, middle >= -kTolerance ? Verdict::free : Verdict::gouge) << step << ' ' << middle;
    (c.verdict == Verdict::free ? free : gouging) += 1;
  }
  EXPECT_GT(free, 0);
  EXPECT_GT(gouging, 0);
}

// An eighth of a sphere about the origin, rational biquadratic, as a surface of revolution.
SurfaceModel sphere_octant(double radius) {
  const double w = std::sqrt(0.5), r = radius;
  const std::vector<double> knots{0, 0, 0, 1, 1, 1};
  const std::vector<Vec3> poles{
      {r, 0, 0}, {r, r, 0}, {0, r, 0}, {r, 0, r}, {r, r, r}, {0, r, r}, {0, 0, r}, {0, 0, r}, {0, 0, r}};
  return testing::one_face(BSplineSurface(2, 2, knots, knots, poles, {1, w, 1, w, w * w, w, 1, w, 1}));
}

// The clearance of a ball that passes a sphere is the distance of the sphere's centre from its line, less the
// radii, whatever its axis does meanwhile.
TEST(CertifyMotion, ABallOverASphereHasTheClosedForm) {
  const double sphere = 80;
  const SurfaceModel model = sphere_octant(sphere);
  const Tool ball{0, 6, 6, 40, {}};
  const Vec3 out = Vec3(1, 1, 1).normalized(), along = Vec3(1, -1, 0).normalized();
  for (double least : {-0.0105, -0.0095, -0.005, 0.3})
    for (double turn : {0.0, 0.1, 0.6}) {
      const Vec3 middle = (sphere + ball.minor_radius + least) * out;
      const Vec3 axis_to = (Vec3::UnitZ() + turn * out).normalized();
      const ToolPose from{middle - 2 * along, Vec3::UnitZ()}, to{middle + 2 * along, axis_to};
      // The tip runs straight, not the centre: without a turn both do.
      const CellTree tree(model, 1.0);
      const MotionCertificate c = certify_motion(tree, ball, from, to, {}, Context{});
      if (turn > 0) {
        double met = kInfinity;
        for (int k = 0; k <= 1000; ++k) {
          const TipPose at = pose_between({from.tip(ball), from.axis}, {to.tip(ball), to.axis}, k / 1000.0);
          met = std::min(met, (at.tip + ball.minor_radius * at.axis).norm() - sphere - ball.minor_radius);
        }
        EXPECT_EQ(c.verdict, met < -kTolerance ? Verdict::gouge : Verdict::free) << met;
        EXPECT_LE(c.lo, met + kTiny);
      } else {
        EXPECT_EQ(c.verdict, least < -kTolerance ? Verdict::gouge : Verdict::free);
        EXPECT_LE(c.lo, least + kTiny);
        EXPECT_GE(c.hi, least - kTiny);
      }
    }
}

// Moves pressed into the surface until the sampled depth is just within, then just beyond the tolerance: the
// proof must give way between the two.
TEST(CertifyMotion, ADepthJustBeyondTheToleranceIsNeverFree) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const Tool tool{6.7, 6.0, 2.0, 30.0, {{12.7, 12.7, 20}}};
  const ClearanceSampler sampler(model, tool);
  int proven = 0;
  for (Move move : random_moves({20, 20, 95}, {130, 130, 100}, 1.5, 0.03, 6)) {
    const auto press_to = [&](double depth) {
      double found = kInfinity;
      for (int k = 0; k < 5; ++k) {
        found = sampled(sampler, tool, move, 0);
        const double by = std::min(found, tool.radius()) + depth;
        move.from.tip.z() -= by, move.to.tip.z() -= by;
      }
      return sampled(sampler, tool, move, 0);
    };
    const double within = press_to(0.009);
    const MotionCertificate good = certify(model, tool, move);
    EXPECT_LE(good.lo, within + kTiny);
    proven += good.verdict == Verdict::free;
    const double beyond = press_to(0.0101);
    EXPECT_LT(beyond, -kTolerance);
    EXPECT_EQ(certify(model, tool, move).verdict, Verdict::gouge);
  }
  EXPECT_GT(proven, 3);
}

TEST(CertifyMotion, OppositeAxesAreUndecided) {
  const SurfaceModel model = testing::inclined_plane(0);
  const Move move{{{50, 50, 200}, Vec3::UnitZ()}, {{50, 50, 200}, -Vec3::UnitZ()}};
  EXPECT_EQ(certify(model, testing::thesis_tool(), move).verdict, Verdict::undecided);
}

TEST(CertifyMotion, AThinWallBetweenTwoFreePosesIsFound) {
  // The ends are 20 mm clear of a wall that stands across the way.
  const std::vector<double> knots{0, 0, 1, 1};
  const SurfaceModel wall = testing::one_face(BSplineSurface(
      1, 1, knots, knots, {Vec3(50, 0, 0), Vec3(50, 100, 0), Vec3(50, 0, 1), Vec3(50, 100, 1)}));
  const Tool tool{2, 2, 2, 20, {}};
  const Vec3 up = Vec3::UnitZ();
  EXPECT_EQ(certify(wall, tool, {{{26, 50, 0.5}, up}, {{74, 50, 0.5}, up}}).verdict, Verdict::gouge);
  EXPECT_EQ(certify(wall, tool, {{{26, 50, 1.0}, up}, {{74, 50, 1.0}, up}}).verdict, Verdict::free);
}

TEST(CertifyMotion, WhatIsTrimmedAwayIsNoSurface) {
  const std::vector<double> knots{0, 0, 1, 1};
  const TrimRegion hole({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}}});
  const SurfaceModel model = testing::one_face(
      BSplineSurface(
          1, 1, knots, knots, {Vec3(0, 0, 0), Vec3(0, 100, 0), Vec3(100, 0, 0), Vec3(100, 100, 0)}),
      hole);
  const Tool tool{2, 2, 2, 20, {}};
  const Vec3 up = Vec3::UnitZ();
  EXPECT_EQ(certify(model, tool, {{{47, 50, -5}, up}, {{53, 50, -5}, up}}).verdict, Verdict::free);
  EXPECT_EQ(certify(model, tool, {{{47, 50, -5}, up}, {{57, 50, -5}, up}}).verdict, Verdict::gouge);
}

TEST(CertifyMotion, TheDeviationIsTakenOffByTheLever) {
  // The holder's rim at 1 mm from a wall, 60 mm above the tip: 0.01 radians move it by 0.6 mm, 0.02 by 1.2
  // mm.
  const std::vector<double> knots{0, 0, 1, 1};
  const SurfaceModel wall = testing::one_face(
      BSplineSurface(1, 1, knots, knots, {Vec3(0, 0, 0), Vec3(0, 100, 0), Vec3(0, 0, 60), Vec3(0, 100, 60)}));
  const Tool tool{2, 2, 2, 30, {{10, 10, 30}}};
  const Vec3 up = Vec3::UnitZ();
  const Move move{{{11, 40, 0}, up}, {{11, 42, 0}, up}};
  CertifyMotionOptions options;
  options.axis_deviation = 0.01;
  EXPECT_EQ(certify(wall, tool, move, options).verdict, Verdict::free);
  options.axis_deviation = 0.02;
  EXPECT_EQ(certify(wall, tool, move, options).verdict, Verdict::undecided);
}

TEST(CertifyMotion, AnExhaustedBudgetAndACancelAreUndecidedNotFree) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::concave);
  const Tool tool = testing::thesis_tool();
  const Move move{{{75, 75, 62.6}, Vec3::UnitZ()}, {{77, 75, 62.6}, Vec3::UnitZ()}};
  CertifyMotionOptions options;
  options.budget = 5;
  const MotionCertificate c = certify(model, tool, move, options);
  EXPECT_EQ(c.verdict, Verdict::undecided);
  EXPECT_EQ(c.lo, -kInfinity);
  Context cancelled;
  cancelled.cancel();
  const ToolPose pose = ToolPose::from_tip(tool, {75, 75, 200}, Vec3::UnitZ());
  const auto none = certify_motions(judge_cells(model, tool), tool, {{pose, pose, {}}}, cancelled);
  EXPECT_EQ(none.at(0).verdict, Verdict::undecided);
}

TEST(LeastQuadratic3, IsTheMinimumOverTheCube) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> pick(-1, 1);
  int convex = 0;
  for (int k = 0; k < 400; ++k) {
    Quadratic3 q;
    q.f = pick(engine);
    for (double& g : q.g) g = pick(engine);
    for (double& h : q.h) h = pick(engine);
    if (k % 2) q.h[0] += 1, q.h[2] += 1, q.h[5] += 1;  // mostly convex
    const auto value = [&](double a, double b, double t) {
      return q.f + q.g[0] * a + q.g[1] * b + q.g[2] * t + q.h[0] * a * a + q.h[1] * a * b + q.h[2] * b * b +
             q.h[3] * a * t + q.h[4] * b * t + q.h[5] * t * t;
    };
    double least = kInfinity;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20; ++j)
        for (int l = 0; l <= 20; ++l)
          least = std::min(least, value(i / 10.0 - 1, j / 10.0 - 1, l / 10.0 - 1));
    const double bound = least_quadratic(q);
    EXPECT_LE(bound, least + 1e-12);
    EXPECT_GT(bound, least - 0.05);
    convex += q.h[0] > 0;
  }
  EXPECT_GT(convex, 100);
}

// Flat valleys, where the critical point is known to few digits or not at all.
TEST(LeastQuadratic3, ASingularOneIsNotOverestimated) {
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> pick(-1, 1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 u(pick(engine), pick(engine), pick(engine)), v(pick(engine), pick(engine), pick(engine));
    const Vec3 x(
        pick(engine), pick(engine), pick(engine));  // a minimum: q = (u (y-x))^2 + (v (y-x))^2 + e |y-x|^2
    const double e = k % 3 == 0 ? 0.0 : std::pow(10.0, -4 - k % 13);
    const Mat3 h = u * u.transpose() + v * v.transpose() + e * Mat3::Identity();
    const Vec3 g = -2 * h * x;
    const Quadratic3 q{x.dot(h * x),
                       {g.x(), g.y(), g.z()},
                       {h(0, 0), 2 * h(0, 1), h(1, 1), 2 * h(0, 2), 2 * h(1, 2), h(2, 2)}};
    const double bound = least_quadratic(q);
    EXPECT_LE(bound, 1e-13);
    EXPECT_GT(bound, -1e-6);
  }
}

}  // namespace
}  // namespace mpm
