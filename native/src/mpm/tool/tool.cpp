#include "mpm/tool/tool.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/error.h"

namespace mpm {
namespace {

void check_length(double value, const char* name, bool may_be_zero) {
  require(std::isfinite(value) && (value > 0 || (may_be_zero && value == 0)),
          std::string(name) + " must be a " + (may_be_zero ? "non-negative" : "positive") +
              " number of mm, got " + std::to_string(value));
}

}  // namespace

ConeDistance cone_distance(double r, double z, double r0, double r1, double z0, double z1) {
  const double length = z1 - z0, slant = hypotenuse(length, r1 - r0);
  const double below = z0 - z, above = z - z1;
  const double side = (length * (r - r0) - (r1 - r0) * (z - z0)) / slant;  // beyond the slanted side
  if (below <= 0 && above <= 0 && side <= 0) {
    if (side >= below && side >= above) return {side, length / slant, -(r1 - r0) / slant};
    return below >= above ? ConeDistance{below, 0, -1} : ConeDistance{above, 0, 1};
  }
  // Outside: the nearest point of the two discs and the slanted side.
  const double t = std::clamp(((r - r0) * (r1 - r0) + (z - z0) * length) / (slant * slant), 0.0, 1.0);
  const Vec2 nearest[] = {
      {std::min(r, r0), z0}, {std::min(r, r1), z1}, {r0 + t * (r1 - r0), z0 + t * length}};
  ConeDistance best{kInfinity, 0, 0};
  for (const Vec2& p : nearest) {
    const double distance = hypotenuse(r - p.x(), z - p.y());
    if (distance < best.distance) best = {distance, (r - p.x()) / distance, (z - p.y()) / distance};
  }
  // On the side itself the quotient above is 0/0: take the side's normal.
  if (best.distance == 0) best = {0, length / slant, -(r1 - r0) / slant};
  return best;
}

double Tool::length() const {
  double total = flute_length;
  for (const ToolSegment& s : segments) total += s.length;
  return total;
}

double Tool::reach() const {
  double reach = radius();
  for (const ToolSegment& s : segments) reach = std::max({reach, s.bottom_radius, s.top_radius});
  return reach;
}

void check_tool(const Tool& tool) {
  check_length(tool.major_radius, "major_radius_mm", true);
  check_length(tool.minor_radius, "minor_radius_mm", true);
  require(tool.radius() > 0, "major_radius_mm and minor_radius_mm must not both be 0");
  check_length(tool.recess, "recess_mm", true);
  require(tool.recess <= tool.minor_radius,
          "recess_mm must be at most minor_radius_mm (" + std::to_string(tool.minor_radius) + "), got " +
              std::to_string(tool.recess));
  check_length(tool.flute_length, "flute_length_mm", false);
  require(tool.flute_length > tool.minor_radius,
          "flute_length_mm must be more than minor_radius_mm (" + std::to_string(tool.minor_radius) +
              "), got " + std::to_string(tool.flute_length));
  for (const ToolSegment& s : tool.segments) {
    check_length(s.bottom_radius, "segment bottom radius", false);
    check_length(s.top_radius, "segment top radius", false);
    check_length(s.length, "segment length", false);
  }
}

double signed_distance(const Tool& tool, double r, double z) {
  const double ring = hypotenuse(r - tool.major_radius, z) - tool.minor_radius;
  double distance = ring;
  visit_pieces(tool, [&](double r0, double r1, double z0, double z1) {
    distance = std::min(distance, cone_distance(r, z, r0, r1, z0, z1).distance);
  });
  return distance;
}

double signed_distance(const Tool& tool, const ToolPose& pose, const Vec3& point) {
  const Vec3 d = point - pose.torus_center;
  const double z = d.dot(pose.axis);
  return signed_distance(tool, (d - z * pose.axis).norm(), z);
}

Box3 tool_bounds(const Tool& tool, const ToolPose& pose, double margin) {
  // A disc of radius q about the axis extends q sqrt(1 - a_k^2) along coordinate k.
  const Vec3 spread = (Vec3::Ones() - pose.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  Box3 box;
  const auto add_disc = [&](double z, double radius) {
    const Vec3 c = pose.torus_center + z * pose.axis;
    box.extend(Vec3(c - radius * spread));
    box.extend(Vec3(c + radius * spread));
  };
  double top = tool.flute_length - tool.minor_radius;
  add_disc(-tool.minor_radius, tool.radius());
  add_disc(top, tool.radius());
  for (const ToolSegment& s : tool.segments) {
    add_disc(top, s.bottom_radius);
    top += s.length;
    add_disc(top, s.top_radius);
  }
  box.lo.array() -= margin;
  box.hi.array() += margin;
  return box;
}

}  // namespace mpm
