#include <gtest/gtest.h>

#include "mpm/tool/tool.h"

namespace mpm {
namespace {

TEST(Tool, DistanceOfTheRingIsExact) {
  const Tool tool{6.7, 6.0, 6.0, 30.0, {}};
  EXPECT_DOUBLE_EQ(signed_distance(tool, 6.7, -8.0), 2.0);
  EXPECT_DOUBLE_EQ(signed_distance(tool, 14.7, 0.0), 2.0);
  EXPECT_NEAR(
      signed_distance(tool, 0.0, -1.0), std::min(1.0, std::hypot(6.7, 1.0) - 6.0), 1e-12);  // in the recess
}

TEST(Tool, FlatBottomFillsTheRing) {
  const Tool tool{6.7, 6.0, 0.0, 30.0, {}};
  EXPECT_NEAR(signed_distance(tool, 0.0, -7.0), 1.0, 1e-12);
  EXPECT_LT(signed_distance(tool, 0.0, -5.0), 0.0);
}

}  // namespace
}  // namespace mpm
