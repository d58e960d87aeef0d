#include <gtest/gtest.h>

#include <random>

#include "mpm/contact/clearance_bound.h"
#include "mpm/gouge/certify_pose.h"
#include "mpm/gouge/clearance_sampler.h"
#include "surface/random_surface.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kTolerance = 1e-3;  // mm

ToolPose leaning(const Vec3& tip, double tilt, double azimuth, const Tool& tool) {
  const Vec3 axis(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
  return ToolPose::from_tip(tool, tip, axis);
}

// No pose, however it stands, may have a sampled clearance below the proven one.
void expect_sound(const SurfaceModel& model, const Tool& tool, const std::vector<ToolPose>& poses) {
  const CellTree tree(model, tool.radius() / 12);
  const ClearanceSampler sampler(model, tool);
  int proven = 0;
  for (const ToolPose& pose : poses) {
    const double found = sampler(pose, tool.radius()).distance;
    const PoseCertificate c = certify_pose(tree, tool, pose, {});
    EXPECT_GE(found, c.lo) << pose.torus_center.transpose();
    EXPECT_LE(c.lo, c.hi);
    if (c.verdict == Verdict::free) {
      EXPECT_GE(found, -kTolerance);
    }
    if (c.verdict == Verdict::gouge) {
      EXPECT_LT(signed_distance(tool, pose, c.witness.s), -kTolerance);
    }
    if (found < -2 * kTolerance) {
      EXPECT_NE(c.verdict, Verdict::free);
    }
    proven += c.verdict == Verdict::free;
  }
  EXPECT_GT(proven, 0);
  EXPECT_LT(proven, int(poses.size()));
}

std::vector<ToolPose> random_poses(const Tool& tool, const Vec3& lo, const Vec3& hi, int count) {
  std::mt19937 engine(11);
  const auto pick = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
  std::vector<ToolPose> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(leaning(Vec3(pick(lo.x(), hi.x()), pick(lo.y(), hi.y()), pick(lo.z(), hi.z())),
                            pick(0, 0.8),
                            pick(0, 2 * kPi),
                            tool));
  return poses;
}

TEST(CertifyPose, AgreesWithSamplingOnTheThesisSurfaces) {
  const Tool tool{6.7, 6.0, 2.0, 30.0, {{12.7, 12.7, 20}, {25, 30, 40}}};
  for (auto which : {testing::Thesis::convex, testing::Thesis::concave, testing::Thesis::saddle})
    expect_sound(testing::thesis_model(which), tool, random_poses(tool, {0, 0, 60}, {150, 150, 110}, 60));
}

TEST(CertifyPose, AgreesWithSamplingOnRationalFolds) {
  for (unsigned seed : {1u, 2u, 3u}) {
    testing::SurfaceMaker make{seed};
    const SurfaceModel model = testing::one_face(make.data(3, 4, true, true).surface());
    const double size = model.bounds().diagonal();
    const Tool tool{size / 20, size / 25, size / 50, size / 6, {}};
    const CellTree tree(model, tool.radius() / 12);
    const ClearanceSampler sampler(model, tool);
    for (const ToolPose& pose : random_poses(tool, model.bounds().lo, model.bounds().hi, 40))
      EXPECT_GE(sampler(pose, tool.radius()).distance, certify_pose(tree, tool, pose, {}).lo);
  }
}

TEST(CertifyPose, AToolStandingOnAPlaneIsFreeByNothing) {
  const SurfaceModel model = testing::inclined_plane(0);
  const Tool tool = testing::thesis_tool();
  const CellTree tree(model, 1.0);
  const PoseCertificate c = certify_pose(tree, tool, leaning(Vec3(50, 50, 0), 0, 0, tool), {});
  EXPECT_EQ(c.verdict, Verdict::free);
  EXPECT_GE(c.lo, -kTolerance);
  EXPECT_NEAR(c.hi, 0.0, 0.1);
  EXPECT_EQ(certify_pose(tree, tool, leaning(Vec3(50, 50, -0.002), 0, 0, tool), {}).verdict, Verdict::gouge);
}

TEST(CertifyPose, AHolderThatHitsIsAGouge) {
  const SurfaceModel model = testing::inclined_plane(1.0);
  const Tool slim{0, 2, 2, 10, {}};
  Tool fat = slim;
  fat.segments = {{20, 20, 30}};
  // A ball on the 45 degree slope clears it with its shank, not with a holder as wide as this.
  const double lift = slim.minor_radius * (std::sqrt(2.0) - 1);
  const ToolPose pose = leaning(Vec3(50, 50, 50 + lift), 0, 0, slim);
  EXPECT_EQ(certify_pose(CellTree(model, 0.5), slim, pose, {}).verdict, Verdict::free);
  EXPECT_EQ(certify_pose(CellTree(model, 0.5), fat, pose, {}).verdict, Verdict::gouge);
}

TEST(CertifyPose, WhatIsTrimmedAwayIsNoSurface) {
  // The plane without the square [40, 60]^2 (in per cent of its sides): a small tool may reach through the
  // hole.
  const std::vector<double> knots{0, 0, 1, 1};
  const std::vector<Vec3> poles{Vec3(0, 0, 0), Vec3(0, 100, 0), Vec3(100, 0, 0), Vec3(100, 100, 0)};
  const TrimRegion hole({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}}});
  const SurfaceModel model = testing::one_face(BSplineSurface(1, 1, knots, knots, poles), hole);
  const Tool tool{2, 2, 2, 20, {}};
  const CellTree tree(model, 1.0);
  EXPECT_EQ(certify_pose(tree, tool, leaning(Vec3(50, 50, -5), 0, 0, tool), {}).verdict, Verdict::free);
  EXPECT_EQ(certify_pose(tree, tool, leaning(Vec3(43, 50, -5), 0, 0, tool), {}).verdict, Verdict::gouge);
}

TEST(CertifyPose, AnExhaustedBudgetIsUndecidedNotFree) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::concave);
  const Tool tool = testing::thesis_tool();
  CertifyPoseOptions options;
  options.budget = 20;
  const PoseCertificate c =
      certify_pose(CellTree(model, 1.0), tool, leaning(Vec3(75, 75, 62.6), 0, 0, tool), options);
  EXPECT_EQ(c.verdict, Verdict::undecided);
  EXPECT_EQ(c.lo, -kInfinity);
}

// A small patch that the ring, taken as a whole, touches on its inner side, where the flat bottom is 0.03 mm
// lower: a cell that the ring proves is not done with before the rest of the body proves it too, whatever is
// searched in it.
TEST(CertifyPose, ACellThatIsSearchedForARingContactIsProvenAgainstTheBottomToo) {
  const Tool tool{6.7, 6.0, 0, 40, {}};
  const double slope = 0.1, half = 0.4, bend = 0.05;
  const Vec3 normal(std::sin(slope), 0, std::cos(slope)), along(std::cos(slope), 0, -std::sin(slope));
  const Vec3 touch = Vec3(tool.major_radius, 0, 0) - tool.minor_radius * normal;
  std::vector<Vec3> poles;
  for (double a : {-half, half})
    for (int j : {-1, 0, 1})
      poles.push_back(touch + a * along + Vec3(0, j * half, 0) +
                      (j == 0 ? bend : -bend) * half * half * normal);
  const SurfaceModel model = testing::one_face(BSplineSurface(1, 2, {0, 0, 1, 1}, {0, 0, 0, 1, 1, 1}, poles));
  const ToolPose pose{Vec3::Zero(), Vec3::UnitZ()};
  ASSERT_LT(signed_distance(tool, pose, touch), -0.02);
  CertifyPoseOptions options;
  options.sharpness = 1e-9, options.sharp_budget = 4000;
  EXPECT_EQ(certify_pose(CellTree(model, 2.0), tool, pose, options).verdict, Verdict::gouge);
}

TEST(LeastQuadratic, IsTheMinimumOverTheSquare) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> pick(-1, 1);
  for (int k = 0; k < 500; ++k) {
    const double f = pick(engine), g1 = pick(engine), g2 = pick(engine);
    const double h11 = pick(engine), h12 = pick(engine), h22 = pick(engine);
    double least = kInfinity;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 40; ++j) {
        const double a = -1 + i / 20.0, b = -1 + j / 20.0;
        least = std::min(least, f + g1 * a + g2 * b + h11 * a * a + h12 * a * b + h22 * b * b);
      }
    const double bound = least_quadratic(f, g1, g2, h11, h12, h22);
    EXPECT_LE(bound, least + 1e-12);
    EXPECT_GT(bound, least - 0.01);
  }
}

}  // namespace
}  // namespace mpm
