#include "mpm/tool/tool.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/error.h"

namespace mpm {
namespace {

// Signed distance from the trapezoid r <= radius(z), z in [z0, z1], radius linear from r0 to r1: a truncated
// cone in the half-plane through the axis.
double cone_distance(double r, double z, double r0, double r1, double z0, double z1) {
  const double below = z0 - z, above = z - z1;
  const double length = z1 - z0, slant = std::hypot(length, r1 - r0);
  const double side = (length * (r - r0) - (r1 - r0) * (z - z0)) / slant;  // beyond the slanted side
  const double inside = std::max({below, above, side});
  if (inside <= 0) return inside;
  // Outside: nearest point of the three boundary segments.
  const auto to_disc = [&](double radius, double dz) { return std::hypot(std::max(r - radius, 0.0), dz); };
  const double t = std::clamp(((r - r0) * (r1 - r0) + (z - z0) * length) / (slant * slant), 0.0, 1.0);
  const double to_side = std::hypot(r - (r0 + t * (r1 - r0)), z - (z0 + t * length));
  return std::min({to_disc(r0, below), to_disc(r1, above), to_side});
}

void check_length(double value, const char* name, bool may_be_zero) {
  require(std::isfinite(value) && (value > 0 || (may_be_zero && value == 0)),
          std::string(name) + " must be a " + (may_be_zero ? "non-negative" : "positive") +
              " number of mm, got " + std::to_string(value));
}

}  // namespace

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
  const double ring = std::hypot(r - tool.major_radius, z) - tool.minor_radius;
  double top = tool.flute_length - tool.minor_radius;
  double distance = std::min(ring, cone_distance(r, z, tool.radius(), tool.radius(), 0.0, top));
  if (tool.major_radius > 0) {
    const double bottom = tool.recess - tool.minor_radius;
    distance = std::min(distance, cone_distance(r, z, tool.major_radius, tool.major_radius, bottom, top));
  }
  for (const ToolSegment& s : tool.segments) {
    distance = std::min(distance, cone_distance(r, z, s.bottom_radius, s.top_radius, top, top + s.length));
    top += s.length;
  }
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
