#include <gtest/gtest.h>

#include <random>

#include "mpm/removal/tool_sweep.h"

namespace mpm {
namespace {

class Random {
 public:
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  Vec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  Vec3 direction() { return vector(1).normalized(); }

 private:
  std::mt19937 engine_{11};
};

constexpr int kTimes = 400;

// Whether a point is swept, by looking at many times of the move.
double dense_distance(const Tool& tool, const TipPose& a, const TipPose& b, const Vec3& point) {
  double least = kInfinity;
  for (int i = 0; i <= kTimes; ++i) {
    const TipPose p = pose_between(a, b, double(i) / kTimes);
    least = std::min(least, signed_distance(tool, ToolPose::from_tip(tool, p.tip, p.axis), point));
  }
  return least;
}

bool in_spans(const std::vector<Span>& spans, double t) {
  for (const Span& s : spans)
    if (t >= s.from && t <= s.to) return true;
  return false;
}

const Tool kTools[] = {{6.7, 6.0, 6.0, 30, {{9, 9, 10}, {20, 30, 25}}},
                       {6.7, 3.0, 1.0, 20, {{12, 8, 10}}},
                       {0, 4, 0, 20, {{4, 10, 8}}},
                       {8, 0, 0, 20, {}},
                       {2, 6, 6, 20, {}}};

// Rays in all directions against moves that travel and turn: what lies in the spans is swept, what does not
// is not.
TEST(SweptPiece, AgreesWithDenseSampling) {
  Random random;
  int inside = 0, entries = 0, missed = 0;
  double deepest = 0;
  for (const Tool& tool : kTools)
    for (int n = 0; n < 120; ++n) {
      const Vec3 axis = (Vec3::UnitZ() + random.vector(0.6)).normalized();
      const TipPose a{random.vector(1), axis};
      const TipPose b{a.tip + random.vector(2.5), (axis + random.vector(0.05)).normalized()};
      const ToolSweep sweep(tool, {{a, b}, {0, 1}});
      const Vec3 through = a.tip + random.vector(14);
      const Ray ray{through, n % 3 == 0 ? random.direction() : (axis + random.vector(0.5)).normalized()};
      std::vector<Span> spans;
      for (std::uint32_t s = 0; s < sweep.strokes().size(); ++s)
        sweep.visit_spans(s, ~0u, ray, -40, 60, [&](double from, double to) { spans.push_back({from, to}); });
      for (double t = -40; t <= 60; t += 0.77) {
        const double distance = dense_distance(tool, a, b, ray.at(t));
        // Times in between: the distance may be less by a little.
        if (distance < -1e-3) {
          ++inside;
          // A ray that runs along a wall of a turning tool may lose a sliver.
          if (!in_spans(spans, t)) ++missed, deepest = std::min(deepest, distance);
        } else if (distance > 5e-3) {
          EXPECT_FALSE(in_spans(spans, t)) << n << " t " << t << " distance " << distance;
        }
      }
      double first = kInfinity;
      for (const Span& s : spans) first = std::min(first, s.from);
      if (first == kInfinity || first == -40) continue;
      EXPECT_NEAR(dense_distance(tool, a, b, ray.at(first)), 0, 2e-3) << n;
      ++entries;
    }
  EXPECT_GT(inside, 2000);
  EXPECT_GT(entries, 250);
  EXPECT_LE(missed, inside / 1000);
  EXPECT_GT(deepest, -0.1);
}

}  // namespace
}  // namespace mpm
