#include "mpm/removal/normal_rays.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/removal/ray_order.h"

namespace mpm {
namespace {

constexpr double kUnitTolerance = 1e-9;
constexpr std::size_t kStrokesPerBox = 4;  // after so many strokes the tile's box is made anew

void check_rays(const NormalRays& rays) {
  require(rays.height.size() == rays.rays.size() && rays.move.size() == rays.rays.size(),
          "origins, directions, height and move must have the same length");
  require(std::isfinite(rays.below) && rays.below >= 0, "below_mm must be a finite number, 0 or more");
  for (const Ray& ray : rays.rays)
    require(ray.origin.allFinite() && std::abs(ray.direction.norm() - 1) < kUnitTolerance,
            "origins must be finite, directions unit vectors");
}

class TileCut {
 public:
  TileCut(NormalRays& rays, const ToolSweep& sweep, const std::uint32_t* tile, std::size_t count)
      : rays_(rays), sweep_(sweep), tile_(tile), count_(count) {}

  void run(const Context& context) {
    Box3 box = bounds();
    const std::uint32_t middle = tile_[count_ / 2];
    order_strokes(sweep_, box, rays_.rays[middle], {-rays_.below, rays_.height[middle]}, strokes_);
    std::size_t tried = 0;
    for (const std::uint32_t stroke : strokes_) {
      if (context.cancelled()) return;
      const std::uint32_t pieces = sweep_.pieces_near(stroke, box);
      if (pieces == 0) continue;
      for (std::size_t i = 0; i < count_; ++i) cut(tile_[i], stroke, pieces);
      if (++tried % kStrokesPerBox == 0) box = bounds();
    }
  }

 private:
  Box3 bounds() const {
    Box3 box;
    for (std::size_t i = 0; i < count_; ++i) {
      box.extend(rays_.rays[tile_[i]].at(-rays_.below));
      box.extend(rays_.rays[tile_[i]].at(rays_.height[tile_[i]]));
    }
    return box;
  }

  void cut(std::uint32_t i, std::uint32_t stroke, std::uint32_t pieces) {
    const Ray& ray = rays_.rays[i];
    double& height = rays_.height[i];
    if (height <= -rays_.below || sweep_.below(stroke, ray, -rays_.below, height)) return;
    sweep_.visit_spans(stroke, pieces, ray, -rays_.below, height, [&](double from, double to) {
      if (from >= height || to < std::min(height, 0.0)) return;
      height = from;
      rays_.move[i] = std::int32_t(sweep_.strokes()[stroke].move);
    });
  }

  NormalRays& rays_;
  const ToolSweep& sweep_;
  const std::uint32_t* tile_;
  std::size_t count_;
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
