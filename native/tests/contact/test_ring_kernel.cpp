#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "mpm/base/instruction_set.h"
#include "mpm/contact/clearance_bound.h"
#include "mpm/contact/ring_kernel.h"

namespace mpm {
namespace {

constexpr int kGrid = 24;
constexpr BoundAsk kAllOfIt{kInfinity, 0, 0};

struct Random {
  std::mt19937 engine{20261125};
  double operator()(double size) { return std::uniform_real_distribution<double>(-size, size)(engine); }
  Vec3 vector(double size) { return {(*this)(size), (*this)(size), (*this)(size)}; }
};

Vec3 at(const QuadraticCell& q, double a, double b) {
  return q.c + a * q.A + b * q.B + a * a * q.C + a * b * q.E + b * b * q.F;
}

// A cell near the ring of a random tool pose, of a size from micrometres to the tool's, bent more or less.
struct Case {
  Tool tool;
  ToolPose pose;
  QuadraticCell cell;
};

Case random_case(Random& random) {
  Case one{
      {6.7 + random(6), 3.5 + random(3), 0, 40, {}}, {random.vector(50), random.vector(1).normalized()}, {}};
  one.tool.recess = one.tool.minor_radius;
  const double size = std::pow(10.0, -1.5 + random(1.7)), bend = size * size * (0.15 + random(0.15));
  const Vec3 out = one.pose.axis.cross(random.vector(1)).normalized();
  const double angle = random(kPi), r = one.tool.minor_radius + random(size);
  one.cell.c = one.pose.torus_center + (one.tool.major_radius + r * std::cos(angle)) * out +
               r * std::sin(angle) * one.pose.axis;
  one.cell.A = random.vector(size), one.cell.B = random.vector(size);
  one.cell.C = random.vector(bend), one.cell.E = random.vector(bend), one.cell.F = random.vector(bend);
  one.cell.set_radius();
  return one;
}

// A cell that lies on the ring, or almost: where every order of the bound counts.
Case touching_case(Random& random, double least_size, double most_size) {
  Case one = random_case(random);
  const double size =
      std::exp(0.5 * (std::log(least_size * most_size) + random(std::log(most_size / least_size))));
  const Vec3 out = one.pose.axis.cross(random.vector(1)).normalized();
  const double angle = random(kPi), ri = one.tool.minor_radius;
  const Vec3 normal = std::cos(angle) * out + std::sin(angle) * one.pose.axis;
  const Vec3 across = std::cos(angle) * one.pose.axis - std::sin(angle) * out, around = normal.cross(across);
  one.cell.c =
      one.pose.torus_center + one.tool.major_radius * out + (ri + 1e-3 * random(size * size)) * normal;
  // Often along the ring or across it, often narrow, flat or steep: so that each term is once the greatest.
  const double turn = random(1) < 0 ? 0.5 * kPi * std::round(random(2)) : random(kPi);
  const double narrow = std::exp(-2 + random(2)), steep = random(1) < 0 ? random(0.02) : random(1);
  const Vec3 along = std::cos(turn) * around + std::sin(turn) * across, beside = normal.cross(along);
  one.cell.A = size * (along + steep * random(1) * normal);
  one.cell.B = size * narrow * (beside + 0.3 * random(1) * along + steep * random(1) * normal);
  if (random(1) < 0) std::swap(one.cell.A, one.cell.B);
  const double bent = random(1) < 0 ? 0 : size * size / ri;
  one.cell.C = bent * (0.5 * random(1) * normal + 0.02 * random.vector(1));
  one.cell.F = narrow * narrow * bent * (0.5 * random(1) * normal + 0.02 * random.vector(1));
  one.cell.E = narrow * bent * (0.5 * random(1) * normal + 0.02 * random.vector(1));
  one.cell.error = 0;
  one.cell.set_radius();
  return one;
}

long double exact_gap(const Case& one, long double a, long double b) {
  const auto term = [&](int i) {
    const QuadraticCell& q = one.cell;
    return q.c[i] + a * q.A[i] + b * q.B[i] + a * a * q.C[i] + a * b * q.E[i] + b * b * q.F[i] -
           static_cast<long double>(one.pose.torus_center[i]);
  };
  const long double x[3] = {term(0), term(1), term(2)};
  long double z = 0, square = 0, axis = 0;
  for (int i = 0; i < 3; ++i) {
    z += x[i] * one.pose.axis[i], square += x[i] * x[i];
    axis += static_cast<long double>(one.pose.axis[i]) * one.pose.axis[i];
  }
  const long double r = std::sqrt(square - z * z / axis);
  return std::hypot(r - one.tool.major_radius, z / std::sqrt(axis)) - one.tool.minor_radius;
}

RingAnswer bound_of(const ClearanceBound& bound, const CellBatch& cells) {
  RingAnswer answer, same;
  bound.ring(cells, cells, kAllOfIt, answer, same);
  return answer;
}

CellBatch in_all_lanes(const QuadraticCell& cell) {
  CellBatch batch;
  for (int lane = 0; lane < kLanes; ++lane) put_lane(batch, lane, cell);
  return batch;
}

TEST(RingKernel, NoPointOfACellIsNearerThanItsBound) {
  Random random;
  int second_order = 0;
  for (int k = 0; k < 4000; ++k) {
    const Case one = random_case(random);
    const RingAnswer answer = bound_of(ClearanceBound(one.tool, one.pose), in_all_lanes(one.cell));
    double least = kInfinity;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; j <= kGrid; ++j) {
        const Vec3 s = at(one.cell, -1 + 2.0 * i / kGrid, -1 + 2.0 * j / kGrid);
        const Vec3 x = s - one.pose.torus_center;
        const double z = x.dot(one.pose.axis), r = (x - z * one.pose.axis).norm();
        least = std::min(least, std::hypot(r - one.tool.major_radius, z) - one.tool.minor_radius);
      }
    ASSERT_LE(answer.lower[0], least) << "case " << k;
    second_order += answer.lower[0] > answer.center[0] - one.cell.radius;
  }
  // The test means nothing where only spheres are compared.
  EXPECT_GT(second_order, 2000);
}

// Against long double, on the ring itself and down to cells whose bounds are all rounding.
TEST(RingKernel, HoldsInFloatingPointWhereItIsSharp) {
  Random random;
  int rounded = 0, sharp = 0;
  for (int k = 0; k < 20000; ++k) {
    const Case one = touching_case(random, 1e-7, 6);
    const ClearanceBound bound(one.tool, one.pose);
    const RingAnswer answer = bound_of(bound, in_all_lanes(one.cell));
    long double least = kInfinity;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; j <= kGrid; ++j)
        least = std::min(least, exact_gap(one, -1 + 2.0L * i / kGrid, -1 + 2.0L * j / kGrid));
    if (answer.a[0] == answer.a[0]) least = std::min(least, exact_gap(one, answer.a[0], answer.b[0]));
    ASSERT_LE(answer.lower[0], least) << "case " << k << ", radius " << one.cell.radius;
    rounded += answer.lower[0] + bound.rounding() > least;
    sharp += least - answer.lower[0] < 0.01 * one.cell.radius;
  }
  // Without its margin for rounding the bound would be wrong here and there: the test sees rounding.
  EXPECT_GT(rounded, 0);
  EXPECT_GT(sharp, 4000);
}

bool same_bits(const RingAnswer& a, const RingAnswer& b) {
  // Which NaN stands where there is no minimum is not said.
  const auto same = [](const double* x, const double* y) {
    return std::equal(x, x + kLanes, y, [](double p, double q) { return p == q || (p != p && q != q); });
  };
  return same(a.lower, b.lower) && same(a.center, b.center) && same(a.a, b.a) && same(a.b, b.b) &&
         a.open == b.open && a.clear_of_pieces == b.clear_of_pieces;
}

// Also whatever else is bounded at the same time.
TEST(RingKernel, EveryInstructionSetGivesTheSameBits) {
  const auto wider_kernels = runnable(kRingKernels).subspan(1);
  if (wider_kernels.empty()) GTEST_SKIP() << "this processor, or this build, has only one kernel";
  Random random;
  for (int k = 0; k < 2000; ++k) {
    const Case one = random_case(random);
    const RingFrame frame{{one.pose.torus_center.x(), one.pose.torus_center.y(), one.pose.torus_center.z()},
                          {one.pose.axis.x(), one.pose.axis.y(), one.pose.axis.z()},
                          one.tool.major_radius,
                          one.tool.minor_radius,
                          1e-10,
                          0,
                          one.tool.radius()};
    const CellBatch cells = in_all_lanes(one.cell), others = in_all_lanes(random_case(random).cell);
    RingAnswer narrow, narrow_other;
    baseline::kRingKernel.bound(frame, cells, cells, {0, 0, 0}, narrow, narrow_other);
    baseline::kRingKernel.bound(frame, others, others, {0, 0, 0}, narrow_other, narrow_other);
    CellBatch narrow_quarters;
    baseline::kRingKernel.quarter(cells, 1, narrow_quarters);
    for (const RingKernel* kernel : wider_kernels) {
      RingAnswer wide, wide_other;
      kernel->bound(frame, cells, others, {0, 0, 0}, wide, wide_other);
      EXPECT_TRUE(same_bits(narrow, wide)) << k;
      EXPECT_TRUE(same_bits(narrow_other, wide_other)) << k;
      CellBatch wide_quarters;
      kernel->quarter(cells, 1, wide_quarters);
      EXPECT_EQ(0, std::memcmp(&narrow_quarters, &wide_quarters, sizeof narrow_quarters));
    }
  }
}

TEST(RingKernel, QuartersAreTheWholeCell) {
  Random random;
  const QuadraticCell whole = random_case(random).cell;
  const CellBatch cells = in_all_lanes(whole);
  CellBatch quarters;
  widest(kRingKernels).quarter(cells, 2, quarters);
  for (int lane = 0; lane < kLanes; ++lane) {
    const QuadraticCell quarter = get_lane(quarters, lane);
    for (double a : {-1.0, -0.3, 1.0})
      for (double b : {-1.0, 0.6, 1.0}) {
        const Vec3 expected = at(whole, (lane & 1 ? 0.5 : -0.5) + a / 2, (lane & 2 ? 0.5 : -0.5) + b / 2);
        EXPECT_LT((at(quarter, a, b) - expected).norm(), 1e-13 * (1 + whole.c.norm()));
        EXPECT_LE((at(quarter, a, b) - quarter.c).norm(), quarter.radius * (1 + 1e-14));
      }
  }
}

}  // namespace
}  // namespace mpm
