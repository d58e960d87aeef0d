#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mpm/surface/bspline_surface.h"
#include "surface/random_surface.h"

namespace mpm {
namespace {

using testing::SurfaceData;
using testing::SurfaceMaker;

// The B-spline basis by its recursive definition (Cox and de Boor), the slow way: an oracle that shares
// nothing with the Bézier extraction under test.
double basis(const std::vector<double>& k, int degree, std::size_t i, double t) {
  if (degree == 0) return k[i] <= t && t < k[i + 1] ? 1.0 : 0.0;
  const std::size_t n = std::size_t(degree);
  const double left = k[i + n] - k[i], right = k[i + n + 1] - k[i + 1];
  return (left > 0 ? (t - k[i]) / left * basis(k, degree - 1, i, t) : 0.0) +
         (right > 0 ? (k[i + n + 1] - t) / right * basis(k, degree - 1, i + 1, t) : 0.0);
}

Vec3 by_definition(const SurfaceData& d, double u, double v) {
  Vec4 sum = Vec4::Zero();
  for (std::size_t i = 0; i < d.poles_u(); ++i)
    for (std::size_t j = 0; j < d.poles_v(); ++j) {
      const std::size_t at = i * d.poles_v() + j;
      const double w = d.weights.empty() ? 1.0 : d.weights[at];
      const double b = w * basis(d.knots_u, d.degree_u, i, u) * basis(d.knots_v, d.degree_v, j, v);
      sum += b * Vec4(d.poles[at].x(), d.poles[at].y(), d.poles[at].z(), 1.0);
    }
  return sum.head<3>() / sum.w();
}

double size_of(const SurfaceData& d) {
  Box3 box;
  for (const Vec3& p : d.poles) box.extend(p);
  return box.diagonal();
}

// Each of the 2 * degree convex combinations rounds a few times; weights up to 25 apart take part in the
// quotient.
constexpr double kEvaluationError = 1e4 * kRoundoff;

class AnyBSpline : public ::testing::TestWithParam<int> {};

TEST_P(AnyBSpline, EqualsItsDefinition) {
  const int degree = GetParam();
  SurfaceMaker make{unsigned(degree)};
  for (bool rational : {false, true})
    for (bool clamped : {true, false}) {
      const SurfaceData d = make.data(degree, 1 + (degree + 3) % 10, rational, clamped);
      const BSplineSurface s = d.surface();
      for (int i = 0; i < 20; ++i) {
        const double u = make.uniform(s.domain().u0, s.domain().u1),
                     v = make.uniform(s.domain().v0, s.domain().v1);
        EXPECT_LE((s.point(u, v) - by_definition(d, u, v)).norm(), kEvaluationError * size_of(d));
      }
    }
}

TEST_P(AnyBSpline, DomainIsWhereAllBasisFunctionsAct) {
  SurfaceMaker make{100 + unsigned(GetParam())};
  const SurfaceData d = make.data(GetParam(), GetParam(), false, false);
  EXPECT_EQ(d.surface().domain().u0, d.knots_u[std::size_t(d.degree_u)]);
  EXPECT_EQ(d.surface().domain().u1, d.knots_u[d.poles_u()]);
}

// Central differences over h have an error of about h^2; against it the tolerance is generous but far under a
// wrong factor or sign.
TEST_P(AnyBSpline, DerivativesAgreeWithDifferences) {
  SurfaceMaker make{200 + unsigned(GetParam())};
  const SurfaceData d = make.data(GetParam(), GetParam(), true, true);
  const BSplineSurface s = d.surface();
  for (const BezierPatch& patch : s.patches()) {
    const ParamBox& b = patch.box();
    const double u = b.u_mid(), v = b.v_mid(), h = 1e-5 * (b.u1 - b.u0), k = 1e-5 * (b.v1 - b.v0);
    const SurfacePoint p = patch.evaluate(u, v);
    const double small_u = 1e-5 * (p.su.norm() + p.suu.norm()), small_v = 1e-5 * (p.sv.norm() + p.svv.norm());
    EXPECT_LE(((patch.point(u + h, v) - patch.point(u - h, v)) / (2 * h) - p.su).norm(), small_u);
    EXPECT_LE(((patch.point(u, v + k) - patch.point(u, v - k)) / (2 * k) - p.sv).norm(), small_v);
    const SurfacePoint right = patch.evaluate(u + h, v), left = patch.evaluate(u - h, v);
    const SurfacePoint above = patch.evaluate(u, v + k), below = patch.evaluate(u, v - k);
    EXPECT_LE(((right.su - left.su) / (2 * h) - p.suu).norm(), small_u + 1e-5 * p.suu.norm());
    EXPECT_LE(((above.sv - below.sv) / (2 * k) - p.svv).norm(), small_v + 1e-5 * p.svv.norm());
    EXPECT_LE(((right.sv - left.sv) / (2 * h) - p.suv).norm(), 1e-5 * (p.suv.norm() + p.sv.norm()));
  }
}

TEST_P(AnyBSpline, PatchesMeet) {
  SurfaceMaker make{300 + unsigned(GetParam())};
  const SurfaceData d = make.data(GetParam(), GetParam(), true, true);
  const BSplineSurface s = d.surface();
  const std::size_t columns = s.breaks_v().size() - 1;
  for (std::size_t i = 0; i + columns < s.patches().size(); ++i) {
    const BezierPatch &a = s.patches()[i], &b = s.patches()[i + columns];
    const double v = a.box().v_mid();
    EXPECT_LE((a.point(a.box().u1, v) - b.point(b.box().u0, v)).norm(), kEvaluationError * size_of(d));
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, AnyBSpline, ::testing::Range(1, 11));

TEST(BSplineSurface, NamesWhatIsWrong) {
  const SurfaceData good = SurfaceMaker(1).data(3, 2, true, true);
  const auto message = [&](auto change) -> std::string {
    SurfaceData d = good;
    change(d);
    try {
      d.surface();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message([](SurfaceData&) {}), "accepted");
  EXPECT_THAT(message([](SurfaceData& d) { d.degree_u = 0; }), ::testing::HasSubstr("degree_u"));
  EXPECT_THAT(message([](SurfaceData& d) { d.degree_u = 11; }), ::testing::HasSubstr("degree_u"));
  EXPECT_THAT(message([](SurfaceData& d) { std::swap(d.knots_v.front(), d.knots_v.back()); }),
              ::testing::HasSubstr("knots_v must not decrease"));
  EXPECT_THAT(message([](SurfaceData& d) { d.knots_u.pop_back(); }), ::testing::HasSubstr("poles"));
  EXPECT_THAT(message([](SurfaceData& d) { d.knots_u[0] = -kInfinity; }), ::testing::HasSubstr("finite"));
  EXPECT_THAT(message([](SurfaceData& d) { d.poles[3].y() = kNaN; }),
              ::testing::HasSubstr("poles must be finite"));
  EXPECT_THAT(message([](SurfaceData& d) { d.weights[3] = 0; }),
              ::testing::HasSubstr("weights must be positive"));
  EXPECT_THAT(message([](SurfaceData& d) { d.weights.pop_back(); }), ::testing::HasSubstr("weights"));
}

TEST(BSplineSurface, RefusesAKnotThatTearsTheSurface) {
  SurfaceData d{1, 1, {0, 0, 1, 1, 2, 2}, {0, 0, 1, 1}, std::vector<Vec3>(8, Vec3::Zero()), {}};
  EXPECT_THROW(d.surface(), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
