#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "mpm/base/instruction_set.h"
#include "mpm/removal/ring_cut.h"
#include "mpm/removal/tool_sweep.h"

namespace mpm {
namespace {

struct Random {
  std::mt19937 engine{20261126};
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); }
  Vec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
};

const Tool kTools[] = {{6.7, 6.0, 6.0, 30, {}},
                       {6.7, 1.5, 1.5, 30, {}},
                       {0, 5, 0, 30, {}},
                       {20, 4, 0, 30, {}},
                       {2, 6, 6, 30, {}}};

constexpr int kTimes = 400;
constexpr double kBelow = 5;
// mm: a second dip of the distance over the stroke may be missed; a ball has none.
double tolerance(const Tool& tool) { return tool.major_radius > 0 ? 6e-4 : 1e-5; }

// A stroke of some tool, and the move that it is all of.
struct Case {
  Tool tool;
  TipPose a, b;
  ToolSweep sweep;
};

Case random_case(Random& random) {
  const Tool tool = kTools[random.engine() % std::size(kTools)];
  const Vec3 axis = (Vec3::UnitZ() + random.vector(0.5)).normalized();
  const TipPose a{random.vector(1), axis};
  const double travel = random.between(0, 1) < 0.1 ? 0 : 0.55 * longest_travel(tool),
               turn = random.between(0, 1) < 0.5 ? 0 : 0.02;
  const TipPose b{a.tip + random.vector(travel), (axis + random.vector(turn)).normalized()};
  return {tool, a, b, ToolSweep(tool, {{a, b}, {0, 1}})};
}

// Least distance of a point from the ring over many times of the move.
double dense_distance(const Case& one, const Vec3& point) {
  double least = kInfinity;
  for (int i = 0; i <= kTimes; ++i) {
    const TipPose p = pose_between(one.a, one.b, double(i) / kTimes);
    const Vec3 u = point - p.tip - one.tool.minor_radius * p.axis;
    const double z = u.dot(p.axis), r = (u - z * p.axis).norm();
    least = std::min(least, std::hypot(r - one.tool.major_radius, z) - one.tool.minor_radius);
  }
  return least;
}

// A ray that begins near the ring's lower side, at it or deep inside, and leads about into the tool; every
// other one leans far.
Ray random_ray(const Case& one, Random& random) {
  const Vec3 axis = one.a.axis, out = axis.cross(random.vector(1)).normalized();
  const double angle = random.between(-1.2, 1.2);
  const Vec3 normal = std::sin(angle) * out - std::cos(angle) * axis;
  const bool touching = random.between(0, 1) < 0.6;
  const double away = touching ? random.between(-0.02, 0.04) : random.between(-4, 2);
  const Vec3 center = one.a.tip + one.tool.minor_radius * axis + one.tool.major_radius * out;
  const Vec3 at = center + (one.tool.minor_radius + away) * normal + random.vector(touching ? 0 : 1.5);
  return {at, (random.vector(random.engine() % 2 ? 0.3 : 1.2) - normal).normalized()};
}

void put(const Ray& ray, double height, int lane, RayBatch& batch) {
  for (int k = 0; k < 3; ++k)
    batch.origin[k][lane] = ray.origin[k], batch.direction[k][lane] = ray.direction[k];
  batch.height[lane] = height;
}

// What the kernel decides agrees with many poses of the ring: nothing is swept below the heights it leaves,
// and what it lowers them by is swept.
TEST(RingCut, AgreesWithDenseSampling) {
  Random random;
  int lowered = 0, kept = 0, undecided = 0;
  for (int n = 0; n < 1000; ++n) {
    const Case one = random_case(random);
    ASSERT_EQ(one.sweep.strokes().size(), 1u);
    Ray rays[kLanes];
    RayBatch batch;
    for (int i = 0; i < kLanes; ++i) {
      rays[i] = random_ray(one, random);
      put(rays[i], random.between(0, 1) < 0.7 ? random.between(-0.1, 0.5) : random.between(0, 20), i, batch);
    }
    const RayBatch before = batch;
    const RingCut found = widest(kRingCutters).cut(one.sweep.ring_stroke(0), batch, kBelow);
    for (int i = 0; i < kLanes; ++i) {
      const double old = before.height[i], now = batch.height[i];
      if (found.undecided >> i & 1) {
        ++undecided;
        EXPECT_EQ(now, old);
        continue;
      }
      for (double t = -kBelow; t < now; t += 0.13)
        EXPECT_GT(dense_distance(one, rays[i].at(t)), -tolerance(one.tool))
            << n << " lane " << i << " t " << t;
      EXPECT_GT(dense_distance(one, rays[i].at(now)), -tolerance(one.tool)) << n << " lane " << i;
      if (!(found.lowered >> i & 1)) {
        ++kept;
        EXPECT_EQ(now, old);
        continue;
      }
      ++lowered;
      EXPECT_LT(now, old);
      // Times in between: the distance may be less by a little.
      EXPECT_LT(dense_distance(one, rays[i].at(now)), 1e-4) << n << " lane " << i;
      for (double t = now + 0.05; t < std::min(old, 0.0); t += 0.05)
        EXPECT_LT(dense_distance(one, rays[i].at(t)), 1e-4) << n << " lane " << i << " t " << t;
    }
  }
  // It decides many, though half of the rays lean as no normal of a machined surface does.
  EXPECT_GT(lowered, 600);
  EXPECT_GT(kept, 200);
  EXPECT_LT(undecided, 2800);
}

// Rays of a bundle that is said to be clear are not touched.
TEST(RingCut, ClearBundlesAreClear) {
  Random random;
  int clear = 0, near = 0;
  for (int n = 0; n < 2500; ++n) {
    const Case one = random_case(random);
    const double size = std::pow(10, random.between(-3, 0)), lean = random.between(0, 0.4);
    BundleBatch bundles{};
    std::vector<Vec3> tops[kLanes];
    std::vector<Vec3> directions[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      const Ray middle = random_ray(one, random);
      for (int k = 0; k < 3; ++k)
        bundles.top[k][i] = middle.origin[k], bundles.direction[k][i] = middle.direction[k];
      for (int j = 0; j < 12; ++j) {
        const Vec3 away = random.vector(size),
                   direction = (middle.direction + random.vector(lean)).normalized();
        tops[i].push_back(middle.origin + away), directions[i].push_back(direction);
        bundles.radius[i] = std::max(bundles.radius[i], away.norm());
        bundles.along[i] = std::max(bundles.along[i], std::abs(away.dot(middle.direction)));
        bundles.spread[i] = std::max(bundles.spread[i], (direction - middle.direction).norm());
      }
    }
    const int found = widest(kRingCutters).clear(one.sweep.ring_stroke(0), bundles);
    for (int i = 0; i < kLanes; ++i) {
      if (!(found >> i & 1)) continue;
      ++clear;
      double least = kInfinity;
      for (std::size_t j = 0; j < tops[i].size(); ++j)
        for (const double down : {0.0, 0.3, 1.0, 2.0, 3.0, 5.0, 8.0, 13.0, 20.0})
          least = std::min(least, dense_distance(one, tops[i][j] - down * directions[i][j]));
      EXPECT_GT(least, -tolerance(one.tool)) << n << " bundle " << i;
      near += least < 0.03;
    }
  }
  EXPECT_GT(clear, 400);
  EXPECT_GT(near, 60);  // the test would notice a bound that is off
}

TEST(RingCut, SameBitsForAllInstructionSets) {
  const auto wider_cutters = runnable(kRingCutters).subspan(1);
  if (wider_cutters.empty()) GTEST_SKIP() << "this processor, or this build, has only one kernel";
  Random random;
  int decided = 0;
  for (int n = 0; n < 2000; ++n) {
    const Case one = random_case(random);
    RayBatch rays;
    for (int i = 0; i < kLanes; ++i) put(random_ray(one, random), random.between(-0.1, 8), i, rays);
    RayBatch narrow = rays;
    const RingCut expected = baseline::kRingCutter.cut(one.sweep.ring_stroke(0), narrow, kBelow);
    decided += expected.undecided != (1 << kLanes) - 1;
    for (const RingCutter* cutter : wider_cutters) {
      RayBatch wide = rays;
      const RingCut found = cutter->cut(one.sweep.ring_stroke(0), wide, kBelow);
      EXPECT_EQ(found.lowered, expected.lowered);
      EXPECT_EQ(found.undecided, expected.undecided);
      EXPECT_EQ(std::memcmp(wide.height, narrow.height, sizeof wide.height), 0);
    }
  }
  EXPECT_GT(decided, 1000);
}

}  // namespace
}  // namespace mpm
