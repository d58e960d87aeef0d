// The cutting tool: a toroidal (bull-nose) cutter with its flutes, shank and holder.
#pragma once

#include <array>
#include <vector>

#include "mpm/base/types.h"

namespace mpm {

// A truncated cone about the tool axis, stacked on what is below it (mm).
struct ToolSegment {
  double bottom_radius, top_radius, length;
};

// Ro = major_radius, Ri = minor_radius, both in mm. Ro = 0: ball end; Ri = 0: flat end. Tool frame: origin at
// the torus centre (centre of the major circle), z along the axis from tip to spindle; the tip lies at z =
// -Ri.
struct Tool {
  double major_radius = 0;
  double minor_radius = 0;
  double recess = 0;        // depth of the hollow inside the ring above the tip plane, 0 (flat bottom) to Ri
  double flute_length = 0;  // from the tip
  std::vector<ToolSegment> segments;  // shank, then holder, from the top of the flutes upwards

  double radius() const { return major_radius + minor_radius; }
  double length() const;  // tip to the top of the last segment
  double reach() const;   // largest distance of a point of the tool from its axis
};

// Fails: std::invalid_argument that names the radius or length that is wrong: not finite, negative, 0 where
//   it must not be, a recess over minor_radius, a flute_length not over it. All that follows requires a tool
//   that passes.
void check_tool(const Tool& tool);

// Signed distance (mm) from the truncated cone of radius r0 at height z0 to r1 at z1 about the axis, at
// radius r >= 0 and height z, and its gradient there (of unit length; where the distance has a kink, one of
// its subgradients).
struct ConeDistance {
  double distance, slope_r, slope_z;
};
ConeDistance cone_distance(double r, double z, double r0, double r1, double z0, double z1);

// Distance (mm) of a point at radius r >= 0 and height z of the tool frame from the tool's body: positive
// outside, where it is exact; negative inside, where its size is at most the true depth.
double signed_distance(const Tool& tool, double r, double z);

// Calls visit(r0, r1, z0, z1) for every piece of the body beside the ring, each a truncated cone about the
// axis from radius r0 at height z0 to r1 at z1 of the tool frame: the flutes; the core of a ring that is not
// hollow to its centre, which reaches up through the flutes so that what lies inside the tool where both meet
// counts as deep; shank and holder.
template <class Visit>
void visit_pieces(const Tool& tool, const Visit& visit) {
  double top = tool.flute_length - tool.minor_radius;
  visit(tool.radius(), tool.radius(), 0.0, top);
  if (tool.major_radius > 0 && tool.recess < tool.minor_radius)
    visit(tool.major_radius, tool.major_radius, tool.recess - tool.minor_radius, top);
  for (const ToolSegment& s : tool.segments) {
    visit(s.bottom_radius, s.top_radius, top, top + s.length);
    top += s.length;
  }
}

// Where the tool stands.
struct ToolPose {
  Vec3 torus_center;
  Vec3 axis;  // unit, tip to spindle

  Vec3 tip(const Tool& tool) const { return torus_center - tool.minor_radius * axis; }
  static ToolPose from_tip(const Tool& tool, const Vec3& tip, const Vec3& axis) {
    return {tip + tool.minor_radius * axis, axis};
  }
};

// Signed distance (mm) of a point in space from the tool at `pose`, both in one frame.
double signed_distance(const Tool& tool, const ToolPose& pose, const Vec3& point);

// A box that contains the tool at `pose`, grown by `margin` (mm).
Box3 tool_bounds(const Tool& tool, const ToolPose& pose, double margin);

}  // namespace mpm
