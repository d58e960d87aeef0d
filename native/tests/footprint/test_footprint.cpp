#include <gtest/gtest.h>

#include "mpm/footprint/footprint_locator.h"
#include "mpm/footprint/raster.h"
#include "thesis.h"

namespace mpm {
namespace {

TEST(Raster, TheThesisFootprintIsExact) {
  const Footprint f = raster({0, 0}, {150, 150}, {kPi / 2, 18, 2, 0, false});
  ASSERT_EQ(f.points.size(), 760u);
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const std::size_t pass = i / 76, point = i % 76;
    EXPECT_EQ(f.pass[i], pass);
    EXPECT_EQ(f.points[i], Vec2(pass == 9 ? 150.0 : 18.0 * double(pass), 2.0 * double(point)));
  }
}

TEST(Raster, ZigzagTurnsEverySecondPass) {
  const Footprint f = raster({0, 0}, {10, 4}, {0, 2, 5, 0, true});
  ASSERT_EQ(f.points.size(), 9u);
  EXPECT_EQ(f.points[0], Vec2(0, 4));  // the side step goes to the right of the feed
  EXPECT_EQ(f.points[3], Vec2(10, 2));
  EXPECT_EQ(f.points[6], Vec2(0, 0));
}

TEST(Raster, RefusesStepsThatGiveNothingOrTooMuch) {
  EXPECT_THROW(raster({0, 0}, {1, 1}, {0, 0, 1, 0, false}), std::invalid_argument);
  EXPECT_THROW(raster({0, 0}, {1, 1}, {0, 1, kNaN, 0, false}), std::invalid_argument);
  EXPECT_THROW(raster({0, 0}, {100, 100}, {0, 1e-3, 1e-3, 0, false}), std::invalid_argument);
  EXPECT_THROW(raster({0, 0}, {1, 1}, {0, 1, 1, -2, false}), std::invalid_argument);
}

TEST(FootprintLocator, KnowsWhatLiesOverTheFaces) {
  const SurfaceModel model = testing::thesis_model(testing::Thesis::saddle);
  const FootprintLocator locator(model, 6.0);
  const std::vector<Vec2> points{{75, 75}, {0, 0}, {150, 150}, {150, 33.3}, {150.01, 75}, {-3, 20}};
  EXPECT_EQ(over_faces(locator, points, 0), (std::vector<bool>{true, true, true, true, false, false}));
  EXPECT_EQ(over_faces(locator, points, 1), (std::vector<bool>{true, true, true, true, true, false}));
}

}  // namespace
}  // namespace mpm
