#include <gtest/gtest.h>

#include "mpm/base/direction.h"

namespace mpm {
namespace {

Vec3 tilted(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }

TEST(Direction, AnglesNearZeroAndPiKeepTheirDigits) {
  EXPECT_NEAR(angle_between(tilted(0.3), tilted(0.3 + 1e-9)), 1e-9, 1e-16);
  EXPECT_NEAR(kPi - angle_between(tilted(0.3), -tilted(0.3 + 1e-9)), 1e-9, 1e-15);
}

TEST(Direction, GreatCircleIsWalkedEvenly) {
  for (double s : {0.0, 0.25, 0.5, 1.0})
    EXPECT_LT((great_circle(tilted(0.2), tilted(1.4), s) - tilted(0.2 + s * 1.2)).norm(), 1e-15);
}

TEST(Direction, GreatCircleWithoutAPlaneStays) {
  EXPECT_EQ(great_circle(tilted(0.5), tilted(0.5), 0.5), tilted(0.5));
}

}  // namespace
}  // namespace mpm
