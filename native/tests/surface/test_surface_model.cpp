#include <gtest/gtest.h>

#include "mpm/surface/surface_model.h"
#include "surface/random_surface.h"

namespace mpm {
namespace {

using testing::SurfaceData;
using testing::SurfaceMaker;

// z = 80 - (u^2 + v^2) / 100 over u, v in [-50, 50]: top 80 in the middle, where the control points reach
// higher.
BSplineSurface dome() {
  std::vector<Vec3> poles;
  for (double x : {-50.0, 0.0, 50.0})
    for (double y : {-50.0, 0.0, 50.0})
      poles.emplace_back(x, y, 80 - ((x == 0 ? -2500 : 2500) + (y == 0 ? -2500 : 2500)) / 100.0);
  return {2, 2, {-50, -50, -50, 50, 50, 50}, {-50, -50, -50, 50, 50, 50}, poles};
}

std::vector<Vec2> circle(const Vec2& center, double radius) {
  std::vector<Vec2> loop;
  for (int i = 0; i < 720; ++i)
    loop.push_back(center + radius * Vec2(std::cos(kPi * i / 360), std::sin(kPi * i / 360)));
  return loop;
}

TEST(SurfaceModel, MachinedBoundsAreTight) {
  const SurfaceModel model({{"dome", dome(), {}, false}});
  EXPECT_EQ(model.machined_bounds().lo, Vec3(-50, -50, 30));
  EXPECT_EQ(model.machined_bounds().hi.head<2>(), Vec2(50, 50));
  EXPECT_NEAR(model.machined_bounds().hi.z(), 80.0, 1e-6);
  EXPECT_GT(model.bounds().hi.z(), 100.0);  // the control points
}

TEST(SurfaceModel, MachinedBoundsRespectTheTrim) {
  const SurfaceModel model({{"dome", dome(), TrimRegion({circle({10, 5}, 30)}), false}});
  const Box3 box = model.machined_bounds();
  const double far = Vec2(10, 5).norm() + 30;  // the trimmed disc's point that is farthest from the top
  EXPECT_NEAR(box.lo.x(), -20, 1e-2);
  EXPECT_NEAR(box.hi.x(), 40, 1e-2);
  EXPECT_NEAR(box.lo.y(), -25, 1e-2);
  EXPECT_NEAR(box.hi.y(), 35, 1e-2);
  EXPECT_NEAR(box.lo.z(), 80 - far * far / 100, 1e-2);
  EXPECT_NEAR(box.hi.z(), 80, 1e-6);
}

TEST(SurfaceModel, AHoleLowersTheTop) {
  const TrimRegion with_hole({{{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}, circle({0, 0}, 20)});
  const Box3 box = SurfaceModel({{"dome", dome(), with_hole, false}}).machined_bounds();
  EXPECT_NEAR(box.hi.z(), 76, 1e-3);
  EXPECT_EQ(box.lo, Vec3(-50, -50, 30));
}

TEST(SurfaceModel, MachinedBoundsContainAnySurface) {
  SurfaceMaker make{5};
  for (int degree = 1; degree <= 10; degree += 3) {
    const BSplineSurface s = make.data(degree, 3, true, true).surface();
    const Box3 box = SurfaceModel({{"any", s, {}, false}}).machined_bounds();
    Box3 sampled;
    for (const BezierPatch& patch : s.patches()) {
      const ParamBox& b = patch.box();
      for (int i = 0; i <= 60; ++i)
        for (int j = 0; j <= 60; ++j)
          sampled.extend(patch.point(b.u0 + i / 60.0 * (b.u1 - b.u0), b.v0 + j / 60.0 * (b.v1 - b.v0)));
    }
    const double size = sampled.diagonal();
    EXPECT_TRUE(((box.lo - sampled.lo).array() <= 1e-9 * size).all());
    EXPECT_TRUE(((sampled.hi - box.hi).array() <= 1e-9 * size).all());
    EXPECT_LE((box.hi - sampled.hi).maxCoeff(), 1e-3 * size);  // the sampling's own error
    EXPECT_LE((sampled.lo - box.lo).maxCoeff(), 1e-3 * size);
  }
}

TEST(SurfaceModel, CheckFacesDoNotWidenTheMachinedBounds) {
  SurfaceData big{
      1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {{-900, -900, 0}, {-900, 900, 0}, {900, -900, 0}, {900, 900, 0}}, {}};
  const SurfaceModel model({{"dome", dome(), {}, false}, {"table", big.surface(), {}, true}});
  EXPECT_EQ(model.machined_bounds().hi.x(), 50);
  EXPECT_EQ(model.bounds().hi.x(), 900);
}

TEST(SurfaceModel, LeavesOutPatchesOutsideTheTrim) {
  const SurfaceData d = SurfaceMaker(9).data(2, 2, false, true);
  const BSplineSurface s = d.surface();
  const ParamBox first = s.patches()[0].box();
  const double u = first.u_mid(), v = first.v_mid(), du = (first.u1 - first.u0) / 4,
               dv = (first.v1 - first.v0) / 4;
  const TrimRegion small({{{u - du, v - dv}, {u + du, v - dv}, {u + du, v + dv}, {u - du, v + dv}}});
  const SurfaceModel model({{"small", s, small, false}});
  ASSERT_EQ(model.patches().size(), 1u);
  EXPECT_EQ(model.patches()[0].cover, TrimRegion::Cover::crossing);
}

TEST(SurfaceModel, NeedsAFaceToMachine) {
  EXPECT_THROW(SurfaceModel({{"dome", dome(), {}, true}}), std::invalid_argument);
  EXPECT_THROW(SurfaceModel({}), std::invalid_argument);
  const TrimRegion elsewhere({{{60, 60}, {70, 60}, {70, 70}}});
  EXPECT_THROW(SurfaceModel({{"dome", dome(), elsewhere, false}}), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
