#include "mpm/contact/clearance_bound.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/instruction_set.h"

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
      kernel_(widest(kRingKernels)),
      frame_{{pose.torus_center.x(), pose.torus_center.y(), pose.torus_center.z()},
             {pose.axis.x(), pose.axis.y(), pose.axis.z()},
             tool.major_radius,
             tool.minor_radius,
             kBoundRoundoff * (pose.torus_center.cwiseAbs().maxCoeff() + tool.length() + tool.reach()),
             std::min(0.0, tool.recess - tool.minor_radius),
             tool.reach()} {}

ClearanceBound::Meridian ClearanceBound::meridian(const Vec3& s) const {
  const Vec3 x = s - pose_.torus_center;
  Meridian at;
  at.z = x.dot(pose_.axis);
  const Vec3 radial = x - at.z * pose_.axis;
  at.r = radial.norm();
  at.radial = at.r > 0 ? Vec3(radial / at.r) : pose_.axis.unitOrthogonal();
  return at;
}

ClearanceBound::Answer ClearanceBound::pieces(const QuadraticCell& cell, double enough) const {
  const Meridian at = meridian(cell.c);
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
