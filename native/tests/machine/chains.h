// Machines for the tests of this module.
#pragma once

#include <random>
#include <vector>

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

// Head and table, two tables, two heads, a level first axis, and one where nothing is square.
inline std::vector<KinematicChain> chains() {
  const Vec3 crooked = Vec3(0.01, -0.02, 1).normalized(), tilted = Vec3(0.02, 1, 0.98).normalized();
  return {chain_of(table('C', Vec3::UnitZ()), head('B', kInclined, {0, 20, 150})),
          chain_of(table('C', Vec3::UnitZ()), table('A', Vec3::UnitX(), {0, 10, 20})),
          chain_of(head('C', Vec3::UnitZ(), {5, 6, 170}), head('B', Vec3::UnitY(), {0, 0, 150})),
          chain_of(table('A', Vec3::UnitX()), table('B', Vec3::UnitY(), {3, 0, -60})),
          chain_of(table('C', crooked, {3, -2, 5}), head('B', tilted, {1, 2, 149}))};
}

inline Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

// Unit vector with the given angle from z and azimuth from x, radians.
inline Vec3 direction(double tilt, double azimuth) {
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

}  // namespace mpm::testing
