#include "mpm/contact/clearance_bound.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kBoundRoundoff = 1024 * kRoundoff;
constexpr double kSingular = 1e-14;  // relative; a Hessian nearer to singular counts as singular

// Least value of f + g a + h a^2 over a in [-1, 1].
double least_on_edge(double f, double g, double h) {
  const double slope = std::abs(g);
  return slope < 2 * h ? f - g * g / (4 * h) : f + h - slope;
}

}  // namespace

// A convex quadratic lies above its tangent plane at any point, so the minimum need not be met exactly: what
// the slope found there could still gain is taken off.
double least_quadratic(double f, double g1, double g2, double h11, double h12, double h22) {
  const double product = 4 * h11 * h22, square = h12 * h12, det = product - square;
  if (h11 > 0 && det > kSingular * (std::abs(product) + square)) {
    const double a = (h12 * g2 - 2 * h22 * g1) / det, b = (h12 * g1 - 2 * h11 * g2) / det;
    if (std::abs(a) <= 1 && std::abs(b) <= 1) {
      const double slope_a = g1 + 2 * h11 * a + h12 * b, slope_b = g2 + h12 * a + 2 * h22 * b;
      return f + a * (g1 + h11 * a + h12 * b) + b * (g2 + h22 * b) - std::abs(slope_a) * (1 + std::abs(a)) -
             std::abs(slope_b) * (1 + std::abs(b));
    }
  }
  const double left = least_on_edge(f - g1 + h11, g2 - h12, h22),
               right = least_on_edge(f + g1 + h11, g2 + h12, h22);
  const double low = least_on_edge(f - g2 + h22, g1 - h12, h11),
               high = least_on_edge(f + g2 + h22, g1 + h12, h11);
  return std::min(std::min(left, right), std::min(low, high));
}

ClearanceBound::ClearanceBound(const Tool& tool, const ToolPose& pose)
    : tool_(tool),
      pose_(pose),
      kernel_(ring_kernel()),
      frame_{{pose.torus_center.x(), pose.torus_center.y(), pose.torus_center.z()},
             {pose.axis.x(), pose.axis.y(), pose.axis.z()},
             tool.major_radius,
             tool.minor_radius,
             kBoundRoundoff * (pose.torus_center.cwiseAbs().maxCoeff() + tool.length() + tool.reach()),
             std::min(0.0, tool.recess - tool.minor_radius)} {}

ClearanceBound::Meridian ClearanceBound::meridian(const Vec3& s) const {
  const Vec3 x = s - pose_.torus_center;
  Meridian at;
  at.z = x.dot(pose_.axis);
  const Vec3 radial = x - at.z * pose_.axis;
  at.r = radial.norm();
  at.radial = at.r > 0 ? Vec3(radial / at.r) : pose_.axis.unitOrthogonal();
  return at;
}

ClearanceBound::Answer ClearanceBound::operator()(const QuadraticCell& cell, double enough) const {
  const Meridian at = meridian(cell.c);
  const double ring_center = hypotenuse(at.r - tool_.major_radius, at.z) - tool_.minor_radius;
  Answer answer{ring_center - cell.radius, ring_center};
  if (answer.lower < enough && at.r > cell.radius) {
    const QuadraticBound q = ring(cell, at);
    answer.lower = std::max(answer.lower, least_quadratic(q.f - q.loss, q.g1, q.g2, q.h11, q.h12, q.h22));
  }
  answer.lower -= frame_.rounding;
  const Answer rest = pieces(cell, at, enough);
  return {std::min(answer.lower, rest.lower), std::min(answer.center, rest.center)};
}

QuadraticBound ClearanceBound::ring(const QuadraticCell& cell) const { return ring(cell, meridian(cell.c)); }

ClearanceBound::Answer ClearanceBound::pieces(const QuadraticCell& cell, double enough) const {
  return pieces(cell, meridian(cell.c), enough);
}

// Distance from the major circle along the cell, bounded below by a quadratic in a and b. With the centre at
// radius r0 and distance D0 from the circle, and a displacement split along the gradient n, the meridian
// tangent t and the ring's tangent p:
//   D = hypot(D0 + dn + n_r e, dt + t_r e) >= D0 + dn + k_p dp^2 + k_t (dt + t_r e)^2,
// where e, the radius that dp adds, lies between dp^2 / (2 (greatest radius)) and dp^2 / (2 (least radius)).
// k_t is one over the greatest sum of hypotenuse and leg; k_p is n_r times the bound of e on the safe side
// (inside the ring n_r < 0: the tool curves towards the surface there). Both squares are multiplied out: the
// products of what is linear in the cell with what bends in it (C, E, F, and e again) are cubic with known
// coefficients, and what is left of fourth order goes into the loss.
QuadraticBound ClearanceBound::ring(const QuadraticCell& cell, const Meridian& at) const {
  const Vec3& axis = pose_.axis;
  const double distance = hypotenuse(at.r - tool_.major_radius, at.z);
  const Vec3 around = axis.cross(at.radial);
  const double nr = (at.r - tool_.major_radius) / distance, nz = at.z / distance;
  // Components of the cell's vectors along the radius, n, t and the ring's tangent.
  struct Component {
    double r, n, t, p;
  };
  const auto split = [&](const Vec3& v) -> Component {
    const double r = at.radial.dot(v), z = axis.dot(v);
    return {r, nr * r + nz * z, nr * z - nz * r, around.dot(v)};
  };
  const Component A = split(cell.A), B = split(cell.B), C = split(cell.C), E = split(cell.E),
                  F = split(cell.F);
  const auto rest = [&](double Component::*k) { return std::abs(C.*k) + std::abs(E.*k) + std::abs(F.*k); };
  const auto linear = [&](double Component::*k) { return std::abs(A.*k) + std::abs(B.*k); };
  const double p_linear = linear(&Component::p), p_rest = rest(&Component::p), p_most = p_linear + p_rest;
  const double t_linear = linear(&Component::t);
  const double dr = std::min(linear(&Component::r) + rest(&Component::r), cell.radius);
  // One over twice the least, the centre's and the greatest radius.
  const double w_most = 0.5 / (at.r - dr), w = 0.5 / at.r;
  const double w_least = 1 / (at.r + dr + hypotenuse(at.r + dr, p_most));
  const double bulge = p_most * p_most * w_most;
  const double t_most = t_linear + rest(&Component::t) + std::abs(nz) * bulge;
  const double leg = distance + linear(&Component::n) + rest(&Component::n) + std::abs(nr) * bulge;
  const double kt = 1 / (leg + hypotenuse(leg, t_most));
  const double kp = nr * (nr >= 0 ? w_least : w_most);
  // The cubic terms 2 kp p_linear p_rest + 2 kt t_linear (t_rest + t_r p_linear^2 w), coefficient by
  // coefficient.
  const double bent = -nz * w;
  const double Ct = C.t + bent * A.p * A.p, Et = E.t + 2 * bent * A.p * B.p, Ft = F.t + bent * B.p * B.p;
  const double aaa = 2 * (kp * A.p * C.p + kt * A.t * Ct);
  const double aab = 2 * (kp * (A.p * E.p + B.p * C.p) + kt * (A.t * Et + B.t * Ct));
  const double abb = 2 * (kp * (A.p * F.p + B.p * E.p) + kt * (A.t * Ft + B.t * Et));
  const double bbb = 2 * (kp * B.p * F.p + kt * B.t * Ft);
  // What is left of the bulge beside p_linear^2 w.
  const double bulge_rest =
      (2 * p_linear * p_rest + p_rest * p_rest) * w_most + p_linear * p_linear * (w_most - w_least);
  return {distance - tool_.minor_radius,
          A.n,
          B.n,
          C.n + kp * A.p * A.p + kt * A.t * A.t,
          E.n + 2 * (kp * A.p * B.p + kt * A.t * B.t),
          F.n + kp * B.p * B.p + kt * B.t * B.t,
          cell.error + (kp < 0 ? -kp * p_rest * p_rest : 0.0) +
              2 * kt * t_linear * std::abs(nz) * bulge_rest + std::abs(aaa) + std::abs(aab) + std::abs(abb) +
              std::abs(bbb)};
}

ClearanceBound::Answer ClearanceBound::pieces(const QuadraticCell& cell,
                                              const Meridian& at,
                                              double enough) const {
  Answer answer{kInfinity, kInfinity};
  // A convex piece's signed distance is convex, so a supporting plane at the centre bounds it from below.
  const auto include = [&](double r0, double r1, double z0, double z1) {
    const double below = z0 - at.z - cell.radius;
    if (below >= enough) {  // the whole cell lies below the piece
      answer.lower = std::min(answer.lower, below - frame_.rounding);
      return;
    }
    const ConeDistance d = cone_distance(at.r, at.z, r0, r1, z0, z1);
    double lower = d.distance - cell.radius;
    if (lower < enough) {
      const Vec3 n = d.slope_r * at.radial + d.slope_z * pose_.axis;
      lower = std::max(lower,
                       least_quadratic(d.distance - cell.error,
                                       n.dot(cell.A),
                                       n.dot(cell.B),
                                       n.dot(cell.C),
                                       n.dot(cell.E),
                                       n.dot(cell.F)));
    }
    answer.lower = std::min(answer.lower, lower - frame_.rounding);
    answer.center = std::min(answer.center, d.distance);
  };
  visit_pieces(tool_, include);
  return answer;
}

}  // namespace mpm
