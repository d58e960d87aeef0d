#include <gtest/gtest.h>

#include "mpm/surface/bezier_patch.h"
#include "surface/random_surface.h"

namespace mpm {
namespace {

constexpr double kRestrictError = 1e4 * kRoundoff;

class AnyPatch : public ::testing::TestWithParam<int> {
 protected:
  // The patch in the middle of a random surface.
  BezierPatch patch(bool rational) {
    const BSplineSurface s = make.data(GetParam(), 1 + GetParam() % 4, rational, true).surface();
    return s.patches()[s.patches().size() / 2];
  }
  ParamBox part_of(const ParamBox& b) {
    const double u = make.uniform(b.u0, b.u_mid()), v = make.uniform(b.v0, b.v_mid());
    return {u, make.uniform(u, b.u1), v, make.uniform(v, b.v1)};
  }
  testing::SurfaceMaker make{unsigned(GetParam())};
};

TEST_P(AnyPatch, RestrictedIsTheSameSurface) {
  for (bool rational : {false, true}) {
    const BezierPatch whole = patch(rational);
    const double tolerance = kRestrictError * whole.bounds().diagonal();
    for (int i = 0; i < 10; ++i) {
      const ParamBox box = part_of(whole.box());
      const BezierPatch part = whole.restricted(box);
      for (double f : {0.0, 0.3, 1.0}) {
        const double u = box.u0 + f * (box.u1 - box.u0), v = box.v1 - f * f * (box.v1 - box.v0);
        EXPECT_LE((part.point(u, v) - whole.point(u, v)).norm(), tolerance);
        EXPECT_LE((part.evaluate(u, v).suv - whole.evaluate(u, v).suv).norm(),
                  tolerance / ((box.u1 - box.u0) * (box.v1 - box.v0)));
      }
    }
  }
}

TEST_P(AnyPatch, BoundsHoldThePatchAndShrinkWithIt) {
  const BezierPatch whole = patch(true);
  const ParamBox& b = whole.box();
  const BezierPatch quarter = whole.restricted({b.u0, b.u_mid(), b.v0, b.v_mid()});
  const double dust = kRestrictError * whole.bounds().diagonal();
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = whole.point(make.uniform(b.u0, b.u1), make.uniform(b.v0, b.v1));
    EXPECT_TRUE((p.array() >= whole.bounds().lo.array() - dust).all());
    EXPECT_TRUE((p.array() <= whole.bounds().hi.array() + dust).all());
  }
  EXPECT_LT(quarter.bounds().diagonal(), whole.bounds().diagonal());
}

TEST_P(AnyPatch, CornersAreExact) {
  const BezierPatch whole = patch(false);
  EXPECT_EQ(whole.point(whole.box().u0, whole.box().v1), Vec3(whole.control(0, whole.degree_v()).head<3>()));
  EXPECT_EQ(whole.point(whole.box().u1, whole.box().v0), Vec3(whole.control(whole.degree_u(), 0).head<3>()));
}

INSTANTIATE_TEST_SUITE_P(Degrees, AnyPatch, ::testing::Range(1, 11));

TEST(BezierPatch, RationalArcIsACircle) {
  // A quarter of a cylinder of radius 10: the standard rational arc has the weight cos 45° in the middle.
  const double w = std::sqrt(0.5);
  std::vector<Vec4> control;
  for (const Vec3& p : {Vec3(10, 0, 1), Vec3(10, 10, w), Vec3(0, 10, 1)})
    for (double z : {0.0, 5.0}) control.emplace_back(p.z() * p.x(), p.z() * p.y(), p.z() * z, p.z());
  const BezierPatch arc(2, 1, {0, 1, 0, 5}, control);
  for (double u : {0.0, 0.2, 0.5, 0.9}) {
    const SurfacePoint p = arc.evaluate(u, 2.0);
    const Vec3 normal = p.su.cross(p.sv).normalized();
    EXPECT_NEAR(p.s.head<2>().norm(), 10.0, 1e-14);
    EXPECT_NEAR(
        normal.dot(p.suu) / p.su.squaredNorm(), -0.1, 1e-14);  // curvature 1/10, bending from the normal
  }
}

}  // namespace
}  // namespace mpm
