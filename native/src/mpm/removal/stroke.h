// The tool's way through the stock, cut into strokes so short that each is simple.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/base/pose_motion.h"
#include "mpm/tool/tool.h"

namespace mpm {

// The tool's way (set-up frame): move i goes from pose i - 1 to pose i.
struct SweptPath {
  std::vector<TipPose> poses;
  std::vector<std::uint8_t> removes;  // does the move take material away? [0] is not read
};

// Fails: std::invalid_argument for arrays of different length, for a tip that is not finite and for an axis
//   that is not a unit vector.
void check_swept_path(const SweptPath& path);

// Where the tool is at one time of a stroke, and how fast it goes there (per unit of the stroke's time).
struct StrokePose {
  Vec3 center, axis;  // torus centre, tip to spindle
  Vec3 center_rate, axis_rate;
};

// A part of one move at whose time 0 <= t <= 1 the tip is tip + t travel and the axis cos(t angle) axis +
// sin(t angle) side: exactly the motion that pose_between describes.
struct Stroke {
  Vec3 tip, travel;
  Vec3 axis, side;  // side: unit, square to the axis
  double angle;     // radians, 0 <= angle <= kStrokeAngle
  std::uint32_t move;
  double minor_radius;             // of the tool
  double length;                   // of the travel
  std::array<StrokePose, 2> ends;  // at times 0 and 1
  StrokePose middle;               // at time 1/2

  StrokePose at(double time) const;
  // No point at distance `lever` from the torus centre moves farther against the tool during the stroke, mm.
  double motion(double lever) const { return length + angle * (minor_radius + lever); }
  // By how much the height of a point above the tip plane at any time may be below the lesser of its heights
  // at the two ends; for points within `reach` mm of the tip.
  double sagitta(double reach) const { return angle * length / 2 + reach * angle * angle / 8; }
};

inline constexpr double kStrokeAngle = 0.05;  // radians a stroke turns at most

// Longest travel of a stroke (mm) of this tool: see docs/removal.md, "Accuracy".
double longest_travel(const Tool& tool);

// The strokes of all removing moves, in their order.
//
// Requires: what check_tool() and check_swept_path() let pass; no move between opposite axes (pose_between).
// Guarantees: the strokes of a move take equal times; to rounding none turns more than kStrokeAngle or
//   travels farther than longest_travel().
std::vector<Stroke> make_strokes(const Tool& tool, const SweptPath& path);

}  // namespace mpm
