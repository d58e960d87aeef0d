#include "mpm/removal/ray_tile.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr std::size_t kLoweredPerLook = 32;  // after so many cuts the boxes are made anew

}  // namespace

RayTile::RayTile(NormalRays& rays, const ToolSweep& sweep, const std::uint32_t* numbers, std::size_t count)
    : rays_(rays),
      sweep_(sweep),
      numbers_(numbers),
      count_(count),
      bundles_((count + kBundleRays - 1) / kBundleRays) {
  for (std::size_t slot = 0; slot < kTileRays; ++slot) put(slot);
}

// Lanes without a ray have nothing left to be cut.
void RayTile::put(std::size_t slot) {
  const std::size_t known = std::min(slot, count_ - 1), lane = slot % kLanes;
  RayBatch& batch = batches_[slot / kLanes];
  for (int k = 0; k < 3; ++k) {
    batch.origin[k][lane] = ray(known).origin[k];
    batch.direction[k][lane] = ray(known).direction[k];
  }
  batch.height[lane] = known == slot ? height(slot) : -rays_.below;
}

// Those strokes first that come near the true surface: they cut deepest, and what they leave is thin.
void RayTile::cut(const Context& context) {
  Box3 surface;
  for (std::size_t slot = 0; slot < count_; ++slot) surface.extend(ray(slot).origin);
  Strokes strokes;
  look_again();
  sweep_.low_strokes_near(surface, strokes);
  cut(strokes, sweep_.low_pieces(), context);
  sweep_.low_strokes_near(box_, surface, strokes);
  cut(strokes, sweep_.low_pieces(), context);
  sweep_.high_strokes_near(box_, strokes);
  cut(strokes, sweep_.high_pieces(), context);
}

void RayTile::look_again() {
  box_ = {};
  for (std::size_t b = 0; b < bundles_; ++b) {
    look_again(b);
    box_.extend(boxes_[b]);
  }
  lowered_ = 0;
}

void RayTile::look_again(std::size_t bundle) {
  const std::size_t first = bundle * kBundleRays, last = std::min(first + kBundleRays, count_);
  const std::size_t middle = (first + last) / 2;
  const Vec3 &direction = ray(middle).direction, top = ray(middle).at(height(middle));
  double radius = 0, along = 0, spread = 0;
  Box3 box;
  for (std::size_t slot = first; slot < last; ++slot) {
    const Vec3 upper = ray(slot).at(height(slot)), away = upper - top;
    box.extend(upper);
    box.extend(ray(slot).at(std::min(height(slot), 0.0)));
    radius = std::max(radius, away.squaredNorm());
    along = std::max(along, std::abs(away.dot(direction)));
    spread = std::max(spread, (ray(slot).direction - direction).squaredNorm());
  }
  boxes_[bundle] = box;
  for (int k = 0; k < 3; ++k) ends_.top[k][bundle] = top[k], ends_.direction[k][bundle] = direction[k];
  ends_.radius[bundle] = std::sqrt(radius), ends_.along[bundle] = along,
  ends_.spread[bundle] = std::sqrt(spread);
}

// Those first that cut deepest at the true surface; of a stroke the ring first: what it takes away the pieces
// above it need not look at.
void RayTile::cut(Strokes& strokes, std::uint32_t pieces, const Context& context) {
  const Vec3& point = ray(count_ / 2).origin;
  order_strokes([&](std::uint32_t i) { return sweep_.depth(i, point); }, strokes);
  for (const std::uint32_t stroke : strokes) {
    if (context.cancelled()) return;
    const std::uint32_t near = sweep_.pieces_near(stroke, pieces, box_);
    if (near & ToolSweep::kRing) {
      const int clear = cutter_.clear(sweep_.ring_stroke(stroke), ends_);
      for (std::size_t b = 0; b < bundles_; ++b)
        if (!(clear >> b & 1)) cut_with_ring(b, stroke);
    }
    if (const std::uint32_t cones = near & ~ToolSweep::kRing)
      for (std::size_t b = 0; b < bundles_; ++b) cut_with_cones(b, stroke, cones);
    if (lowered_ >= kLoweredPerLook) look_again();
  }
  look_again();
}

void RayTile::cut_with_ring(std::size_t bundle, std::uint32_t stroke) {
  const std::size_t first = bundle * kBundleRays, last = std::min(first + kBundleRays, count_);
  for (std::size_t slot = first; slot < last; slot += kLanes) {
    RayBatch& batch = batches_[slot / kLanes];
    const RingCut found = cutter_.cut(sweep_.ring_stroke(stroke), batch, rays_.below);
    if ((found.lowered | found.undecided) == 0) continue;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (found.lowered >> lane & 1) lower(slot + lane, stroke, batch.height[lane]);
      if (found.undecided >> lane & 1) cut_with(slot + lane, stroke, ToolSweep::kRing);
    }
  }
}

void RayTile::cut_with_cones(std::size_t bundle, std::uint32_t stroke, std::uint32_t pieces) {
  if (lowered_ > 0) look_again(bundle);
  pieces = sweep_.pieces_near(stroke, pieces, boxes_[bundle]);
  if (pieces == 0) return;
  const std::size_t first = bundle * kBundleRays, last = std::min(first + kBundleRays, count_);
  for (std::size_t slot = first; slot < last; ++slot) cut_with(slot, stroke, pieces);
}

void RayTile::cut_with(std::size_t slot, std::uint32_t stroke, std::uint32_t pieces) {
  const double &top = height(slot), bottom = -rays_.below;
  if (top <= bottom) return;
  pieces = sweep_.pieces_not_above(stroke, pieces, ray(slot), std::min(top, 0.0), top);
  sweep_.visit_spans(stroke, pieces, ray(slot), bottom, top, [&](double from, double to) {
    if (from < top && to >= std::min(top, 0.0)) lower(slot, stroke, from);
  });
}

void RayTile::lower(std::size_t slot, std::uint32_t stroke, double to) {
  batches_[slot / kLanes].height[slot % kLanes] = to;
  height(slot) = to;
  rays_.move[numbers_[slot]] = std::int32_t(sweep_.strokes()[stroke].move);
  ++lowered_;
}

}  // namespace mpm
