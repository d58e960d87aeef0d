// Many poses at once, against depths known in closed form.
#include <gtest/gtest.h>

#include "mpm/gouge/certify_poses.h"
#include "thesis.h"

namespace mpm {
namespace {

TEST(CertifyPoses, AToolOnAFloorIsAsDeepAsItStands) {
  const SurfaceModel floor = testing::inclined_plane(0);
  const Tool tool = testing::thesis_tool();
  std::vector<ToolPose> poses;
  for (const double height : {0.5, 0.0, -0.3, -1.0})
    poses.push_back(ToolPose::from_tip(tool, Vec3(50, 50, height), Vec3::UnitZ()));
  Context context(2);
  const auto found = certify_poses(floor, tool, poses, 0.001, context);
  EXPECT_EQ(found[0].verdict, Verdict::free);
  EXPECT_GE(found[0].lo, 0);
  EXPECT_EQ(found[1].verdict, Verdict::free);
  EXPECT_GE(found[1].lo, -0.001);
  for (std::size_t i : {2u, 3u}) {
    const double depth = i == 2 ? 0.3 : 1.0;
    EXPECT_EQ(found[i].verdict, Verdict::gouge);
    EXPECT_LE(found[i].lo, -depth + 1e-9);  // no less than the truth
    EXPECT_GE(found[i].hi, -depth - 1e-9);
    EXPECT_LE(found[i].hi, -depth / 1.001);
    EXPECT_GE(found[i].lo, -depth * 1.002);
  }
}

TEST(CertifyPoses, RefusesAToleranceThatIsNone) {
  Context context(1);
  EXPECT_THROW(certify_poses(testing::inclined_plane(0), testing::thesis_tool(), {}, 0, context),
               std::invalid_argument);
}

}  // namespace
}  // namespace mpm
