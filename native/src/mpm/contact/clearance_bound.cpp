#include "mpm/contact/clearance_bound.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kBoundRoundoff = 1024 * kRoundoff;
constexpr double kTangentShare = 0.25;  // q below: how much of the minor circle's curvature pays for the rest

// Least value of f + g a + h a^2 over a in [-1, 1].
double least_on_edge(double f, double g, double h) {
  const double slope = std::abs(g);
  return slope < 2 * h ? f - g * g / (4 * h) : f + h - slope;
}

}  // namespace

double least_quadratic(double f, double g1, double g2, double h11, double h12, double h22) {
  const double det = 4 * h11 * h22 - h12 * h12;
  if (h11 > 0 && det > 0) {
    const double a = (h12 * g2 - 2 * h22 * g1) / det, b = (h12 * g1 - 2 * h11 * g2) / det;
    if (std::abs(a) <= 1 && std::abs(b) <= 1) return f + 0.5 * (g1 * a + g2 * b);
  }
  const double left = least_on_edge(f - g1 + h11, g2 - h12, h22),
               right = least_on_edge(f + g1 + h11, g2 + h12, h22);
  const double low = least_on_edge(f - g2 + h22, g1 - h12, h11),
               high = least_on_edge(f + g2 + h22, g1 + h12, h11);
  return std::min(std::min(left, right), std::min(low, high));
}

ClearanceBound::ClearanceBound(const Tool& tool, const ToolPose& pose) : tool_(tool), pose_(pose) {
  rounding_ = kBoundRoundoff * (pose.torus_center.cwiseAbs().maxCoeff() + tool.length() + tool.reach());
}

ClearanceBound::Answer ClearanceBound::operator()(const QuadraticCell& cell, double enough) const {
  const Vec3 x = cell.c - pose_.torus_center;
  Meridian at;
  at.z = x.dot(pose_.axis);
  const Vec3 radial = x - at.z * pose_.axis;
  at.r = radial.norm();
  const double to_circle = std::hypot(at.r - tool_.major_radius, at.z);
  const double ring = to_circle - tool_.minor_radius;
  Answer answer{ring - cell.radius, ring};
  if (answer.lower < enough && at.r > cell.radius) {
    at.radial = radial / at.r;
    answer.lower = std::max(answer.lower, ring_second_order(cell, at, to_circle));
  } else if (at.r > 0) {
    at.radial = radial / at.r;
  } else {
    at.radial = pose_.axis.unitOrthogonal();
  }
  answer.lower -= rounding_;
  if (answer.lower < enough && answer.center < -cell.radius) return answer;  // hopeless as a whole
  double top = tool_.flute_length - tool_.minor_radius;
  const auto include = [&](double r0, double r1, double z0, double z1) {
    double center = 0;
    answer.lower = std::min(answer.lower, convex_piece(cell, at, r0, r1, z0, z1, enough, center) - rounding_);
    answer.center = std::min(answer.center, center);
  };
  include(tool_.radius(), tool_.radius(), 0.0, top);
  if (tool_.recess < tool_.minor_radius)
    include(tool_.major_radius, tool_.major_radius, tool_.recess - tool_.minor_radius, 0.0);
  for (const ToolSegment& s : tool_.segments) {
    include(s.bottom_radius, s.top_radius, top, top + s.length);
    top += s.length;
  }
  return answer;
}

// Distance from the major circle along the cell, bounded below by a quadratic in a and b. With the centre at
// radius r0 and distance D0 from the circle, and a displacement split along the gradient n, the meridian
// tangent t and the ring's tangent p, no larger than R:
//   D >= D0 + dn + k_p dp^2 + k_t (dt + e)^2,  k_t = 1 / (2 (D0 + R)),  k_p = n_r / (2 (r0 +- R)),
// the sign of n_r choosing the side that is safe (inside the ring n_r < 0: the tool curves towards the
// surface there) and e what the surface's bending and the ring's curvature add along t. (dt + e)^2 >= (1 - q)
// dt^2 - (1/q - 1) e^2 costs only fourth order.
double ClearanceBound::ring_second_order(const QuadraticCell& cell,
                                         const Meridian& at,
                                         double distance) const {
  const double reach = cell.radius;
  const Vec3& axis = pose_.axis;
  const Vec3 around = axis.cross(at.radial);
  const double nr = (at.r - tool_.major_radius) / distance, nz = at.z / distance;
  const Vec3 n = nr * at.radial + nz * axis, t = nr * axis - nz * at.radial;
  const double kp = nr >= 0 ? nr / (2 * (at.r + reach)) : nr / (2 * (at.r - reach));
  const double kt = 1 / (2 * (distance + reach));

  const double pA = around.dot(cell.A), pB = around.dot(cell.B), tA = t.dot(cell.A), tB = t.dot(cell.B);
  const double p_linear = std::abs(pA) + std::abs(pB);
  const double p_rest =
      std::abs(around.dot(cell.C)) + std::abs(around.dot(cell.E)) + std::abs(around.dot(cell.F));
  const double t_rest = std::abs(t.dot(cell.C)) + std::abs(t.dot(cell.E)) + std::abs(t.dot(cell.F));
  const double p_most = p_linear + p_rest;
  const double bulge =
      p_most * p_most / (2 * (at.r - reach));  // how much the ring's curvature adds to the radius
  const double p_loss = std::abs(kp) * (2 * p_linear * p_rest + (kp < 0 ? p_rest * p_rest : 0.0));
  const double gA = n.dot(cell.A), gB = n.dot(cell.B);
  const double t_extra = t_rest + std::abs(nz) * bulge;
  const double t_loss = kt * (1 / kTangentShare - 1) * t_extra * t_extra;
  const double kt_kept = kt * (1 - kTangentShare);
  const auto bound = [&](double loss, double k) {
    return least_quadratic(distance - tool_.minor_radius - cell.error - p_loss - loss,
                           gA,
                           gB,
                           n.dot(cell.C) + kp * pA * pA + k * tA * tA,
                           n.dot(cell.E) + 2 * (kp * pA * pB + k * tA * tB),
                           n.dot(cell.F) + kp * pB * pB + k * tB * tB);
  };
  const double whole = bound(kt * 2 * (std::abs(tA) + std::abs(tB)) * t_extra, kt);
  return std::max(whole, bound(t_loss, kt_kept));
}

// A convex piece of the body: its signed distance is convex, so a supporting plane at the centre bounds it
// from below.
double ClearanceBound::convex_piece(const QuadraticCell& cell,
                                    const Meridian& at,
                                    double bottom_radius,
                                    double top_radius,
                                    double z0,
                                    double z1,
                                    double enough,
                                    double& center) const {
  const ConeDistance d = cone_distance(at.r, at.z, bottom_radius, top_radius, z0, z1);
  center = d.distance;
  const double first = d.distance - cell.radius;
  if (first >= enough) return first;
  const Vec3 n = d.slope_r * at.radial + d.slope_z * pose_.axis;
  return std::max(first,
                  least_quadratic(d.distance - cell.error,
                                  n.dot(cell.A),
                                  n.dot(cell.B),
                                  n.dot(cell.C),
                                  n.dot(cell.E),
                                  n.dot(cell.F)));
}

}  // namespace mpm
