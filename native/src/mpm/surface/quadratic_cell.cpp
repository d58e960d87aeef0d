#include "mpm/surface/quadratic_cell.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mpm {
namespace {

// Rounding of the few hundred operations behind a cell, relative to the size of its coordinates
// (docs/numerics.md).
constexpr double kCellRoundoff = 1024 * kRoundoff;

double magnitude(const BezierPatch& part) {
  double largest = 0;
  for (const Vec4& c : part.control()) largest = std::max(largest, c.head<3>().cwiseAbs().maxCoeff() / c.w());
  return largest;
}

double binomial(int n, int k) {
  double result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

// Largest norm of the (i, j)-th mixed derivative's control points: head<3> relative to `origin` times w, and
// of w.
struct DerivativeNorms {
  double point = 0, weight = 0;
};

DerivativeNorms derivative_norms(const BezierPatch& part, int du, int dv, const Vec3& origin) {
  const int p = part.degree_u(), q = part.degree_v();
  if (du > p || dv > q) return {};
  std::vector<Vec4> net = part.control();
  for (Vec4& c : net) c.head<3>() -= c.w() * origin;
  const int columns = q + 1;
  double factor = 1;
  for (int k = 0; k < du; ++k) {
    for (int i = 0; i < p - k; ++i)
      for (int j = 0; j < columns; ++j)
        net[i * columns + j] = net[(i + 1) * columns + j] - net[i * columns + j];
    factor *= 0.5 * (p - k);
  }
  for (int k = 0; k < dv; ++k) {
    for (int i = 0; i <= p - du; ++i)
      for (int j = 0; j < q - k; ++j) net[i * columns + j] = net[i * columns + j + 1] - net[i * columns + j];
    factor *= 0.5 * (q - k);
  }
  DerivativeNorms norms;
  for (int i = 0; i <= p - du; ++i)
    for (int j = 0; j <= q - dv; ++j) {
      norms.point = std::max(norms.point, factor * net[i * columns + j].head<3>().norm());
      norms.weight = std::max(norms.weight, factor * std::abs(net[i * columns + j].w()));
    }
  return norms;
}

using Quadratic9 = std::array<std::array<Vec3, 3>, 3>;

// Bernstein coefficients of the cell's quadratic on the unit square, [i][j] in u and v.
Quadratic9 bernstein_net(const QuadraticCell& q) {
  // a = 2s - 1: 1 -> (1, 1, 1), a -> (-1, 0, 1), a^2 -> (1, -1, 1).
  constexpr double linear[3] = {-1, 0, 1}, square[3] = {1, -1, 1};
  Quadratic9 net;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      net[i][j] = q.c + linear[i] * q.A + linear[j] * q.B + square[i] * q.C + linear[i] * linear[j] * q.E +
                  square[j] * q.F;
  return net;
}

// Bound of |S - q| over the part, S = H / w: the control points of H - w q, over the least weight.
double error_bound(const BezierPatch& part, const QuadraticCell& cell) {
  const int p = part.degree_u(), q = part.degree_v();
  const Quadratic9 net = bernstein_net(cell);
  double least_weight = kInfinity, largest = 0;
  for (const Vec4& c : part.control()) least_weight = std::min(least_weight, c.w());
  for (int k = 0; k <= p + 2; ++k)
    for (int l = 0; l <= q + 2; ++l) {
      Vec3 sum = Vec3::Zero();
      for (int i = std::max(0, k - 2); i <= std::min(p, k); ++i)
        for (int j = std::max(0, l - 2); j <= std::min(q, l); ++j) {
          const double f = binomial(p, i) * binomial(2, k - i) / binomial(p + 2, k) * binomial(q, j) *
                           binomial(2, l - j) / binomial(q + 2, l);
          const Vec4& h = part.control(i, j);
          sum += f * (h.head<3>() - h.w() * net[k - i][l - j]);
        }
      largest = std::max(largest, sum.norm());
    }
  return largest / least_weight;
}

}  // namespace

void put_lane(CellBatch& batch, int lane, const QuadraticCell& cell) {
  const Vec3* terms[] = {&cell.c, &cell.A, &cell.B, &cell.C, &cell.E, &cell.F};
  for (int t = 0; t < 6; ++t)
    for (int k = 0; k < 3; ++k) batch.term[t][k][lane] = (*terms[t])[k];
  batch.error[lane] = cell.error, batch.radius[lane] = cell.radius;
}

QuadraticCell get_lane(const CellBatch& batch, int lane) {
  const auto term = [&](CellBatch::Term t) -> Vec3 {
    return {batch.term[t][0][lane], batch.term[t][1][lane], batch.term[t][2][lane]};
  };
  return {term(CellBatch::center),
          term(CellBatch::a),
          term(CellBatch::b),
          term(CellBatch::aa),
          term(CellBatch::ab),
          term(CellBatch::bb),
          batch.error[lane],
          batch.radius[lane]};
}

double third_derivative_bound(const BezierPatch& part) {
  const Vec3 origin = part.point(part.box().u_mid(), part.box().v_mid());
  double least_weight = kInfinity;
  for (const Vec4& c : part.control()) least_weight = std::min(least_weight, c.w());
  // Along x = (a, b), |a|, |b| <= 1, the k-th derivative is bounded by the binomially weighted sum of the
  // mixed ones.
  std::array<DerivativeNorms, 4> order{};
  for (int k = 0; k <= 3; ++k)
    for (int i = 0; i <= k; ++i) {
      const DerivativeNorms n = derivative_norms(part, i, k - i, origin);
      order[k].point += binomial(k, i) * n.point;
      order[k].weight += binomial(k, i) * n.weight;
    }
  if (!part.rational()) return order[3].point;
  // Quotient rule, order by order: w S^(k) = H^(k) - sum_i binom(k, i) w^(i) S^(k-i).
  std::array<double, 4> s{};
  for (int k = 0; k <= 3; ++k) {
    s[k] = order[k].point;
    for (int i = 1; i <= k; ++i) s[k] += binomial(k, i) * order[i].weight * s[k - i];
    s[k] /= least_weight;
  }
  return s[3];
}

QuadraticCell interpolating_cell(const BezierPatch& part) {
  const ParamBox& box = part.box();
  const double us[3] = {box.u0, box.u_mid(), box.u1}, vs[3] = {box.v0, box.v_mid(), box.v1};
  Vec3 s[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s[i][j] = part.point(us[i], vs[j]);
  QuadraticCell cell;
  cell.c = s[1][1];
  cell.A = 0.5 * (s[2][1] - s[0][1]);
  cell.B = 0.5 * (s[1][2] - s[1][0]);
  cell.C = 0.5 * (s[2][1] + s[0][1]) - cell.c;
  cell.F = 0.5 * (s[1][2] + s[1][0]) - cell.c;
  cell.E = 0.25 * (s[2][2] - s[2][0] - s[0][2] + s[0][0]);
  cell.error = error_bound(part, cell) + kCellRoundoff * magnitude(part);
  cell.set_radius();
  return cell;
}

QuadraticCell taylor_cell(const BezierPatch& patch, const ParamBox& box, double third) {
  const double hu = 0.5 * (box.u1 - box.u0), hv = 0.5 * (box.v1 - box.v0);
  const SurfacePoint p = patch.evaluate(box.u_mid(), box.v_mid());
  QuadraticCell cell{
      p.s, hu * p.su, hv * p.sv, 0.5 * hu * hu * p.suu, hu * hv * p.suv, 0.5 * hv * hv * p.svv, 0, 0};
  cell.error = third / 6 + kCellRoundoff * p.s.cwiseAbs().maxCoeff();
  cell.set_radius();
  return cell;
}

double distance_from(
    const QuadraticCell& inner, const QuadraticCell& outer, double a0, double ka, double b0, double kb) {
  // Coefficients of outer(a0 + ka a', b0 + kb b').
  const Vec3 c =
      outer.c + a0 * outer.A + b0 * outer.B + a0 * a0 * outer.C + a0 * b0 * outer.E + b0 * b0 * outer.F;
  const Vec3 A = ka * (outer.A + 2 * a0 * outer.C + b0 * outer.E);
  const Vec3 B = kb * (outer.B + 2 * b0 * outer.F + a0 * outer.E);
  return inner.error + (inner.c - c).norm() + (inner.A - A).norm() + (inner.B - B).norm() +
         (inner.C - ka * ka * outer.C).norm() + (inner.E - ka * kb * outer.E).norm() +
         (inner.F - kb * kb * outer.F).norm();
}

}  // namespace mpm
