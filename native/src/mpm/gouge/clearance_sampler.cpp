#include "mpm/gouge/clearance_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mpm {
namespace {

constexpr int kGrid = 8;             // intervals along each side of a tile
constexpr int kRefinements = 5;      // rounds, each a grid over two intervals of the one before
constexpr std::size_t kRefined = 4;  // tiles refined
constexpr int kMaxSplit = 64;        // tiles along each side of a patch
constexpr double kTilesPerRadius = 2.0;
constexpr double kMaxTiles = 1e6;
constexpr double kSafety = 1e-6;  // mm, far above what rounding makes of a bound, whatever the tool

double lerp(double a, double b, int i) { return i == kGrid ? b : a + (b - a) * i / kGrid; }

// The kRefined least of some values, or `limit` where there are fewer.
class Lowest {
 public:
  explicit Lowest(double limit) { values_.fill(limit); }
  double last() const { return values_.back(); }
  void add(double value) {
    if (value >= last()) return;
    values_.back() = value;
    for (std::size_t i = kRefined - 1; i > 0 && values_[i] < values_[i - 1]; --i)
      std::swap(values_[i], values_[i - 1]);
  }

 private:
  std::array<double, kRefined> values_;
};

ParamBox around(double u, double v, double du, double dv, const ParamBox& limit) {
  return {std::max(u - du, limit.u0),
          std::min(u + du, limit.u1),
          std::max(v - dv, limit.v0),
          std::min(v + dv, limit.v1)};
}

}  // namespace

ClearanceSampler::ClearanceSampler(const SurfaceModel& model, const Tool& tool) : model_(model), tool_(tool) {
  const double per_patch = kMaxTiles / double(model.patches().size());
  const int split_limit = std::clamp(int(std::sqrt(per_patch)), 1, kMaxSplit);
  std::vector<Box3> boxes;
  for (const PatchRef& ref : model.patches()) {
    const double size = (ref.patch->bounds().hi - ref.patch->bounds().lo).maxCoeff();
    const int n = std::clamp(int(std::ceil(size * kTilesPerRadius / tool.radius())), 1, split_limit);
    const ParamBox& b = ref.patch->box();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double du = (b.u1 - b.u0) / n, dv = (b.v1 - b.v0) / n;
        const ParamBox part{b.u0 + du * i,
                            i + 1 == n ? b.u1 : b.u0 + du * (i + 1),
                            b.v0 + dv * j,
                            j + 1 == n ? b.v1 : b.v0 + dv * (j + 1)};
        const Box3 bounds = ref.patch->restricted(part).bounds();
        const Vec3 middle =
            ref.patch->point(lerp(part.u0, part.u1, kGrid / 2), lerp(part.v0, part.v1, kGrid / 2));
        const bool trimmed = ref.cover == TrimRegion::Cover::crossing;
        tiles_.push_back({ref.patch, ref.face, trimmed, part, middle, ball_around(bounds)});
        boxes.push_back(bounds);
      }
  }
  tree_ = BoxTree(boxes);
}

void ClearanceSampler::sample(const Tile& tile,
                              const ParamBox& part,
                              const ToolPose& pose,
                              Sample& best) const {
  const TrimRegion& trim = model_.faces()[tile.face].trim;
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const double u = lerp(part.u0, part.u1, i), v = lerp(part.v0, part.v1, j);
      if (tile.trimmed && !trim.contains(u, v)) continue;
      const double distance = signed_distance(tool_, pose, tile.patch->point(u, v));
      if (distance < best.distance) best = {distance, u, v, &tile};
    }
}

ClearanceSampler::Ball ClearanceSampler::ball_around(const Box3& box) {
  return {box.center(), 0.5 * box.diagonal() + kSafety};
}

// A signed distance changes by no more than the way from point to point.
double ClearanceSampler::bound(const Ball& ball, const ToolPose& pose) const {
  return signed_distance(tool_, pose, ball.center) - ball.radius;
}

// The tiles that may hold one of the kRefined lowest samples, the lowest bound first.
std::vector<ClearanceSampler::Candidate> ClearanceSampler::candidates(const ToolPose& pose,
                                                                      double range) const {
  std::vector<Candidate> found;
  Lowest middles(range);
  const auto near = [&](const Box3& box) { return bound(ball_around(box), pose) <= middles.last(); };
  tree_.visit(near, [&](std::uint32_t i) {
    const Tile& tile = tiles_[i];
    found.push_back({bound(tile.ball, pose), &tile});
    if (!tile.trimmed) middles.add(signed_distance(tool_, pose, tile.middle));
  });
  std::erase_if(found, [&](const Candidate& one) { return one.bound > middles.last(); });
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.bound != b.bound ? a.bound < b.bound : a.tile < b.tile;
  });
  return found;
}

SampledClearance ClearanceSampler::operator()(const ToolPose& pose, double range) const {
  std::vector<Sample> samples;
  Lowest lowest(range);
  for (const Candidate& one : candidates(pose, range)) {
    if (one.bound > lowest.last()) break;
    Sample best{range, 0, 0, nullptr};
    sample(*one.tile, one.tile->box, pose, best);
    if (best.tile) samples.push_back(best);
    lowest.add(best.distance);
  }
  const std::size_t keep = std::min(samples.size(), kRefined);
  std::partial_sort(
      samples.begin(), samples.begin() + std::ptrdiff_t(keep), samples.end(), [](auto& a, auto& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.tile < b.tile;
      });
  Sample least{range, 0, 0, nullptr};
  for (std::size_t k = 0; k < keep; ++k) {
    Sample& s = samples[k];
    double du = (s.tile->box.u1 - s.tile->box.u0) / kGrid, dv = (s.tile->box.v1 - s.tile->box.v0) / kGrid;
    for (int round = 0; round < kRefinements; ++round, du *= 2.0 / kGrid, dv *= 2.0 / kGrid)
      sample(*s.tile, around(s.u, s.v, du, dv, s.tile->box), pose, s);
    if (s.distance < least.distance) least = s;
  }
  if (!least.tile) return {range, Vec3::Constant(kNaN), 0};
  return {least.distance, least.tile->patch->point(least.u, least.v), least.tile->face};
}

}  // namespace mpm
