#include "mpm/machine/forward.h"

#include "mpm/base/frame.h"

namespace mpm {
namespace {

using Transform = Eigen::Isometry3d;

// The turn about the axis' line in space.
Transform turn(const RotaryAxis& axis, double reading) {
  const Eigen::Translation3d to_axis(axis.joint_origin);
  return to_axis * Eigen::AngleAxisd(axis.angle(reading), axis.rotation_vector) * to_axis.inverse();
}

Transform turns(const KinematicChain& chain, const Vec2& rotary, AxisRole role) {
  Transform product = Transform::Identity();
  for (int k = 0; k < 2; ++k)
    if (chain.rotary[k].role == role) product = product * turn(chain.rotary[k], rotary[k]);
  return product;
}

Vec3 tip_from_gauge(const KinematicChain& chain, const PartSetup& setup, const Vec2& rotary) {
  return turns(chain, rotary, AxisRole::head_rotary) * Vec3(-setup.tool_length * chain.spindle_axis);
}

}  // namespace

Vec3 tool_axis(const KinematicChain& chain, const Vec2& rotary) {
  Vec3 axis = chain.spindle_axis;
  for (int k = 1; k >= 0; --k)
    axis = rotation(chain.rotary[k].rotation_vector, chain.rotary[k].angle(rotary[k])) * axis;
  return axis;
}

TipPose forward(const KinematicChain& chain, const PartSetup& setup, const Joints& joints) {
  const Vec3 tip = joints.linear + tip_from_gauge(chain, setup, joints.rotary);
  return {turns(chain, joints.rotary, AxisRole::table_rotary) * tip - setup.part_origin,
          tool_axis(chain, joints.rotary)};
}

Vec3 linear_readings(const KinematicChain& chain,
                     const PartSetup& setup,
                     const Vec3& tip,
                     const Vec2& rotary) {
  const Vec3 in_machine = turns(chain, rotary, AxisRole::table_rotary).inverse() * (tip + setup.part_origin);
  return in_machine - tip_from_gauge(chain, setup, rotary);
}

}  // namespace mpm
