// Position kinematics: one product of transforms for every arrangement of heads and tables.
#pragma once

#include "mpm/base/pose_motion.h"
#include "mpm/machine/kinematic_chain.h"

namespace mpm {

// Readings of the five axes, mm and radians. The linear ones are the position of the spindle gauge point with
// both rotary axes at zero.
struct Joints {
  Vec3 linear = Vec3::Zero();
  Vec2 rotary = Vec2::Zero();
};

// Direction of the tool, unit, in the part's frame at the rotary readings.
//
// Requires, as all that follow: a chain from checked(). Limits are not looked at.
Vec3 tool_axis(const KinematicChain& chain, const Vec2& rotary);

// With R the turn about an axis' line, product of exponentials from the part to the tool:
//     part_origin + tip = R_tables · (P + R_heads · (-tool_length · spindle_axis))
// which for the four usual arrangements is what their own formulas say (docs/machine.md).
TipPose forward(const KinematicChain& chain, const PartSetup& setup, const Joints& joints);

// The linear readings that bring the tip there at the given rotary readings; inverse of forward().
Vec3 linear_readings(const KinematicChain& chain,
                     const PartSetup& setup,
                     const Vec3& tip,
                     const Vec2& rotary);

}  // namespace mpm
