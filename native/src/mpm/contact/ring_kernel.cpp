// A kernel: compiled once for each instruction set (native/cmake/kernels.cmake).
#include "mpm/contact/ring_kernel.h"

// How many batches one vector holds.
#ifdef __AVX512DQ__
#define MPM_SIDE_BY_SIDE 2
#else
#define MPM_SIDE_BY_SIDE 1
#endif
#include "mpm/base/lanes.h"

namespace mpm::MPM_ISA {
namespace {

// Hessians nearer to singular than this, relative to their entries, count as singular (docs/numerics.md).
constexpr double kSingular = 1e-14;
// Of the cutter's radius: the second order says nothing of larger cells.
constexpr double kLargestCell = 0.4;
// Of what the bound takes off for what it does not know, so much is never met when the least clearance is
// estimated.
constexpr double kBelieved = 0.97;
// Of a cell's half-width: how far its unknowns may be shifted by the ring's bend.
constexpr double kMostShift = 0.5;

// The cells of the batches side by side.
#if MPM_SIDE_BY_SIDE == 1
struct Cells {
  const CellBatch& first;
  template <class Part>
  Lanes operator()(const Part& part) const {
    return load(part(first));
  }
};
Four half(Lanes x, int) { return x; }
#else
struct Cells {
  const CellBatch &first, &second;
  template <class Part>
  Lanes operator()(const Part& part) const {
    return __builtin_shufflevector(load(part(first)), load(part(second)), 0, 1, 2, 3, 4, 5, 6, 7);
  }
};
Four half(Lanes x, int which) {
  return which == 0 ? __builtin_shufflevector(x, x, 0, 1, 2, 3) : __builtin_shufflevector(x, x, 4, 5, 6, 7);
}
#endif

Lanes radius(const Cells& cells) {
  return cells([](const CellBatch& c) { return c.radius; });
}
Lanes error(const Cells& cells) {
  return cells([](const CellBatch& c) { return c.error; });
}
Vector load(const Cells& cells, CellBatch::Term term) {
  const auto component = [&](int i) { return cells([&](const CellBatch& c) { return c.term[term][i]; }); };
  return {component(0), component(1), component(2)};
}

// Divisions and roots take most of the time; where several are wanted, one division serves them all.

// Least value of f + g a + h a^2 over a in [-1, 1]; `fourth`: 1 / (4 h), anything where h is not positive.
Lanes least_on_edge(Lanes f, Lanes g, Lanes h, Lanes fourth) {
  const Lanes slope = absolute(g);
  return slope < 2 * h ? f - g * g * fourth : f + h - slope;
}

// Lower bound of f + g1 a + g2 b + h11 a^2 + h12 a b + h22 b^2 over the square. A convex one lies above its
// tangent plane at any point, so the minimum need not be met exactly: what the slope found there could still
// gain is taken off.
Lanes least_quadratic(
    Lanes f, Lanes g1, Lanes g2, Lanes h11, Lanes h12, Lanes h22, Lanes& at_a, Lanes& at_b) {
  const Lanes product = 4 * h11 * h22, square = h12 * h12, det = product - square;
  const Mask convex = (h11 > 0) & (det > kSingular * (absolute(product) + square));
  const Lanes d = convex ? det : all(1), ha = h11 > 0 ? h11 : all(1), hb = h22 > 0 ? h22 : all(1);
  const Lanes both = ha * hb, one = 1 / (d * both);
  const Lanes inverse = both * one;
  const Lanes a = (h12 * g2 - 2 * h22 * g1) * inverse, b = (h12 * g1 - 2 * h11 * g2) * inverse;
  const Mask inside = convex & (absolute(a) <= 1) & (absolute(b) <= 1);
  const Lanes slope_a = g1 + 2 * h11 * a + h12 * b, slope_b = g2 + h12 * a + 2 * h22 * b;
  const Lanes inner = f + a * (g1 + h11 * a + h12 * b) + b * (g2 + h22 * b) -
                      absolute(slope_a) * (1 + absolute(a)) - absolute(slope_b) * (1 + absolute(b));
  const Lanes along_a = 0.25 * d * hb * one, along_b = 0.25 * d * ha * one;
  const Lanes left = least_on_edge(f - g1 + h11, g2 - h12, h22, along_b),
              right = least_on_edge(f + g1 + h11, g2 + h12, h22, along_b);
  const Lanes low = least_on_edge(f - g2 + h22, g1 - h12, h11, along_a),
              high = least_on_edge(f + g2 + h22, g1 + h12, h11, along_a);
  const Lanes none = all(__builtin_nan(""));
  at_a = inside ? a : none, at_b = inside ? b : none;
  return inside ? inner : least(least(left, right), least(low, high));
}

// The cells' centres in the tool's half-planes.
struct Meridian {
  Vector axis, across;                // unit; mm, from the axis
  Lanes r, z, from_circle, distance;  // mm; distance: from the major circle
  Mask off_axis;                      // the whole cell keeps off the tool axis
};

Meridian meridian(const RingFrame& ring, const Cells& cells) {
  Meridian at;
  at.axis = all_of(ring.axis);
  const Vector x = load(cells, CellBatch::center) - all_of(ring.center);
  at.z = dot(x, at.axis);
  at.across = x - at.z * at.axis;
  at.r = norm(at.across);
  at.from_circle = at.r - ring.major_radius;
  at.distance = hypotenuse(at.from_circle, at.z);
  at.off_axis = at.r > radius(cells);
  return at;
}

struct Quadratic {
  Lanes f, g1, g2, h11, h12, h22, aaa, aab, abb, bbb, loss, shift;
};

// The names and the steps are explained in docs/methods/exact.md, section "The ring to second order".
Quadratic second_order(const RingFrame& ring, const Cells& cells, const Meridian& at) {
  const Lanes r = at.off_axis ? at.r : all(1), distance = at.distance, inverse_both = 1 / (r * distance);
  const Lanes inverse_r = distance * inverse_both, inverse_distance = r * inverse_both;
  const Vector radial = inverse_r * at.across, around = cross(at.axis, radial);
  const Lanes nr = at.from_circle * inverse_distance, nz = at.z * inverse_distance;
  struct Component {
    Lanes r, n, t, p;
  };
  const auto split = [&](CellBatch::Term term) -> Component {
    const Vector v = load(cells, term);
    const Lanes out = dot(radial, v), z = dot(at.axis, v);
    return {out, nr * out + nz * z, nr * z - nz * out, dot(around, v)};
  };
  const Component A = split(CellBatch::a), B = split(CellBatch::b), C = split(CellBatch::aa),
                  E = split(CellBatch::ab), F = split(CellBatch::bb);
  const auto rest = [&](Lanes Component::*k) { return absolute(C.*k) + absolute(E.*k) + absolute(F.*k); };
  const auto linear = [&](Lanes Component::*k) { return absolute(A.*k) + absolute(B.*k); };
  const Lanes p1 = linear(&Component::p), p2 = rest(&Component::p), p_most = p1 + p2;
  const Lanes t1 = linear(&Component::t), t2 = rest(&Component::t);
  const Lanes n1 = linear(&Component::n), n2 = rest(&Component::n);
  const Lanes r1 = linear(&Component::r), r2 = rest(&Component::r);
  const Lanes dr = least(r1 + r2, radius(cells));

  // The bulge e = p^2 w: w at the centre, its greatest and its least value.
  const Lanes w = 0.5 * inverse_r, x = dr * inverse_r;
  const Lanes p_square = p_most * p_most, p_mixed = (2 * p1 + p2) * p2, p1_square = p1 * p1;
  const Lanes ring_leg = r + p_square * w, ring_legs = ring_leg * (r + ring_leg);
  const Lanes least_r = r - dr, inverse_legs = 1 / (least_r * ring_legs);
  const Lanes w_most = 0.5 * ring_legs * inverse_legs, w_outside = ring_leg * least_r * inverse_legs;
  const Lanes inverse_ring_leg = (r + ring_leg) * least_r * inverse_legs;
  const Lanes w_least = w_outside - w_outside * dr * inverse_ring_leg;
  const Lanes bulge = p_square * w_most;
  const Lanes bulge_rest = p_mixed * w_most + p1_square * most(w_most - w, w - w_least);
  const Mask outside = nr >= 0;
  const Lanes kp = nr * (outside ? w_outside : w + 2 * w * x * dr * w_most);
  const Lanes kr = -nr * (outside ? w_outside * inverse_ring_leg : w * inverse_r);

  const Lanes t_most = t1 + t2 + absolute(nz) * bulge;
  // The unknowns are shifted so that what is squared with kt is linear in them; where the cell is too oblique
  // for that, they stay and what bends there is cubic.
  const Lanes zero = all(0);
  const Lanes t_rest = t2 + absolute(nz) * bulge_rest;
  const Lanes t_square = t_most * t_most, n_rest = n2 + most(nr, zero) * bulge;
  const Lanes tube_leg = distance + least(0.5 * inverse_distance * t_square, t_most);
  const Lanes tube_legs = tube_leg * (distance + tube_leg), leg = most(tube_leg - n_rest, 0.5 * tube_leg);
  const Lanes inverse_tube = 1 / (leg * tube_legs), kd = leg * inverse_tube;
  const Lanes kt = leg * kd, inverse_kt = tube_legs * tube_legs * inverse_tube;
  const Lanes bent = -nz * w, turned = -0.5 * kr * nz * inverse_kt;
  const Lanes det = A.p * B.t - B.p * A.t;
  const Lanes bend = absolute(bent) * p1_square + t_rest, shifted = bend + absolute(turned) * p1_square;
  const Lanes widest = shifted * most(absolute(A.p), absolute(B.p));
  const Mask shifts = widest < kMostShift * absolute(det);
  const Lanes inverse_det = 1 / (shifts ? det : all(1));
  const Lanes da = shifts ? B.p * inverse_det : zero, db = shifts ? A.p * inverse_det : zero;
  const Lanes shift = shifted * most(absolute(da), absolute(db)), squares_shift = shift * (2 + shift);
  const Lanes kn = A.n * da - B.n * db, bend_all = bent + turned;
  const Lanes sa = da * bend_all, sb = db * bend_all;

  const Lanes pAA = A.p * A.p, pAB = 2 * A.p * B.p, pBB = B.p * B.p;
  const Lanes tAA = A.t * A.t, tAB = 2 * A.t * B.t, tBB = B.t * B.t;
  const Lanes two_kp = 2 * kp, two_kt = shifts ? zero : 2 * kt;
  const Lanes Ct = C.t + bent * pAA, Et = E.t + bent * pAB, Ft = F.t + bent * pBB;
  // What is left of the bulge beside p1^2 w (1 - r1 / r).
  const Lanes curl = most(2 * x * dr, (1 + x) * p_square * w_most) * w_most;
  const Lanes bulge_left =
      w * (p_square * (curl + r2 * inverse_r) + (1 + x) * p_mixed + p1_square * shift * r1 * inverse_r);
  const Lanes km = -kn * bent * inverse_r;
  const Lanes ma = kr * (shifts ? nr * A.n : A.r) + km * A.r + 2 * C.n * sa - E.n * sb;
  const Lanes mb = kr * (shifts ? nr * B.n : B.r) + km * B.r + E.n * sa - 2 * F.n * sb;
  const Lanes na = -kd * A.n, nb = -kd * B.n;
  Quadratic q;
  q.aaa = two_kp * A.p * C.p + two_kt * A.t * Ct + pAA * ma + tAA * na;
  q.aab = two_kp * (A.p * E.p + B.p * C.p) + two_kt * (A.t * Et + B.t * Ct) + pAA * mb + pAB * ma + tAA * nb +
          tAB * na;
  q.abb = two_kp * (A.p * F.p + B.p * E.p) + two_kt * (A.t * Ft + B.t * Et) + pBB * ma + pAB * mb + tBB * na +
          tAB * nb;
  q.bbb = two_kp * B.p * F.p + two_kt * B.t * Ft + pBB * mb + tBB * nb;
  const Lanes least_kp = least(kp, zero);
  const Lanes t_loss =
      shifts
          ? (most(kt * turned * turned + kr * nz * nz * w, zero) * p1_square + absolute(kr * nz) * t_rest) *
                p1_square
          : 2 * kt * t1 * absolute(nz) * bulge_rest + kd * (2 * t1 + bend) * bend * n1;
  q.loss = error(cells) - least_kp * p2 * p2 + absolute(two_kp) * p1 * p2 * squares_shift +
           absolute(kr) * (p_square * r2 + p_mixed * r1 + p1_square * absolute(nr * kn) * shifted) +
           t_square * kd * (most(n_rest - 0.5 * tube_leg, zero) + absolute(kn) * shifted) + t_loss +
           absolute(kn) * (t2 * squares_shift + absolute(nz) * bulge_left) +
           n2 * (2 * t_rest * most(absolute(da), absolute(db)) * (1 + shift) + shift * shift);
  const Lanes k = kp + kn * bend_all;
  q.f = distance - ring.minor_radius;
  q.g1 = A.n, q.g2 = B.n;
  q.h11 = C.n + kn * C.t + k * pAA + kt * tAA;
  q.h12 = E.n + kn * E.t + k * pAB + kt * tAB;
  q.h22 = F.n + kn * F.t + k * pBB + kt * tBB;
  q.shift = shift;
  // Over |a|, |b| <= 1 again.
  const Lanes s = 1 + shift, ss = s * s, sss = ss * s;
  q.g1 *= s, q.g2 *= s, q.h11 *= ss, q.h12 *= ss, q.h22 *= ss;
  q.aaa *= sss, q.aab *= sss, q.abb *= sss, q.bbb *= sss;
  return q;
}

Lanes least_of(const Quadratic& q, Lanes& loss, Lanes& a, Lanes& b) {
  // On the square a^3 is 3/4 a to 1/4 and a b^2 is 1/2 a to 1/2.
  const Lanes cubic = 0.25 * (absolute(q.aaa) + absolute(q.bbb)) + 0.5 * (absolute(q.aab) + absolute(q.abb));
  loss = q.loss + cubic;
  return least_quadratic(q.f - loss,
                         q.g1 + 0.75 * q.aaa + 0.5 * q.abb,
                         q.g2 + 0.75 * q.bbb + 0.5 * q.aab,
                         q.h11,
                         q.h12,
                         q.h22,
                         a,
                         b);
}

// `answers`: one a batch.
void bound(const RingFrame& ring,
           const Cells& cells,
           const BoundAsk& ask,
           RingAnswer* const (&answers)[MPM_SIDE_BY_SIDE]) {
  const Meridian at = meridian(ring, cells);
  const Lanes size = radius(cells), centre = at.distance - ring.minor_radius, none = all(__builtin_nan(""));
  Lanes lower = centre - size, estimate = lower, a = none, b = none;
  const Mask wanted =
      at.off_axis & (lower < ask.enough) & (size < kLargestCell * (ring.major_radius + ring.minor_radius));
  if (lane_bits(wanted)) {
    Lanes loss, at_a, at_b;
    const Lanes second = least_of(second_order(ring, cells, at), loss, at_a, at_b);
    const Mask better = wanted & (second > lower);
    lower = better ? second : lower;
    estimate = better ? second + kBelieved * loss : lower;
    a = wanted ? at_a : none, b = wanted ? at_b : none;
  }
  const Lanes away = most(ring.lowest_piece - at.z, at.r - ring.widest_piece) - size;
  const Mask clear = away >= ask.enough;
  lower = (clear ? least(lower, away) : lower) - ring.rounding;
  const int is_clear = lane_bits(clear);
  const int is_open = lane_bits((lower < ask.proven) | (estimate - ring.rounding < ask.searched));
  for (int k = 0; k < MPM_SIDE_BY_SIDE; ++k) {
    RingAnswer& answer = *answers[k];
    store(answer.lower, half(lower, k)), store(answer.center, half(centre, k));
    store(answer.a, half(a, k)), store(answer.b, half(b, k));
    answer.clear_of_pieces = is_clear >> k * kLanes & kAllLanes;
    answer.open = is_open >> k * kLanes & kAllLanes;
  }
}

void bound(const RingFrame& ring,
           const CellBatch& first,
           const CellBatch& second,
           const BoundAsk& ask,
           RingAnswer& first_answer,
           RingAnswer& second_answer) {
#if MPM_SIDE_BY_SIDE == 1
  bound(ring, Cells{first}, ask, {&first_answer});
  bound(ring, Cells{second}, ask, {&second_answer});
#else
  bound(ring, Cells{first, second}, ask, {&first_answer, &second_answer});
#endif
}

void store(CellBatch& cells, CellBatch::Term term, const Vectors<Four>& v) {
  store(cells.term[term][0], v.x), store(cells.term[term][1], v.y), store(cells.term[term][2], v.z);
}

void quarter(const CellBatch& whole, int lane, CellBatch& quarters) {
  const auto same = [&](CellBatch::Term term) -> Vectors<Four> {
    return {
        four(whole.term[term][0][lane]), four(whole.term[term][1][lane]), four(whole.term[term][2][lane])};
  };
  const Four a = {-0.5, 0.5, -0.5, 0.5}, b = {-0.5, -0.5, 0.5, 0.5}, fourth = four(0.25);
  const Vectors<Four> A = same(CellBatch::a), B = same(CellBatch::b), C = same(CellBatch::aa),
                      E = same(CellBatch::ab), F = same(CellBatch::bb);
  store(quarters,
        CellBatch::center,
        same(CellBatch::center) + a * A + b * B + fourth * C + (a * b) * E + fourth * F);
  const Vectors<Four> qA = four(0.5) * (A + 2 * a * C + b * E), qB = four(0.5) * (B + 2 * b * F + a * E);
  const Vectors<Four> qC = fourth * C, qE = fourth * E, qF = fourth * F;
  store(quarters, CellBatch::a, qA), store(quarters, CellBatch::b, qB);
  store(quarters, CellBatch::aa, qC), store(quarters, CellBatch::ab, qE), store(quarters, CellBatch::bb, qF);
  const double error = whole.error[lane];
  store(quarters.error, four(error));
  const Vectors<Four> sum = qA + qB, difference = qA - qB;
  const Four bends = root(Four{dot(qC, qC)[0], dot(qE, qE)[0], dot(qF, qF)[0], 0});
  store(quarters.radius,
        root(most(dot(sum, sum), dot(difference, difference))) + (bends[0] + bends[1] + bends[2] + error));
}

}  // namespace

const RingKernel kRingKernel{bound, quarter};

}  // namespace mpm::MPM_ISA
