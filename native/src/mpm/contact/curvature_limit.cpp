#include "mpm/contact/curvature_limit.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

// The least curvature (1/mm) along the ring with which the tool still clears the surface at the contact.
double least_ring_curvature(const Tool& tool,
                            const Insert& insert,
                            const SurfacePoint& at,
                            const PatchMinimum& contact,
                            const Vec3& normal) {
  const Vec3 across = normal.cross(insert.u1);
  const auto bending = [&](const Vec3& a, const Vec3& b, const Vec3& second) {
    return across.dot(a) * across.dot(b) / tool.minor_radius - normal.dot(second);
  };
  const double uu = bending(at.su, at.su, at.suu), vv = bending(at.sv, at.sv, at.svv);
  const double pu = insert.u1.dot(at.su), pv = insert.u1.dot(at.sv);
  if (contact.on_border_u && contact.on_border_v) return -kInfinity;
  if (contact.on_border_u) return pv == 0 ? -kInfinity : -vv / (pv * pv);
  if (contact.on_border_v) return pu == 0 ? -kInfinity : -uu / (pu * pu);
  const double uv = bending(at.su, at.sv, at.suv);
  const double across_form = pu * pu * vv - 2 * pu * pv * uv + pv * pv * uu;  // p^T adj(A) p
  return across_form > 0 ? -(uu * vv - uv * uv) / across_form : kInfinity;
}

}  // namespace

double curvature_limit(const Tool& tool,
                       const Insert& insert,
                       const SurfacePoint& at,
                       const PatchMinimum& first_contact) {
  const Vec3 normal = (insert.center - at.s).normalized();
  const double k = least_ring_curvature(tool, insert, at, first_contact, normal);
  const double fit =
      1 - k * tool.minor_radius;  // not positive: the surface bends more sharply than the insert
  if (!(fit > 0)) return 0;
  const double cosine = k * tool.major_radius / fit;
  if (!(cosine > -1)) return kInfinity;
  const double start = std::atan2(normal.dot(insert.w1), normal.dot(insert.v1));
  return cosine >= 1 ? -start : std::acos(cosine) - start;
}

}  // namespace mpm
