// The machine as plain data: two rotary axes between the part and the tool, and the linear axes X, Y, Z.
#pragma once

#include <array>

#include "mpm/base/types.h"

namespace mpm {

// Names follow FreeCAD's machine model. Lengths in mm, angles in radians, velocities per second.
enum class AxisRole { table_rotary, head_rotary };
inline constexpr std::array kAxisRoleNames = {"table_rotary", "head_rotary"};

// Which of the two orientation solutions is taken where both are within limits: the quicker one, or the one
// whose second rotary axis (the tilt) reads the larger or the smaller value.
enum class SolutionPreference { shortest, positive, negative };
inline constexpr std::array kSolutionPreferenceNames = {"shortest", "positive", "negative"};

// A rotary axis as ISO 841 sees it: the motion of the *tool relative to the part*. With sense +1 a positive
// reading turns the tool, seen from the part, by the right-hand rule about `rotation_vector`; a table then
// physically turns the other way.
struct RotaryAxis {
  char name = 'C';
  AxisRole role = AxisRole::table_rotary;
  // Direction and one point of the axis when every rotary axis reads its zero offset. Machine frame; for a
  // head the point is taken with X = Y = Z = 0, that is relative to the spindle gauge point (minus the pivot
  // vector).
  Vec3 rotation_vector = Vec3::UnitZ();
  Vec3 joint_origin = Vec3::Zero();
  int sense = 1;                  // +1 or -1
  double zero_offset = 0.0;       // the reading at which the axis stands as described above
  double min_limit = -kInfinity;  // of the reading; both infinite: the axis is unwound
  double max_limit = kInfinity;
  double max_velocity = kInfinity;
  double max_acceleration = kInfinity;

  double angle(double reading) const { return sense * (reading - zero_offset); }
  double reading(double angle) const { return zero_offset + sense * angle; }
};

struct LinearAxis {
  double min_limit = -kInfinity;
  double max_limit = kInfinity;
  double max_velocity = kInfinity;
  double max_acceleration = kInfinity;
};

struct KinematicChain {
  std::array<RotaryAxis, 2> rotary;   // in the order met on the way from the part to the tool
  std::array<LinearAxis, 3> linear;   // X, Y, Z: directions of the machine frame
  Vec3 spindle_axis = Vec3::UnitZ();  // tip to spindle, machine frame, rotary axes at their zero offsets
  SolutionPreference solution_preference = SolutionPreference::shortest;
  bool allow_flip = true;  // may change from one orientation solution to the other while not cutting
};

// What the set-up adds to the machine.
struct PartSetup {
  // Origin of the part's frame in the machine frame, rotary axes at their zero offsets.
  Vec3 part_origin = Vec3::Zero();
  double tool_length = 0.0;  // gauge point to tip
};

// The chain with its directions normalised; nothing else is changed.
//
// Fails: std::invalid_argument that names the axis and what is wrong: a table axis after a head axis,
//   parallel rotary axes, a second axis along the spindle, names that are equal or not A, B or C, a sense
//   that is not 1 or -1, directions, origins and offsets that are not finite, limits out of order, velocities
//   and accelerations that are not positive.
KinematicChain checked(const KinematicChain& chain);

}  // namespace mpm
