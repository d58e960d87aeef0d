#include "mpm/contact/motion_bound.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mpm/contact/clearance_bound.h"

namespace mpm {
namespace {

// A bound here takes some 700 rounded operations, a stretch's pose some 60 (docs/numerics.md).
constexpr double kMotionRoundoff = 4096 * kRoundoff;
// Part of the largest second-order coefficient below which a pivot counts as zero: far above the rounding of
// the elimination, far below what any clearance feels.
constexpr double kFlat = 1e-9;
// What the cube may grow by for unknowns of which T is linear; beyond it the old ones are kept.
constexpr double kMostGrowth = 0.5;

double least_on_face(const Quadratic3& q, int i, double x) {
  // Indices of h for the squares and for the products of each unknown with the two others.
  constexpr int square[3] = {0, 2, 5}, product[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};
  const int j = i == 0 ? 1 : 0, k = i == 2 ? 1 : 2;
  return least_quadratic(q.f + x * q.g[i] + x * x * q.h[square[i]],
                         q.g[j] + x * q.h[product[i][j]],
                         q.g[k] + x * q.h[product[i][k]],
                         q.h[square[j]],
                         q.h[product[j][k]],
                         q.h[square[k]]);
}

double least_on_faces(const Quadratic3& q) {
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) least = std::min({least, least_on_face(q, i, -1.0), least_on_face(q, i, 1.0)});
  return least;
}

// Rotation by `angle` about the unit vector k of a vector at right angles to k.
Vec3 turned(const Vec3& v, const Vec3& sideways, double angle) {
  return (std::cos(angle) * v + std::sin(angle) * sideways).normalized();
}

// Indices of the unknowns that each second-order term multiplies.
constexpr int kRow[6] = {0, 0, 1, 0, 1, 2}, kColumn[6] = {0, 1, 1, 2, 2, 2};
constexpr double times(int term) { return kRow[term] == kColumn[term] ? 1 : 2; }

// A displacement along the radius, the gradient n, the meridian's tangent t and the ring's tangent p.
struct Component {
  double r = 0, n = 0, t = 0, p = 0;

  void add_size(const Component& c) {
    r += std::abs(c.r), n += std::abs(c.n), t += std::abs(c.t), p += std::abs(c.p);
  }
};

// Of a moving cell's coefficients; `linear` and `rest` bound the sum of all first and all others.
struct Components {
  std::array<Component, 3> first;
  std::array<Component, 6> second;
  Component linear, rest;
};

Components components(
    const MovingCell& cell, const Vec3& radial, const Vec3& axis, const Vec3& around, double nr, double nz) {
  Components x;
  const auto split = [&](const Vec3& v) -> Component {
    const double r = radial.dot(v), z = axis.dot(v);
    return {r, nr * r + nz * z, nr * z - nz * r, around.dot(v)};
  };
  for (int i = 0; i < 3; ++i) x.linear.add_size(x.first[i] = split(cell.first[i]));
  for (int i = 0; i < 6; ++i) x.rest.add_size(x.second[i] = split(cell.second[i]));
  return x;
}

// T = t x + sum_(i<=j) h_ij x_i x_j, to within `off`: how far a point is from where the ring is nearest,
// along the meridian.
struct Bend {
  std::array<double, 3> t;
  std::array<double, 6> h;
  double off;
};

void add_square(Quadratic3& q, const std::array<double, 3>& t, double factor) {
  for (int i = 0; i < 6; ++i) q.h[i] += factor * times(i) * t[kRow[i]] * t[kColumn[i]];
}

// The symmetric matrix of a quadratic form, times d.
Vec3 times_matrix(const std::array<double, 6>& h, const Vec3& d) {
  return {h[0] * d[0] + 0.5 * (h[1] * d[1] + h[3] * d[2]),
          h[2] * d[1] + 0.5 * (h[1] * d[0] + h[4] * d[2]),
          h[5] * d[2] + 0.5 * (h[3] * d[0] + h[4] * d[1])};
}

// (S + o)^2 >= keep S^2 - loss for all |S| <= straight, |o| <= off: of (1 - e) S^2 - (1 / e - 1) o^2, which
// lies below it for any e in (0, 1], the one that takes no more at the largest S and o than their product
// does.
struct Square {
  double keep, loss;
};

Square square_of(double straight, double off) {
  if (off >= straight) return {0, 0};
  return {1 - off / straight, off * (straight - off)};
}

// A quadratic below n + kt T^2, in the unknowns y = x + d T2(x), of which T is linear: t y, with t d = 1. The
// cube grows for that by what T2 comes to, and what n changes by beyond second order is taken off. Nothing
// where that takes more than `loss`, the price of staying with x.
std::optional<Quadratic3> straightened(const Quadratic3& n, const Bend& bend, double kt, double loss) {
  const Vec3 t(bend.t[0], bend.t[1], bend.t[2]), g(n.g[0], n.g[1], n.g[2]);
  double most = 0;  // of |T2|
  for (double h : bend.h) most += std::abs(h);
  const double square = t.squaredNorm();
  if (square == 0 || most * t.cwiseAbs().maxCoeff() > kMostGrowth * square) return std::nullopt;
  const Vec3 d = t / square, grown = Vec3::Ones() + most * d.cwiseAbs();
  const Vec3 n_d = times_matrix(n.h, d), bend_d = times_matrix(bend.h, d);
  const double slope = g.dot(d);
  const Square square_t = square_of(t.cwiseAbs().sum() + most, bend.off);
  const double lost =
      2 * most * n_d.cwiseAbs().dot(grown) + most * most * std::max(0.0, -n_d.dot(d)) +
      std::abs(slope) * (2 * most * bend_d.cwiseAbs().dot(grown) + most * most * std::abs(bend_d.dot(d))) +
      kt * square_t.loss;
  if (!(lost < loss)) return std::nullopt;
  Quadratic3 q = n;
  q.f -= lost;
  for (int i = 0; i < 6; ++i) q.h[i] -= slope * bend.h[i];
  add_square(q, bend.t, square_t.keep * kt);
  for (int i = 0; i < 3; ++i) q.g[i] *= grown[i];
  for (int i = 0; i < 6; ++i) q.h[i] *= grown[kRow[i]] * grown[kColumn[i]];
  return q;
}

}  // namespace

// Elimination of a, then b. A pivot that is not clearly positive is made negative, which only lowers q: then
// q has no minimum inside the cube. Otherwise q is convex, and its tangent plane at the computed critical
// point bounds it from below whatever the rounding of that point.
double least_quadratic(const Quadratic3& q) {
  const auto& [h11, h12, h22, h13, h23, h33] = q.h;
  double largest = 0;
  for (double h : q.h) largest = std::max(largest, std::abs(h));
  const double flat = kFlat * largest;
  Quadratic3 lowered = q;
  if (h11 <= flat) {
    lowered.h[0] -= std::max(h11, 0.0) + flat;
    return least_on_faces(lowered);
  }
  const double m = 0.5 / h11;
  const double k22 = h22 - 0.5 * m * h12 * h12, k23 = h23 - m * h12 * h13, k33 = h33 - 0.5 * m * h13 * h13;
  if (k22 <= flat) {
    lowered.h[2] -= std::max(k22, 0.0) + flat;
    return least_on_faces(lowered);
  }
  const double n = 0.5 / k22, pivot = k33 - 0.5 * n * k23 * k23;
  if (pivot <= flat) {
    lowered.h[5] -= std::max(pivot, 0.0) + flat;
    return least_on_faces(lowered);
  }
  const double r2 = q.g[1] - m * h12 * q.g[0], r3 = q.g[2] - m * h13 * q.g[0] - n * k23 * r2;
  const double t = -0.5 * r3 / pivot, b = -n * (r2 + k23 * t), a = -m * (q.g[0] + h12 * b + h13 * t);
  if (std::max({std::abs(a), std::abs(b), std::abs(t)}) > 1) return least_on_faces(q);
  const double slope_a = q.g[0] + 2 * h11 * a + h12 * b + h13 * t;
  const double slope_b = q.g[1] + h12 * a + 2 * h22 * b + h23 * t;
  const double slope_t = q.g[2] + h13 * a + h23 * b + 2 * h33 * t;
  const double value = q.f + 0.5 * ((q.g[0] + slope_a) * a + (q.g[1] + slope_b) * b + (q.g[2] + slope_t) * t);
  return value - 2 * (std::abs(slope_a) + std::abs(slope_b) + std::abs(slope_t));
}

ToolMotion::ToolMotion(const Tool& tool, const ToolPose& from, const ToolPose& to)
    : minor_radius_(tool.minor_radius),
      from_(from.tip(tool)),
      to_(to.tip(tool)),
      axis_(from.axis.normalized()) {
  const Vec3 end = to.axis.normalized(), across = axis_.cross(end);
  const double sine = across.norm();
  turn_ = std::atan2(sine, axis_.dot(end));
  pivot_ = sine > 0 ? Vec3(across / sine) : axis_.unitOrthogonal();
  sideways_ = pivot_.cross(axis_);
}

ToolMotion::Stretch ToolMotion::stretch(double t0, double t1) const {
  const double t = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0);
  const Vec3 tip = (1 - t) * from_ + t * to_, axis = turned(axis_, sideways_, t * turn_);
  return {{tip + minor_radius_ * axis, axis}, tip, half * (to_ - from_), pivot_, half * turn_};
}

double ToolMotion::magnitude() const {
  return std::max(from_.cwiseAbs().maxCoeff(), to_.cwiseAbs().maxCoeff());
}

// What a point of the tool at x from the tip differs by, at any time, from the even way along its chord is
// zero at both ends and has a second derivative of turn^2 |x| at most: it is at most an eighth of that. The
// even ways stay between the ends' boxes.
Box3 ToolMotion::swept_box(const Tool& tool, double axis_deviation) const {
  const double lever = hypotenuse(tool.length(), tool.reach());
  const double margin = lever * (turn_ * turn_ / 8 + axis_deviation) +
                        kMotionRoundoff * (magnitude() + tool.length() + tool.reach());
  Box3 box = tool_bounds(tool, at(0.0), margin);
  box.extend(tool_bounds(tool, at(1.0), margin));
  return box;
}

// Seen from the tool a point at x from the middle tip goes to R(-t turn) (x - t step). With k the pivot,
//   R(-p) v = v - p k x v + p^2/2 k x (k x v), to within |p|^3/6 |v|.
// What the cell's own extent adds to the turn is kept to first order (the products a t and b t).
MovingCell moving_cell(const QuadraticCell& cell, const ToolMotion::Stretch& stretch, double axis_deviation) {
  const Vec3 x = cell.c - stretch.tip, &k = stretch.pivot, &step = stretch.half_step;
  const double turn = stretch.half_turn;
  const Vec3 across = k.cross(x);
  const Vec3 motion = -(step + turn * across),
             bend = turn * k.cross(step) + 0.5 * turn * turn * k.cross(across);
  const Vec3 turn_a = -turn * k.cross(cell.A), turn_b = -turn * k.cross(cell.B);
  const double span = cell.radius + step.norm(), lever = x.norm() + span;
  const double turning = turn * (cell.C.norm() + cell.E.norm() + cell.F.norm() + cell.error) +
                         0.5 * turn * turn * span + turn * turn * turn / 6 * lever;
  MovingCell moving{cell.c,
                    {cell.A, cell.B, motion},
                    {cell.C, cell.E, cell.F, turn_a, turn_b, bend},
                    cell.error + turning + axis_deviation * lever,
                    0,
                    motion.norm() + turn_a.norm() + turn_b.norm() + bend.norm() + turning,
                    axis_deviation * x.norm()};
  moving.radius = cell.radius + moving.travel + axis_deviation * lever;
  return moving;
}

MotionBound::MotionBound(const Tool& tool, const ToolPose& middle, double magnitude)
    : tool_(tool), pose_(middle), size_(magnitude + tool.length() + tool.reach()) {}

MotionBound::Answer MotionBound::operator()(const MovingCell& cell, double enough) const {
  const Vec3 x = cell.c - pose_.torus_center;
  Meridian at;
  at.z = x.dot(pose_.axis);
  const Vec3 across = x - at.z * pose_.axis;
  at.r = across.norm();
  at.radial = at.r > 0 ? Vec3(across / at.r) : pose_.axis.unitOrthogonal();
  const double rounding = kMotionRoundoff * (size_ + x.cwiseAbs().maxCoeff() + cell.radius);
  const double center = hypotenuse(at.r - tool_.major_radius, at.z) - tool_.minor_radius;
  double lower = center - cell.radius;
  if (lower < enough && at.r > cell.radius && center > -tool_.minor_radius)
    lower = std::max(lower, ring(cell, at));
  const Answer rest = pieces(cell, at, enough);
  return {std::min(lower, rest.lower) - rounding, std::min(center, rest.center)};
}

// Least of N + kt T^2 (docs/motion.md, "Bound"): N and T as ClearanceBound has them, over three unknowns.
double MotionBound::ring(const MovingCell& cell, const Meridian& at) const {
  const Vec3& axis = pose_.axis;
  const double distance = hypotenuse(at.r - tool_.major_radius, at.z);
  const double nr = (at.r - tool_.major_radius) / distance, nz = at.z / distance;
  const Components x = components(cell, at.radial, axis, axis.cross(at.radial), nr, nz);
  const double p_most = x.linear.p + x.rest.p, dr = std::min(x.linear.r + x.rest.r, cell.radius);
  const double steep = 1 / (2 * (at.r - dr)), flat = 1 / (at.r + dr + hypotenuse(at.r + dr, p_most));
  const double bulge = steep * p_most * p_most;  // steep p^2 and flat p^2 have the bulge e between them
  const double t_extra = x.rest.t + std::abs(nz) * bulge;
  const double leg = distance + x.linear.n + x.rest.n + std::abs(nr) * bulge;
  const double kt = 1 / (leg + hypotenuse(leg, x.linear.t + t_extra)), kp = nr * (nr >= 0 ? flat : steep);
  const double p_loss = std::abs(kp) * (2 * x.linear.p * x.rest.p + (kp < 0 ? x.rest.p * x.rest.p : 0.0));
  Quadratic3 n{distance - tool_.minor_radius - cell.error - p_loss, {}, {}};
  Bend bend{{}, {}, 0};
  const double w = 0.5 / at.r;
  for (int i = 0; i < 3; ++i) n.g[i] = x.first[i].n, bend.t[i] = x.first[i].t;
  for (int i = 0; i < 6; ++i) {
    const double pp = times(i) * x.first[kRow[i]].p * x.first[kColumn[i]].p;
    n.h[i] = x.second[i].n + kp * pp;
    bend.h[i] = x.second[i].t - nz * w * pp;
  }
  bend.off = std::abs(nz) *
             (p_most * p_most * std::max(steep - w, w - flat) + w * x.rest.p * (2 * x.linear.p + x.rest.p));
  const Square square = square_of(x.linear.t, t_extra);
  if (const auto straight = straightened(n, bend, kt, kt * square.loss)) return least_quadratic(*straight);
  add_square(n, bend.t, square.keep * kt);
  n.f -= kt * square.loss;
  return least_quadratic(n);
}

MotionBound::Answer MotionBound::pieces(const MovingCell& cell, const Meridian& at, double enough) const {
  Answer answer{kInfinity, kInfinity};
  // A convex piece's signed distance is convex, so a supporting plane at the centre bounds it from below.
  const auto include = [&](double r0, double r1, double z0, double z1) {
    const double below = z0 - at.z - cell.radius;
    if (below >= enough) {  // the whole cell lies below the piece all the time
      answer.lower = std::min(answer.lower, below);
      return;
    }
    const ConeDistance d = cone_distance(at.r, at.z, r0, r1, z0, z1);
    double lower = d.distance - cell.radius;
    if (lower < enough) {
      const Vec3 n = d.slope_r * at.radial + d.slope_z * pose_.axis;
      Quadratic3 q{d.distance - cell.error, {}, {}};
      for (int i = 0; i < 3; ++i) q.g[i] = n.dot(cell.first[i]);
      for (int i = 0; i < 6; ++i) q.h[i] = n.dot(cell.second[i]);
      lower = std::max(lower, least_quadratic(q));
    }
    answer.lower = std::min(answer.lower, lower);
    answer.center = std::min(answer.center, d.distance);
  };
  visit_pieces(tool_, include);
  return answer;
}

}  // namespace mpm
