#include <gtest/gtest.h>

#include "mpm/contact/curvature_limit.h"
#include "mpm/contact/merging_contact.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr double kHalf = 10;        // mm: the ground reaches from -10 to 10 in x and in y
constexpr double kBend = 1.0 / 40;  // 1/mm, along the ring

// z = bend y^2 / 2 + skew y^3; the tool leans on it at the origin with its ring along y.
SurfaceModel ground(double skew) {
  const std::vector<double> knots_u{0, 0, 1, 1}, knots_v{0, 0, 0, 0, 1, 1, 1, 1};
  const double h = kHalf, at[] = {-h, -h / 3, h / 3, h};
  // The blossoms of y^2 and y^3 at the poles.
  const double squared[] = {h * h, -h * h / 3, -h * h / 3, h * h};
  const double cubed[] = {-h * h * h, h * h * h, -h * h * h, h * h * h};
  std::vector<Vec3> poles;
  for (const double x : {-h, h})
    for (int j = 0; j < 4; ++j) poles.emplace_back(x, at[j], kBend / 2 * squared[j] + skew * cubed[j]);
  return testing::one_face(BSplineSurface(1, 3, knots_u, knots_v, poles));
}

struct Leaning {
  explicit Leaning(double skew) : model(ground(skew)) {
    first.u = first.v = 0.5, first.s = Vec3::Zero(), first.value = 0;
    curvature = curvature_limit(tool, insert, model.faces()[0].surface.evaluate(0.5, 0.5), first);
  }
  double arrival(double u, double v) const { return approach.arrival(model.faces()[0].surface.point(u, v)); }
  Tool tool{6.7, 6, 6, 40, {}};
  SurfaceModel model;
  Insert insert{Vec3(0, 0, 6), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  Tilt approach{tool, insert};
  PatchMinimum first;
  double curvature;
};

// Brute force: the least arrival on a dense grid near P, a hole round P left out.
double least_by_grid(const Leaning& one) {
  double least = kInfinity;
  for (int i = 0; i <= 80; ++i)
    for (int j = 0; j <= 400; ++j) {
      const double u = 0.45 + 0.1 * i / 80, v = 0.3 + 0.4 * j / 400;
      if (std::abs(v - 0.5) * 2 * kHalf > 0.1) least = std::min(least, one.arrival(u, v));
    }
  return least;
}

TEST(MergingContact, LeadsToTheContactBesideP) {
  for (const double skew : {2e-4, -2e-4}) {
    const Leaning one(skew);
    ASSERT_TRUE(std::isfinite(one.curvature));
    const double least = least_by_grid(one);
    ASSERT_LT(least, one.curvature - 1e-5);
    const auto start =
        merging_contact(one.tool, one.approach, one.model.faces()[0], one.first, one.curvature, false);
    ASSERT_TRUE(start);
    EXPECT_GT((start->y() - 0.5) * skew, 0);  // where the surface rises more
    const double from = one.arrival(start->x(), start->y());
    EXPECT_LT(from, one.curvature);
    const PatchMinimum found =
        first_arrival(one.tool, one.approach, one.model.faces()[0], start->x(), start->y());
    EXPECT_LE(found.value, from);
  }
}

// A face that bends alike to both sides of P has no lower place beside it when its fourth order lets go.
TEST(MergingContact, NoneWhereNothingIsLower) {
  const Leaning one(0);
  const double least = least_by_grid(one);
  const auto start =
      merging_contact(one.tool, one.approach, one.model.faces()[0], one.first, one.curvature, false);
  EXPECT_EQ(start.has_value(), least < one.curvature - 1e-6) << least - one.curvature;
}

}  // namespace
}  // namespace mpm
