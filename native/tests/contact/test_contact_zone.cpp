#include <gtest/gtest.h>

#include <algorithm>

#include "mpm/contact/approach.h"
#include "mpm/contact/contact_zone.h"
#include "mpm/contact/first_arrival.h"
#include "thesis.h"

namespace mpm {
namespace {

constexpr int kGrid = 40;

double gap(const Tool& tool, const ToolPose& pose, const Vec3& s) {
  const Vec3 x = s - pose.torus_center;
  const double z = x.dot(pose.axis);
  return hypotenuse((x - z * pose.axis).norm() - tool.major_radius, z) - tool.minor_radius;
}

// Least gap over the part of the patch in the zone, by a dense grid.
double sampled(const ContactZone& zone, const Tool& tool, const ToolPose& pose) {
  const Eigen::Matrix2d from_unit = zone.to_unit.inverse();
  const ParamBox& box = zone.patch->box();
  double least = kInfinity;
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const Vec2 uv = zone.center + from_unit * Vec2(-1 + 2.0 * i / kGrid, -1 + 2.0 * j / kGrid);
      if (uv.x() < box.u0 || uv.x() > box.u1 || uv.y() < box.v0 || uv.y() > box.v1) continue;
      least = std::min(least, gap(tool, pose, zone.patch->point(uv.x(), uv.y())));
    }
  return least;
}

// Dropped on every thesis surface, also over its edges, where a border holds the contact.
TEST(ContactZone, NoPointInItIsNearerThanItsBound) {
  const Tool tool = testing::thesis_tool();
  int zones = 0, at_border = 0;
  double largest = 0;  // mm
  for (auto which : {testing::Thesis::convex, testing::Thesis::concave, testing::Thesis::saddle}) {
    const SurfaceModel model = testing::thesis_model(which);
    const BezierPatch& patch = model.faces()[0].surface.patches()[0];
    const double third = third_derivative_bound(patch);
    for (double x : {-4.0, 0.0, 31.0, 75.0, 118.0, 150.0, 155.0})
      for (double y : {-4.0, 3.0, 44.0, 75.0, 101.0, 149.0}) {
        const Drop drop(tool, Vec2(x, y));
        // From under the ring, on the side of the middle.
        const auto under = [](double at) { return std::clamp((at < 75 ? at + 5 : at - 5) / 150, 0.0, 1.0); };
        const PatchMinimum touch = first_arrival(tool, drop, model.faces()[0], under(x), under(y));
        if (!(touch.value < kInfinity)) continue;
        const ToolPose pose = drop.pose(touch.value);
        const PatchMinimum lowest = lowest_point(tool, pose, patch, touch.u, touch.v);
        const ClearanceBound bound(tool, pose);
        const auto zone = contact_zone(tool, pose, bound, patch, third, lowest);
        if (!zone) continue;
        ++zones;
        at_border += lowest.on_border_u || lowest.on_border_v;
        largest = std::max(largest, 150 * zone->to_unit.inverse().col(0).norm());
        EXPECT_GE(sampled(*zone, tool, pose), zone->lower) << x << " " << y;
        EXPECT_GE(zone->lower, lowest.value - 1e-9);
      }
  }
  EXPECT_GT(zones, 80);
  EXPECT_GT(at_border, 2);
  EXPECT_GT(largest, 0.5);
}

}  // namespace
}  // namespace mpm
