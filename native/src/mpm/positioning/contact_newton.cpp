#include "mpm/positioning/contact_newton.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace mpm {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat4 = Eigen::Matrix4d;

constexpr int kExtrapolations = 8;  // halvings of the difference step; rounding rules beyond them

// A point, its upward normal, and their derivatives.
struct Local {
  Vec3 s, n, s_u, s_v, n_u, n_v;
};

Vec3 upward(const Vec3& n) { return n.z() < 0 ? Vec3(-n) : n; }

Vec6 point_and_normal(const BSplineSurface& surface, double u, double v, Counters& counters) {
  ++counters.evaluations;
  const SurfacePoint p = surface.evaluate(u, v);
  Vec6 result;
  result << p.s, upward(p.su.cross(p.sv).normalized());
  return result;
}

// Fig. 11: central differences, halved and extrapolated until two of the best agree.
template <class Function>
Vec6 richardson(const Function& f, double step, double tolerance) {
  std::array<Vec6, kExtrapolations + 1> row, before;
  for (int k = 0; k <= kExtrapolations; ++k, step /= 2) {
    row[0] = (f(step) - f(-step)) / (2 * step);
    double factor = 4;
    for (int i = 1; i <= k; ++i, factor *= 4)
      row[std::size_t(i)] =
          row[std::size_t(i - 1)] + (row[std::size_t(i - 1)] - before[std::size_t(i - 1)]) / (factor - 1);
    const std::size_t best = std::size_t(k);
    if (k > 0 && (row[best] - before[best - 1]).cwiseAbs().maxCoeff() <= tolerance) return row[best];
    before = row;
  }
  return before[kExtrapolations];
}

Local by_differences(
    const BSplineSurface& surface, double u, double v, const NewtonRules& rules, Counters& counters) {
  const ParamBox& d = surface.domain();
  const Vec6 at = point_and_normal(surface, u, v, counters);
  const Vec6 du = richardson([&](double t) { return point_and_normal(surface, u + t, v, counters); },
                             rules.step * (d.u1 - d.u0),
                             rules.step_tolerance);
  const Vec6 dv = richardson([&](double t) { return point_and_normal(surface, u, v + t, counters); },
                             rules.step * (d.v1 - d.v0),
                             rules.step_tolerance);
  return {at.head<3>(), at.tail<3>(), du.head<3>(), dv.head<3>(), du.tail<3>(), dv.tail<3>()};
}

Local exactly(const BSplineSurface& surface, double u, double v, Counters& counters) {
  ++counters.evaluations;
  const SurfacePoint p = surface.evaluate(u, v);
  const Vec3 normal = p.su.cross(p.sv);
  const double length = normal.norm();
  const Vec3 n = upward(normal / length);
  const double sign = normal.z() < 0 ? -1 : 1;
  const Vec3 along_u = sign / length * (p.suu.cross(p.sv) + p.su.cross(p.suv));
  const Vec3 along_v = sign / length * (p.suv.cross(p.sv) + p.su.cross(p.svv));
  return {p.s, n, p.su, p.sv, along_u - n * n.dot(along_u), along_v - n * n.dot(along_v)};
}

Local local(const BSplineSurface& surface, double u, double v, const NewtonRules& rules, Counters& counters) {
  return rules.analytic ? exactly(surface, u, v, counters) : by_differences(surface, u, v, rules, counters);
}

// Unit plan vector of x and its derivatives, given those of x.
struct PlanUnit {
  Vec3 r, r_u, r_v;
};
PlanUnit plan_unit(Vec3 x, Vec3 x_u, Vec3 x_v) {
  x.z() = x_u.z() = x_v.z() = 0;
  const double length = x.norm();
  const Vec3 r = x / length;
  return {r, (x_u - r * r.dot(x_u)) / length, (x_v - r * r.dot(x_v)) / length};
}

// n_r, from the contact towards the tool axis: eq. 3 from the normal where the contact is on the ring's outer
// side, eq. 8 from the contact's place where it is not.
PlanUnit radial(const Local& p, const Vec2& at) {
  const Vec3 inward(at.x() - p.s.x(), at.y() - p.s.y(), 0);
  return p.n.dot(inward) > 0 ? plan_unit(p.n, p.n_u, p.n_v) : plan_unit(inward, -p.s_u, -p.s_v);
}

bool near_face(const ParamBox& d, double u, double v) {
  const double width_u = d.u1 - d.u0, width_v = d.v1 - d.v0;
  return u >= d.u0 - width_u && u <= d.u1 + width_u && v >= d.v0 - width_v && v <= d.v1 + width_v;
}

bool inside_face(const Face& face, const TangentPoint& p) {
  const ParamBox& d = face.surface.domain();
  return p.u >= d.u0 && p.u <= d.u1 && p.v >= d.v0 && p.v <= d.v1 && face.trim.contains(p.u, p.v);
}

// Eq. 6 and 7 and their Jacobian for the unknowns u, v, beta, phi.
void tilt_equations(const Tool& tool,
                    const Insert& insert,
                    const TiltSolution& x,
                    const Local& p,
                    bool printed,
                    Vec4& f,
                    Mat4& jacobian) {
  const double ri = tool.minor_radius, ro = tool.major_radius;
  const ToolPose pose = tilted(tool, insert, x.beta);
  const Vec3 &axis = pose.axis, &center = pose.torus_center;
  const Vec3 across = (center - insert.center) / ro;  // v1 after the tilt; the axis' derivative
  const double c = std::cos(x.phi), s = std::sin(x.phi);
  f.head<3>() = p.s + ri * p.n - (insert.center + ro * ((1 + s) * across + c * insert.u1));
  jacobian.block<3, 1>(0, 0) = p.s_u + ri * p.n_u;
  jacobian.block<3, 1>(0, 1) = p.s_v + ri * p.n_v;
  jacobian.block<3, 1>(0, 2) = ro * (1 + s) * axis;
  jacobian.block<3, 1>(0, 3) = -ro * (c * across - s * insert.u1);
  const Vec3 to_center = center - p.s, normal = axis.cross(p.n);
  f(3) = normal.dot(to_center);
  const Vec3 by_beta = -ro * axis;
  const Vec3 extra = printed ? center : Vec3(Vec3::Zero());  // the print's surplus N in d/du and d/dv
  jacobian(3, 0) = axis.cross(p.n_u).dot(to_center) + normal.dot(extra - p.s_u);
  jacobian(3, 1) = axis.cross(p.n_v).dot(to_center) + normal.dot(extra - p.s_v);
  jacobian(3, 2) = across.cross(p.n).dot(to_center) + normal.dot(printed ? Vec3(by_beta - p.s) : by_beta);
  jacobian(3, 3) = 0;
}

}  // namespace

std::optional<DropSolution> solve_drop(const SurfaceModel& model,
                                       const Tool& tool,
                                       const Vec2& at,
                                       const NewtonRules& rules,
                                       DropSolution x,
                                       Counters& counters) {
  const Face& face = model.faces()[x.contact.face];
  ++counters.seeds;
  for (int i = 0; i <= rules.iterations; ++i) {
    const Local p = local(face.surface, x.contact.u, x.contact.v, rules, counters);
    const PlanUnit nr = radial(p, at);
    const double ri = tool.minor_radius, ro = tool.major_radius;
    const Vec3 f = p.s + ri * p.n + ro * nr.r - Vec3(at.x(), at.y(), x.height);
    if (!f.allFinite()) return {};
    x.contact.s = p.s, x.contact.n = p.n;
    if (f.norm() <= rules.tolerance) return inside_face(face, x.contact) ? std::optional(x) : std::nullopt;
    Mat3 jacobian;
    jacobian << p.s_u + ri * p.n_u + ro * nr.r_u, p.s_v + ri * p.n_v + ro * nr.r_v, -Vec3::UnitZ();
    const Vec3 step = jacobian.fullPivLu().solve(f);
    ++counters.newton_steps;
    x.contact.u -= step(0), x.contact.v -= step(1), x.height -= step(2);
    if (!near_face(face.surface.domain(), x.contact.u, x.contact.v)) return {};
  }
  return {};
}

std::optional<TiltSolution> solve_tilt(const SurfaceModel& model,
                                       const Tool& tool,
                                       const Insert& insert,
                                       const NewtonRules& rules,
                                       TiltSolution x,
                                       Counters& counters) {
  const Face& face = model.faces()[x.contact.face];
  ++counters.seeds;
  for (int i = 0; i <= rules.iterations; ++i) {
    const Local p = local(face.surface, x.contact.u, x.contact.v, rules, counters);
    Vec4 f;
    Mat4 jacobian;
    tilt_equations(tool, insert, x, p, rules.printed_equation_7, f, jacobian);
    if (!f.allFinite()) return {};
    x.contact.s = p.s, x.contact.n = p.n;
    if (f.norm() <= rules.tolerance) return inside_face(face, x.contact) ? std::optional(x) : std::nullopt;
    const Vec4 step = jacobian.fullPivLu().solve(f);
    ++counters.newton_steps;
    x.contact.u -= step(0), x.contact.v -= step(1), x.beta -= step(2), x.phi -= step(3);
    if (!near_face(face.surface.domain(), x.contact.u, x.contact.v)) return {};
  }
  return {};
}

}  // namespace mpm
