// Short names for the vectors and boxes that every module uses. Lengths are millimetres, angles radians.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

namespace mpm {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Unit roundoff of a double: the relative error of one rounded operation.
inline constexpr double kRoundoff = std::numeric_limits<double>::epsilon() / 2;

inline constexpr double degrees(double radians) { return radians * (180.0 / kPi); }
inline constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }

// sqrt(x^2 + y^2), to a few roundings; lengths here are far from overflow, where std::hypot would earn its
// price.
inline double hypotenuse(double x, double y) { return std::sqrt(x * x + y * y); }

// Axis-parallel box in space; empty when lo > hi.
struct Box3 {
  Vec3 lo = Vec3::Constant(kInfinity);
  Vec3 hi = Vec3::Constant(-kInfinity);

  void extend(const Vec3& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  void extend(const Box3& b) {
    lo = lo.cwiseMin(b.lo);
    hi = hi.cwiseMax(b.hi);
  }
  bool empty() const { return (lo.array() > hi.array()).any(); }
  bool meets(const Box3& b) const {
    return (lo.array() <= b.hi.array()).all() && (b.lo.array() <= hi.array()).all();
  }
  bool contains(const Vec3& p) const {
    return (lo.array() <= p.array()).all() && (p.array() <= hi.array()).all();
  }
  Vec3 center() const { return 0.5 * (lo + hi); }
  double diagonal() const { return empty() ? 0.0 : (hi - lo).norm(); }
};

// Rectangle in a surface's parameter plane.
struct ParamBox {
  double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
  double u_mid() const { return 0.5 * (u0 + u1); }
  double v_mid() const { return 0.5 * (v0 + v1); }
};

}  // namespace mpm
