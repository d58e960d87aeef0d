// Machines for the tests of this module.
#pragma once

#include <random>

#include "mpm/machine/kinematic_chain.h"

namespace mpm::testing {

inline const Vec3 kInclined = Vec3(0, 1, 1).normalized();

inline RotaryAxis table(char name, const Vec3& direction, const Vec3& point = Vec3::Zero()) {
  RotaryAxis axis;
  axis.name = name;
  axis.rotation_vector = direction;
  axis.joint_origin = point;
  return axis;
}

inline RotaryAxis head(char name, const Vec3& direction, const Vec3& point = Vec3::Zero()) {
  RotaryAxis axis = table(name, direction, point);
  axis.role = AxisRole::head_rotary;
  return axis;
}

inline KinematicChain chain_of(const RotaryAxis& first, const RotaryAxis& second) {
  KinematicChain chain;
  chain.rotary = {first, second};
  return checked(chain);
}

// 45 degree head with a rotary table.
inline KinematicChain inclined_head() { return chain_of(table('C', Vec3::UnitZ()), head('B', kInclined)); }

inline Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

// Unit vector with the given angle from z and azimuth from x, radians.
inline Vec3 direction(double tilt, double azimuth) {
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

}  // namespace mpm::testing
