// Newton for a vertical ray against a surface: two equations, two unknowns (thesis eq. 9 and 10).
#pragma once

#include <cmath>
#include <cstdint>

#include "mpm/surface/surface_model.h"

namespace mpm {

// A turn of the surface about a point: s -> center + turn (s - center).
struct SurfaceTurn {
  Mat3 turn = Mat3::Identity();
  Vec3 center = Vec3::Zero();

  Vec3 operator()(const Vec3& s) const { return center + turn * (s - center); }
};

struct RayLimits {
  double tolerance;  // mm in plan
  int steps;         // Newton steps at most
};

struct RayWork {
  std::uint64_t evaluations = 0, steps = 0;
};

// Finds where the turned surface meets the vertical line through plan point `at` (set-up frame, mm), from the
// parameters in (u, v). True: found inside the face and its trim; (u, v) and s (turned) are the answer.
// False: the ray misses the face or Newton did not converge; (u, v) is then unchanged.
inline bool meet_vertical_ray(const Face& face,
                              const SurfaceTurn& turned,
                              const Vec2& at,
                              const RayLimits& limits,
                              double& u,
                              double& v,
                              Vec3& s,
                              RayWork& work) {
  const ParamBox& d = face.surface.domain();
  const double width_u = d.u1 - d.u0, width_v = d.v1 - d.v0;
  double a = u, b = v;
  for (int i = 0; i <= limits.steps; ++i) {
    const SurfacePoint p = face.surface.evaluate(a, b);
    ++work.evaluations;
    s = turned(p.s);
    const Vec2 off = s.head<2>() - at;
    if (off.norm() <= limits.tolerance) {
      const bool inside = a >= d.u0 && a <= d.u1 && b >= d.v0 && b <= d.v1 && face.trim.contains(a, b);
      if (inside) u = a, v = b;
      return inside;
    }
    const Vec2 x = (turned.turn * p.su).head<2>(), y = (turned.turn * p.sv).head<2>();
    const double det = x.x() * y.y() - x.y() * y.x();
    if (det == 0 || !std::isfinite(det)) return false;
    a -= (off.x() * y.y() - off.y() * y.x()) / det;
    b -= (x.x() * off.y() - x.y() * off.x()) / det;
    ++work.steps;
    // A whole face away: the polynomial's continuation says nothing about the face any more.
    if (!(a >= d.u0 - width_u && a <= d.u1 + width_u && b >= d.v0 - width_v && b <= d.v1 + width_v))
      return false;
  }
  return false;
}

}  // namespace mpm
