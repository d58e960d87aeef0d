#include <gtest/gtest.h>

#include <random>

#include "mpm/gouge/clearance_sampler.h"
#include "thesis.h"

namespace mpm {
namespace {

using testing::thesis_model;
using testing::thesis_tool;

constexpr int kLooks = 600;       // along each side of the surface
constexpr double kBetween = 0.3;  // mm, between two looks: what a look may miss

// Every sample of the surface, `n` by `n`.
double brute_force(const SurfaceModel& model, const Tool& tool, const ToolPose& pose, int n) {
  double least = kInfinity;
  const BSplineSurface& surface = model.faces()[0].surface;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      least = std::min(least, signed_distance(tool, pose, surface.point(double(i) / n, double(j) / n)));
  return least;
}

std::vector<ToolPose> poses_near(const SurfaceModel& model, const Tool& tool, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(0.05, 0.95), lean(-0.5, 0.5), height(-0.5, 3);
  std::vector<ToolPose> poses;
  for (int i = 0; i < count; ++i) {
    const Vec3 axis = Vec3(lean(random), lean(random), 1).normalized();
    const Vec3 point = model.faces()[0].surface.point(at(random), at(random));
    poses.push_back(ToolPose::from_tip(tool, point + height(random) * axis, axis));
  }
  return poses;
}

class Sampler : public ::testing::TestWithParam<testing::Thesis> {};

TEST_P(Sampler, FindsWhatBruteForceFinds) {
  const SurfaceModel model = thesis_model(GetParam());
  const Tool tool = thesis_tool();
  const ClearanceSampler sampler(model, tool);
  for (const ToolPose& pose : poses_near(model, tool, 60)) {
    const double dense = brute_force(model, tool, pose, kLooks), range = tool.radius();
    const SampledClearance found = sampler(pose, range);
    EXPECT_LE(found.distance, std::min(dense + 1e-3, range));
    EXPECT_GE(found.distance, std::min(dense - kBetween, range));
    if (found.distance == range) continue;
    EXPECT_NEAR(signed_distance(tool, pose, found.witness), found.distance, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Thesis,
                         Sampler,
                         ::testing::Values(testing::Thesis::convex,
                                           testing::Thesis::concave,
                                           testing::Thesis::saddle));

// Half of the face is trimmed away: a tile whose middle is gone must not stand for one that is there.
TEST(ClearanceSampler, LeavesOutWhatIsTrimmedAway) {
  const Tool tool = thesis_tool();
  const SurfaceModel model =
      testing::one_face(testing::bicubic(testing::kThesisHeights[0]),
                        TrimRegion({{{0.0, 0.0}, {0.503, 0.0}, {0.503, 1.0}, {0.0, 1.0}}}));
  const ClearanceSampler sampler(model, tool);
  const BSplineSurface& surface = model.faces()[0].surface;
  for (const double beside : {2.0, 6.0, 10.0}) {
    const Vec3 border = surface.point(0.503, 0.4);
    const ToolPose pose = ToolPose::from_tip(tool, border + Vec3(beside, 0, -3), Vec3::UnitZ());
    double least = kInfinity;
    for (int i = 0; i <= 1000; ++i)
      for (int j = 0; j <= 1000; ++j)
        least = std::min(least, signed_distance(tool, pose, surface.point(0.503 * i / 1000, j / 1000.0)));
    EXPECT_NEAR(sampler(pose, tool.radius()).distance, least, 5e-3) << beside;
  }
}

TEST(ClearanceSampler, CountsWhatIsFarAsRangeAway) {
  const SurfaceModel model = thesis_model(testing::Thesis::saddle);
  const Tool tool = thesis_tool();
  const ToolPose high = ToolPose::from_tip(tool, {75, 75, 200}, Vec3::UnitZ());
  EXPECT_EQ(ClearanceSampler(model, tool)(high, 5.0).distance, 5.0);
}

}  // namespace
}  // namespace mpm
