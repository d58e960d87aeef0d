#include "mpm/machine/orientation.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/direction.h"

namespace mpm {
namespace {

// An axis this much (radians) out of reach still counts as reachable: the rounding of a unit vector and of
// the angles taken from it.
constexpr double kReachSlack = 1e-12;
// Nearer to the pole than this (radians) the azimuth of the tool is rounding noise.
constexpr double kPoleEpsilon = 1e-13;

// Right-handed angle about the unit vector `about` from the projection of `from` to that of `to`.
double azimuth_between(const Vec3& about, const Vec3& from, const Vec3& to) {
  const Vec3 f = from - about.dot(from) * about, t = to - about.dot(to) * about;
  return std::atan2(about.dot(f.cross(t)), f.dot(t));
}

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

}  // namespace

OrientationInverse::OrientationInverse(const KinematicChain& chain)
    : rotary_(chain.rotary), spindle_(chain.spindle_axis) {
  const Vec3 &a1 = rotary_[0].rotation_vector, &a2 = rotary_[1].rotation_vector;
  between_axes_ = angle_between(a1, a2);
  spindle_angle_ = angle_between(a2, spindle_);
  nearest_to_pole_ = azimuth_between(a2, spindle_, a1);
}

double OrientationInverse::turn_of_first(const Vec3& from, const Vec3& to) const {
  return azimuth_between(rotary_[0].rotation_vector, from, to);
}

OrientationSolutions OrientationInverse::solve(const Vec3& axis) const {
  const double to_first = angle_between(rotary_[0].rotation_vector, axis);
  // How far inside the triangle inequalities the three sides are; negative: no such triangle.
  const double over_gap = to_first - std::abs(between_axes_ - spindle_angle_);
  const double under_sum = between_axes_ + spindle_angle_ - to_first;
  const double under_turn = 2 * kPi - between_axes_ - spindle_angle_ - to_first;

  OrientationSolutions result;
  result.reachable = std::min({over_gap, under_sum, under_turn}) >= -kReachSlack;
  result.pole_distance = std::min(to_first, kPi - to_first);
  const double near = std::sin(std::max(over_gap, 0.0) / 2) *
                      std::sin((to_first + std::abs(between_axes_ - spindle_angle_)) / 2);
  const double far = std::sin(std::max(under_sum, 0.0) / 2) * std::sin(std::max(under_turn, 0.0) / 2);
  const double spread = 2 * std::atan2(std::sqrt(near), std::sqrt(far));
  for (int branch = 0; branch < 2; ++branch) {
    const double second = wrapped(nearest_to_pole_ + (branch == 0 ? spread : -spread));
    const Vec3 tilted = rotation(rotary_[1].rotation_vector, second) * spindle_;
    const double first = result.pole_distance > kPoleEpsilon ? turn_of_first(tilted, axis) : 0.0;
    result.rotary[branch] = {rotary_[0].reading(first), rotary_[1].reading(second)};
  }
  return result;
}

}  // namespace mpm
