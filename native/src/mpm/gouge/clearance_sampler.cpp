#include "mpm/gouge/clearance_sampler.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr int kGrid = 8;             // intervals along each side of a tile
constexpr int kRefinements = 5;      // rounds, each a grid over two intervals of the one before
constexpr std::size_t kRefined = 4;  // tiles refined
constexpr int kMaxSplit = 64;        // tiles along each side of a patch
constexpr double kTilesPerRadius = 2.0;
constexpr double kMaxTiles = 1e6;

double lerp(double a, double b, int i) { return i == kGrid ? b : a + (b - a) * i / kGrid; }

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
        tiles_.push_back({ref.patch, ref.face, ref.cover == TrimRegion::Cover::crossing, part});
        boxes.push_back(ref.patch->restricted(part).bounds());
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

SampledClearance ClearanceSampler::operator()(const ToolPose& pose, double range) const {
  std::vector<Sample> samples;
  tree_.visit(tool_bounds(tool_, pose, range), [&](std::uint32_t i) {
    Sample best{range, 0, 0, nullptr};
    sample(tiles_[i], tiles_[i].box, pose, best);
    if (best.tile) samples.push_back(best);
  });
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
