#include <gtest/gtest.h>

#include "mpm/gouge/quarters.h"
#include "mpm/surface/quadratic_cell.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr ParamBox kWhole{-1, 3, 2, 2.5};

TEST(Quarters, CoverThePieceOnceEach) {
  for (const double u : {-0.9, 0.3, 1.7, 2.9})
    for (const double v : {2.01, 2.2, 2.3, 2.49}) {
      int holders = 0;
      for (int quarter = 0; quarter < kQuarters; ++quarter) {
        const ParamBox box = quarter_box(kWhole, quarter);
        holders += box.u0 < u && u < box.u1 && box.v0 < v && v < box.v1;
      }
      EXPECT_EQ(holders, 1) << u << " " << v;
    }
  EXPECT_EQ(quarter_box(kWhole, 1).u0, 1.0);
  EXPECT_EQ(quarter_box(kWhole, 2).v0, 2.25);
}

// The bound that the quarter's own control points give never is more than what is inherited.
TEST(Quarters, InheritABoundOfTheThirdDerivative) {
  const BSplineSurface surface = testing::bicubic(testing::kThesisHeights[2]);
  const BezierPatch& patch = surface.patches().front();
  const double whole = third_derivative_bound(patch);
  double largest = 0;
  for (int quarter = 0; quarter < kQuarters; ++quarter) {
    const double own = third_derivative_bound(patch.restricted(quarter_box(patch.box(), quarter)));
    EXPECT_LE(own, quarter_third(whole) * (1 + 1e-12));
    largest = std::max(largest, own);
  }
  EXPECT_GT(largest, quarter_third(whole) / 8);  // an eighth less would be no bound
}

TEST(Quarters, OfATrimmedPiece) {
  const TrimRegion trim({{Vec2(0, 0), Vec2(0.5, 0), Vec2(0.5, 1), Vec2(0, 1)}});
  const QuarterCover inside = quarter_cover(trim, true, {0.1, 0.2, 0.1, 0.2}),
                     across = quarter_cover(trim, true, {0.4, 0.6, 0.1, 0.2}),
                     outside = quarter_cover(trim, true, {0.7, 0.8, 0.1, 0.2}),
                     known = quarter_cover(trim, false, {0.7, 0.8, 0.1, 0.2});
  EXPECT_TRUE(inside.kept && !inside.trimmed);
  EXPECT_TRUE(across.kept && across.trimmed);
  EXPECT_FALSE(outside.kept);
  EXPECT_TRUE(known.kept && !known.trimmed);  // what is known to be inside is not asked again
}

TEST(Quarters, WhatIsTooSmallToTellCountsAsSurface) {
  const TrimRegion trim({{Vec2(0, 0), Vec2(0.5, 0), Vec2(0.5, 1), Vec2(0, 1)}});
  EXPECT_TRUE(counts_as_surface(trim, true, 1, 0.4, 0.5));
  EXPECT_FALSE(counts_as_surface(trim, true, 2 * kTrimResolution, 0.6, 0.5));
  EXPECT_TRUE(counts_as_surface(trim, true, kTrimResolution / 2, 0.6, 0.5));
  EXPECT_TRUE(counts_as_surface(trim, false, 1, 0.6, 0.5));
}

}  // namespace
}  // namespace mpm
