#include "mpm/machine/kinematic_chain.h"

#include <cmath>
#include <string>

#include "mpm/base/error.h"

namespace mpm {
namespace {

// Sine below which two axis directions count as parallel: far under any machine, far above rounding.
constexpr double kParallelSine = 1e-6;

Vec3 unit(const Vec3& direction, const std::string& name) {
  const double length = direction.norm();
  require(std::isfinite(length) && length > 0, name + " must be a finite vector that is not zero");
  return direction / length;
}

void check_limits(double lo, double hi, double velocity, double acceleration, const std::string& name) {
  require(lo < hi, name + ": min_limit must be less than max_limit");
  require(velocity > 0, name + ": max_velocity must be positive");
  require(acceleration > 0, name + ": max_acceleration must be positive");
}

RotaryAxis checked(RotaryAxis axis) {
  const std::string name = std::string("rotary axis ") + axis.name;
  require(axis.name >= 'A' && axis.name <= 'C', name + ": name must be A, B or C");
  require(axis.sense == 1 || axis.sense == -1, name + ": sense must be 1 or -1");
  require(std::isfinite(axis.zero_offset), name + ": zero_offset must be finite");
  require(axis.joint_origin.allFinite(), name + ": joint_origin must be finite");
  check_limits(axis.min_limit, axis.max_limit, axis.max_velocity, axis.max_acceleration, name);
  axis.rotation_vector = unit(axis.rotation_vector, name + ": rotation_vector");
  return axis;
}

}  // namespace

KinematicChain checked(const KinematicChain& chain) {
  KinematicChain result = chain;
  result.spindle_axis = unit(chain.spindle_axis, "spindle_axis");
  for (int k = 0; k < 2; ++k) result.rotary[k] = checked(chain.rotary[k]);
  for (int k = 0; k < 3; ++k) {
    const LinearAxis& axis = chain.linear[k];
    check_limits(axis.min_limit,
                 axis.max_limit,
                 axis.max_velocity,
                 axis.max_acceleration,
                 std::string("linear axis ") + "XYZ"[k]);
  }
  const RotaryAxis &first = result.rotary[0], &second = result.rotary[1];
  require(first.name != second.name, "the two rotary axes must have different names");
  require(!(first.role == AxisRole::head_rotary && second.role == AxisRole::table_rotary),
          "rotary axes must be listed from the part to the tool: the table axis comes before the head axis");
  require(first.rotation_vector.cross(second.rotation_vector).norm() > kParallelSine,
          "the two rotary axes must not be parallel");
  require(second.rotation_vector.cross(result.spindle_axis).norm() > kParallelSine,
          "the second rotary axis must not be parallel to the spindle: it would not tilt the tool");
  return result;
}

}  // namespace mpm
