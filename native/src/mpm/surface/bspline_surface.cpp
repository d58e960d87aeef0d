#include "mpm/surface/bspline_surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/error.h"

namespace mpm {
namespace {

using Matrix = Eigen::MatrixXd;

void check_knots(const std::vector<double>& knots, int degree, std::size_t poles, const std::string& which) {
  require(degree >= 1 && degree <= kMaxDegree,
          "degree_" + which + " must be 1 to 10, got " + std::to_string(degree));
  require(poles >= std::size_t(degree) + 1,
          "poles: direction " + which + " needs at least degree + 1 of them");
  require(knots.size() == poles + degree + 1,
          "knots_" + which + " must have poles + degree + 1 = " + std::to_string(poles + degree + 1) +
              " entries, got " + std::to_string(knots.size()));
  for (std::size_t i = 0; i < knots.size(); ++i) {
    require(std::isfinite(knots[i]), "knots_" + which + " must be finite");
    require(i == 0 || knots[i - 1] <= knots[i], "knots_" + which + " must not decrease");
  }
  require(knots[degree] < knots[poles], "knots_" + which + ": the parameter range is empty");
  for (std::size_t i = degree + 1; i + degree < poles; ++i)
    require(knots[i] < knots[i + degree],
            "knots_" + which +
                ": an interior knot may be repeated at most degree times (the surface would break)");
}

// The (degree+1)^2 matrix that turns the poles of knot span [knots[span], knots[span+1]] into Bézier control
// points: control point k is the blossom at degree-k times the span's start and k times its end.
Matrix bezier_extraction(const std::vector<double>& knots, int degree, int span) {
  const double a = knots[span], b = knots[span + 1];
  Matrix result(degree + 1, degree + 1);
  for (int k = 0; k <= degree; ++k) {
    Matrix d = Matrix::Identity(degree + 1, degree + 1);  // row i: coefficients of de Boor point i
    for (int r = 1; r <= degree; ++r) {
      const double t = r <= degree - k ? a : b;
      for (int i = degree; i >= r; --i) {
        const double lo = knots[span - degree + i], hi = knots[span + 1 + i - r];
        const double f = (t - lo) / (hi - lo);
        d.row(i) = (1 - f) * d.row(i - 1) + f * d.row(i);
      }
    }
    result.row(k) = d.row(degree);
  }
  return result;
}

struct Span {
  int last_pole;  // index of the last pole that acts on it
  double start, end;
  Matrix extraction;
};

std::vector<Span> spans(const std::vector<double>& knots, int degree, int poles) {
  std::vector<Span> result;
  for (int i = degree; i < poles; ++i)
    if (knots[i] < knots[i + 1])
      result.push_back({i, knots[i], knots[i + 1], bezier_extraction(knots, degree, i)});
  return result;
}

std::vector<double> breaks(const std::vector<Span>& s) {
  std::vector<double> result{s.front().start};
  for (const Span& one : s) result.push_back(one.end);
  return result;
}

std::size_t interval(const std::vector<double>& breaks, double t) {
  const auto after = std::upper_bound(breaks.begin(), breaks.end(), t);
  const auto index = after - breaks.begin() - 1;
  return std::size_t(std::clamp<std::ptrdiff_t>(index, 0, std::ptrdiff_t(breaks.size()) - 2));
}

}  // namespace

BSplineSurface::BSplineSurface(int degree_u,
                               int degree_v,
                               const std::vector<double>& knots_u,
                               const std::vector<double>& knots_v,
                               const std::vector<Vec3>& poles,
                               const std::vector<double>& weights)
    : degree_u_(degree_u), degree_v_(degree_v) {
  const std::size_t nu = knots_u.size() - std::min(knots_u.size(), std::size_t(degree_u + 1));
  const std::size_t nv = knots_v.size() - std::min(knots_v.size(), std::size_t(degree_v + 1));
  require(poles.size() == nu * nv, "poles: need (knots_u - degree_u - 1) x (knots_v - degree_v - 1) points");
  check_knots(knots_u, degree_u, nu, "u");
  check_knots(knots_v, degree_v, nv, "v");
  require(weights.empty() || weights.size() == poles.size(), "weights: need one a pole, or none");
  for (const Vec3& p : poles) require(p.allFinite(), "poles must be finite");
  for (double w : weights) require(std::isfinite(w) && w > 0, "weights must be positive and finite");

  const std::vector<Span> us = spans(knots_u, degree_u, int(nu)), vs = spans(knots_v, degree_v, int(nv));
  breaks_u_ = breaks(us);
  breaks_v_ = breaks(vs);
  domain_ = {breaks_u_.front(), breaks_u_.back(), breaks_v_.front(), breaks_v_.back()};

  const auto homogeneous = [&](std::size_t i, std::size_t j) {
    const double w = weights.empty() ? 1.0 : weights[i * nv + j];
    Vec4 h;
    h << w * poles[i * nv + j], w;
    return h;
  };
  patches_.reserve(us.size() * vs.size());
  for (const Span& u : us) {
    for (const Span& v : vs) {
      std::vector<Vec4> half((degree_u + 1) * (degree_v + 1), Vec4::Zero()), control = half;
      const int columns = degree_v + 1;
      for (int k = 0; k <= degree_u; ++k)
        for (int i = 0; i <= degree_u; ++i) {
          const double f = u.extraction(k, i);
          if (f == 0.0) continue;
          for (int j = 0; j < columns; ++j)
            half[k * columns + j] += f * homogeneous(u.last_pole - degree_u + i, v.last_pole - degree_v + j);
        }
      for (int k = 0; k <= degree_u; ++k)
        for (int l = 0; l < columns; ++l)
          for (int j = 0; j < columns; ++j)
            control[k * columns + l] += v.extraction(l, j) * half[k * columns + j];
      if (weights.empty())
        for (Vec4& c : control) c.w() = 1.0;  // the rows sum to one; without this, only to rounding
      patches_.emplace_back(degree_u, degree_v, ParamBox{u.start, u.end, v.start, v.end}, std::move(control));
    }
  }
}

const BezierPatch& BSplineSurface::patch_at(double u, double v) const {
  return patches_[interval(breaks_u_, u) * (breaks_v_.size() - 1) + interval(breaks_v_, v)];
}

}  // namespace mpm
