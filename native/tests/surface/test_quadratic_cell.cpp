#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/surface/cell_tree.h"
#include "mpm/surface/quadratic_cell.h"
#include "surface/random_surface.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr int kSamples = 9;

Vec3 model_point(const QuadraticCell& q, double a, double b) {
  return q.c + a * q.A + b * q.B + a * a * q.C + a * b * q.E + b * b * q.F;
}

// Largest distance of the surface from the cell's model on a grid that includes the corners.
template <class Surface>
double worst(const Surface& surface, const ParamBox& box, const QuadraticCell& q) {
  double largest = 0;
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const double a = -1 + 2.0 * i / (kSamples - 1), b = -1 + 2.0 * j / (kSamples - 1);
      const double u = box.u_mid() + a * 0.5 * (box.u1 - box.u0),
                   v = box.v_mid() + b * 0.5 * (box.v1 - box.v0);
      const Vec3 s = surface.point(u, v);
      largest = std::max(largest, (s - model_point(q, a, b)).norm());
      EXPECT_LE((s - q.c).norm(), q.radius);
    }
  return largest;
}

class Cells : public ::testing::TestWithParam<int> {};

TEST_P(Cells, ErrorsHoldForAnySurface) {
  testing::SurfaceMaker make{unsigned(GetParam())};
  for (bool rational : {false, true}) {
    const BSplineSurface s = make.data(GetParam(), 1 + (GetParam() * 3) % 10, rational, true).surface();
    for (const BezierPatch& patch : s.patches()) {
      const ParamBox& b = patch.box();
      const ParamBox part{b.u0, b.u_mid(), b.v_mid(), b.v1};
      const BezierPatch piece = patch.restricted(part);
      const QuadraticCell cell = interpolating_cell(piece);
      EXPECT_LE(worst(patch, part, cell), cell.error);
      const QuadraticCell taylor = taylor_cell(patch, part, third_derivative_bound(piece));
      EXPECT_LE(worst(patch, part, taylor), taylor.error);
    }
  }
}

// The patch's own point by its definition, in long double.
Eigen::Matrix<long double, 3, 1> exact_point(const BezierPatch& patch, long double u, long double v) {
  const auto bernstein = [](int n, int i, long double t) {
    long double value = 1;
    for (int k = 0; k < i; ++k) value *= t * (n - k) / (k + 1);
    return value * std::pow(1 - t, static_cast<long double>(n - i));
  };
  const ParamBox& box = patch.box();
  const long double s = (u - box.u0) / (static_cast<long double>(box.u1) - box.u0);
  const long double t = (v - box.v0) / (static_cast<long double>(box.v1) - box.v0);
  Eigen::Matrix<long double, 4, 1> sum = Eigen::Matrix<long double, 4, 1>::Zero();
  for (int i = 0; i <= patch.degree_u(); ++i)
    for (int j = 0; j <= patch.degree_v(); ++j)
      sum += bernstein(patch.degree_u(), i, s) * bernstein(patch.degree_v(), j, t) *
             patch.control(i, j).cast<long double>();
  return sum.head<3>() / sum[3];
}

// Largest distance in long double of the patch from the cell's model, whose a and b run over `box`.
long double worst_in_long_double(const BezierPatch& patch, const ParamBox& box, const QuadraticCell& q) {
  long double largest = 0;
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const long double a = -1 + 2.0L * i / (kSamples - 1), b = -1 + 2.0L * j / (kSamples - 1);
      const long double u = 0.5L * ((1 - a) * box.u0 + (1 + a) * box.u1);
      const long double v = 0.5L * ((1 - b) * box.v0 + (1 + b) * box.v1);
      const auto point = exact_point(patch, u, v);
      Eigen::Matrix<long double, 3, 1> model = q.c.cast<long double>();
      model += a * q.A.cast<long double>() + b * q.B.cast<long double>() + a * a * q.C.cast<long double>() +
               a * b * q.E.cast<long double>() + b * b * q.F.cast<long double>();
      largest = std::max(largest, (point - model).norm());
    }
  return largest;
}

// From the whole patch down to cells of a millionth of it, far from the origin: where the error is all
// rounding.
TEST_P(Cells, ErrorsHoldInFloatingPoint) {
  testing::SurfaceMaker make{unsigned(100 + GetParam())};
  std::mt19937 engine{unsigned(GetParam())};
  std::uniform_real_distribution<double> any(0, 1);
  int rounded = 0;
  for (bool rational : {false, true})
    for (int k = 0; k < 60; ++k) {
      const BSplineSurface s = make.data(GetParam(), 1 + (GetParam() * 3) % 10, rational, true).surface();
      const BezierPatch& at_origin = s.patches()[0];
      std::vector<Vec4> control = at_origin.control();
      for (Vec4& c : control) c.head<3>() += c[3] * Vec3(1e4, -7e3, 3e3);
      const ParamBox& b = at_origin.box();
      const BezierPatch patch(at_origin.degree_u(), at_origin.degree_v(), b, control);
      const double size = std::pow(10.0, -6 * any(engine)), u = any(engine) * (1 - size),
                   v = any(engine) * (1 - size);
      const ParamBox part{b.u0 + u * (b.u1 - b.u0),
                          b.u0 + (u + size) * (b.u1 - b.u0),
                          b.v0 + v * (b.v1 - b.v0),
                          b.v0 + (v + size) * (b.v1 - b.v0)};
      const BezierPatch piece = patch.restricted(part);
      const QuadraticCell cell = interpolating_cell(piece);
      const QuadraticCell taylor = taylor_cell(patch, part, third_derivative_bound(piece));
      const long double apart = worst_in_long_double(patch, part, cell);
      EXPECT_LE(apart, cell.error) << "size " << size;
      EXPECT_LE(worst_in_long_double(patch, part, taylor), taylor.error) << "size " << size;
      rounded += apart > cell.error - 1024 * kRoundoff * cell.c.cwiseAbs().maxCoeff();
    }
  // Without its margin for rounding the error would be too small here and there.
  EXPECT_GT(rounded, 0);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Cells, ::testing::Range(1, 11));

TEST(CellTree, EveryNodeBoundsItsPartOfTheFace) {
  testing::SurfaceMaker make{7};
  std::vector<Face> faces;
  faces.push_back({"Face1", make.data(3, 2, true, true).surface(), {}, false});
  const SurfaceModel model(std::move(faces));
  const CellTree tree(model, model.bounds().diagonal() / 20);
  ASSERT_EQ(tree.roots().size(), 1u);
  std::size_t leaves = 0;
  for (const CellTree::Node& node : tree.nodes()) {
    EXPECT_LE(worst(model.faces()[0].surface, node.box, node.cell), node.cell.error);
    leaves += node.children == 0;
  }
  EXPECT_GT(leaves, 100u);
}

// Where the surface is smooth the error falls with the third power of the size.
TEST(CellTree, ErrorsShrinkWithSize) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const BezierPatch& patch = model.faces()[0].surface.patches()[0];
  const double coarse = interpolating_cell(patch.restricted({0.4, 0.6, 0.4, 0.6})).error;
  const double fine = interpolating_cell(patch.restricted({0.49, 0.51, 0.49, 0.51})).error;
  EXPECT_LT(fine, coarse / 500);
}

}  // namespace
}  // namespace mpm
