#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "mpm/contact/clearance_bound.h"
#include "mpm/contact/ring_kernel.h"

namespace mpm {
namespace {

constexpr int kGrid = 24;

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
    RingAnswer answer;
    ClearanceBound(one.tool, one.pose).four(in_all_lanes(one.cell), kInfinity, answer);
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

// The scalar bound of the contact zones is the same one, with the cubic terms as one loss.
TEST(RingKernel, IsNeverLooserThanTheScalarBound) {
  Random random;
  for (int k = 0; k < 2000; ++k) {
    const Case one = random_case(random);
    const ClearanceBound bound(one.tool, one.pose);
    RingAnswer answer;
    bound.four(in_all_lanes(one.cell), kInfinity, answer);
    if (!(answer.lower[0] > answer.center[0] - one.cell.radius)) continue;
    const QuadraticBound q = bound.ring(one.cell);
    const double scalar = least_quadratic(q.f - q.loss, q.g1, q.g2, q.h11, q.h12, q.h22);
    EXPECT_GE(answer.lower[0], scalar - 3 * bound.rounding()) << "case " << k;
  }
}

TEST(RingKernel, EveryInstructionSetGivesTheSameBits) {
#ifdef MPM_AVX2
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2: there is only one kernel";
  Random random;
  for (int k = 0; k < 2000; ++k) {
    const Case one = random_case(random);
    const RingFrame frame{{one.pose.torus_center.x(), one.pose.torus_center.y(), one.pose.torus_center.z()},
                          {one.pose.axis.x(), one.pose.axis.y(), one.pose.axis.z()},
                          one.tool.major_radius,
                          one.tool.minor_radius,
                          1e-10,
                          0};
    const CellBatch cells = in_all_lanes(one.cell);
    RingAnswer narrow, wide;
    kBaselineRingKernel.bound(frame, cells, 0, narrow);
    kAvx2RingKernel.bound(frame, cells, 0, wide);
    EXPECT_EQ(0, std::memcmp(narrow.lower, wide.lower, sizeof narrow.lower));
    EXPECT_EQ(0, std::memcmp(narrow.center, wide.center, sizeof narrow.center));
    EXPECT_EQ(narrow.below_pieces, wide.below_pieces);
    CellBatch narrow_quarters, wide_quarters;
    kBaselineRingKernel.quarter(cells, 1, narrow_quarters);
    kAvx2RingKernel.quarter(cells, 1, wide_quarters);
    EXPECT_EQ(0, std::memcmp(&narrow_quarters, &wide_quarters, sizeof narrow_quarters));
  }
#else
  GTEST_SKIP() << "built without AVX2: there is only one kernel";
#endif
}

TEST(RingKernel, QuartersAreTheWholeCell) {
  Random random;
  const QuadraticCell whole = random_case(random).cell;
  const CellBatch cells = in_all_lanes(whole);
  CellBatch quarters;
  ring_kernel().quarter(cells, 2, quarters);
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
