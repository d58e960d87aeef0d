#include <gtest/gtest.h>

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
