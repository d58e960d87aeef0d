#include "mpm/removal/normal_rays.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/removal/ray_order.h"

namespace mpm {
namespace {

constexpr double kUnitTolerance = 1e-9;
constexpr std::size_t kBundleRays = 16;
constexpr std::size_t kStrokesPerBox = 4;  // after so many strokes the tile's box is made anew

void check_rays(const NormalRays& rays) {
  require(rays.height.size() == rays.rays.size() && rays.move.size() == rays.rays.size(),
          "origins, directions, height and move must have the same length");
  require(std::isfinite(rays.below) && rays.below >= 0, "below_mm must be a finite number, 0 or more");
  for (const Ray& ray : rays.rays)
    require(ray.origin.allFinite() && std::abs(ray.direction.norm() - 1) < kUnitTolerance,
            "origins must be finite, directions unit vectors");
}

// Neighbouring rays, and how far their upper ends and directions are from the middle one's.
struct Bundle {
  const std::uint32_t* first;
  std::size_t count;
  Box3 box;
  double top = 0;
  Neighbourhood near;

  std::uint32_t middle() const { return first[count / 2]; }

  void look_again(const NormalRays& rays) {
    box = {};
    near = {};
    top = rays.height[middle()];
    const Vec3 middle_top = rays.rays[middle()].at(top);
    const Vec3& direction = rays.rays[middle()].direction;
    for (std::size_t i = 0; i < count; ++i) {
      const Ray& ray = rays.rays[first[i]];
      const Vec3 upper = ray.at(rays.height[first[i]]);
      box.extend(ray.at(-rays.below));
      box.extend(upper);
      near.radius = std::max(near.radius, (upper - middle_top).norm());
      near.along = std::max(near.along, std::abs((upper - middle_top).dot(direction)));
      near.spread = std::max(near.spread, (ray.direction - direction).norm());
    }
  }
};

// The rays of one tile, in bundles.
class TileCut {
 public:
  TileCut(NormalRays& rays, const ToolSweep& sweep, const std::uint32_t* tile, std::size_t count)
      : rays_(rays), sweep_(sweep), tile_{tile, count, {}, 0, {}} {
    for (std::size_t i = 0; i < count; i += kBundleRays)
      bundles_.push_back({tile + i, std::min(kBundleRays, count - i), {}, 0, {}});
  }

  void run(const Context& context) {
    look_again();
    // Those first that cut deepest at the true surface.
    const Vec3& point = rays_.rays[tile_.middle()].origin;
    order_strokes(
        sweep_, tile_.box, [&](std::uint32_t i) { return sweep_.distance(i, point); }, strokes_);
    std::size_t tried = 0;
    for (const std::uint32_t stroke : strokes_) {
      if (context.cancelled()) return;
      if (pieces_near(tile_, stroke) == 0) continue;
      for (const Bundle& bundle : bundles_) cut(bundle, stroke);
      if (++tried % kStrokesPerBox == 0) look_again();
    }
  }

 private:
  void look_again() {
    tile_.look_again(rays_);
    for (Bundle& bundle : bundles_) bundle.look_again(rays_);
  }

  std::uint32_t pieces_near(const Bundle& bundle, std::uint32_t stroke) const {
    const std::uint32_t pieces = sweep_.pieces_near(stroke, bundle.box);
    const bool clear =
        (pieces & 1) && sweep_.ring_clear_below(stroke, rays_.rays[bundle.middle()], bundle.top, bundle.near);
    return clear ? pieces & ~std::uint32_t(1) : pieces;
  }

  void cut(const Bundle& bundle, std::uint32_t stroke) {
    if (const std::uint32_t pieces = pieces_near(bundle, stroke))
      for (std::size_t i = 0; i < bundle.count; ++i) cut(bundle.first[i], stroke, pieces);
  }

  // The ring first: what it takes away the pieces above it need not look at.
  void cut(std::uint32_t i, std::uint32_t stroke, std::uint32_t pieces) {
    constexpr std::uint32_t kRing = 1;
    cut_with(i, stroke, pieces & kRing);
    cut_with(i, stroke, pieces & ~kRing);
  }

  void cut_with(std::uint32_t i, std::uint32_t stroke, std::uint32_t pieces) {
    const Ray& ray = rays_.rays[i];
    double& height = rays_.height[i];
    if (pieces == 0 || height <= -rays_.below) return;
    pieces = sweep_.pieces_not_above(stroke, pieces, ray, -rays_.below, height);
    sweep_.visit_spans(stroke, pieces, ray, -rays_.below, height, [&](double from, double to) {
      if (from >= height || to < std::min(height, 0.0)) return;
      height = from;
      rays_.move[i] = std::int32_t(sweep_.strokes()[stroke].move);
    });
  }

  NormalRays& rays_;
  const ToolSweep& sweep_;
  Bundle tile_;
  std::vector<Bundle> bundles_;
  std::vector<std::uint32_t> strokes_;
};

}  // namespace

void cut_rays(NormalRays& rays, const ToolSweep& sweep, Context& context) {
  check_rays(rays);
  const std::vector<std::uint32_t> order = near_together(rays.rays);
  context.start(order.size());
  for_each_range(order.size(), kTileRays, context, [&](std::size_t begin, std::size_t end) {
    TileCut(rays, sweep, order.data() + begin, end - begin).run(context);
  });
}

}  // namespace mpm
