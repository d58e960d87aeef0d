#include <gtest/gtest.h>

#include "mpm/positioning/tool_shadow.h"
#include "thesis.h"

namespace mpm {
namespace {

// A level rectangle [x0, x1] x [0, 100] at height z.
Face level(double x0, double x1, double z) {
  const std::vector<double> knots{0, 0, 1, 1};
  return {"Face",
          BSplineSurface(
              1, 1, knots, knots, {Vec3(x0, 0, z), Vec3(x0, 100, z), Vec3(x1, 0, z), Vec3(x1, 100, z)}),
          {},
          false};
}

SurfaceModel terraces(double step) {
  std::vector<Face> faces;
  faces.push_back(level(0, 50, 0)), faces.push_back(level(50, 100, step));
  return SurfaceModel(std::move(faces));
}

std::vector<std::uint32_t> faces_under(const SurfaceModel& model, const Vec2& at) {
  const Tool tool = testing::thesis_tool();
  const FootprintLocator locator(model, tool.radius() / 2);
  std::vector<std::uint32_t> found;
  for (const Seed& seed : seeds_under_tool(locator, tool, at)) {
    found.push_back(seed.face);
    EXPECT_LT((seed.s.head<2>() - at).norm(), tool.radius() + locator.spacing());
  }
  return found;
}

TEST(ToolShadow, OneSeedAFaceInOrder) {
  const SurfaceModel model = terraces(5);
  EXPECT_EQ(faces_under(model, {49, 50}), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(faces_under(model, {20, 50}), (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(faces_under(model, {300, 50}).empty());
}

TEST(ToolShadow, ASheetFarBelowIsAnother) {
  EXPECT_EQ(faces_under(terraces(100), {49, 50}), (std::vector<std::uint32_t>{1}));
}

TEST(ToolShadow, TheSeedIsTheNearestSample) {
  const SurfaceModel model = terraces(5);
  const Tool tool = testing::thesis_tool();
  const FootprintLocator locator(model, tool.radius() / 2);
  const Vec2 at(30.3, 41.7);
  const std::vector<Seed> seeds = seeds_under_tool(locator, tool, at);
  ASSERT_EQ(seeds.size(), 1u);
  double least = kInfinity;
  locator.visit_near(at, tool.radius(), [&](const Seed& s) {
    if (s.face == 0) least = std::min(least, (s.s.head<2>() - at).norm());
  });
  EXPECT_EQ((seeds[0].s.head<2>() - at).norm(), least);
}

}  // namespace
}  // namespace mpm
