// Some neighbouring rays, cut together.
#pragma once

#include <array>

#include "mpm/base/instruction_set.h"
#include "mpm/removal/normal_rays.h"
#include "mpm/removal/ray_order.h"

namespace mpm {

// The rays of one tile, in bundles, each bundle in batches of kLanes. Rays lie together in space so that most
// strokes can be left out for all of them at once.
class RayTile {
 public:
  // `numbers`: of 1 to kTileRays rays.
  RayTile(NormalRays& rays, const ToolSweep& sweep, const std::uint32_t* numbers, std::size_t count);

  void cut(const Context& context);

 private:
  static constexpr std::size_t kBundleRays = kTileRays / kLanes;

  using Strokes = std::vector<std::uint32_t>;

  const Ray& ray(std::size_t slot) const { return rays_.rays[numbers_[slot]]; }
  double& height(std::size_t slot) { return rays_.height[numbers_[slot]]; }
  void put(std::size_t slot);
  void look_again();
  void look_again(std::size_t bundle);
  void cut(Strokes& strokes, std::uint32_t pieces, const Context& context);
  void cut_with_ring(std::size_t bundle, std::uint32_t stroke);
  void cut_with_cones(std::size_t bundle, std::uint32_t stroke, std::uint32_t pieces);
  void cut_with(std::size_t slot, std::uint32_t stroke, std::uint32_t pieces);
  void lower(std::size_t slot, std::uint32_t stroke, double height);

  NormalRays& rays_;
  const ToolSweep& sweep_;
  const RingCutter& cutter_ = widest(kRingCutters);
  const std::uint32_t* numbers_;
  std::size_t count_, bundles_;
  std::array<RayBatch, kTileRays / kLanes> batches_;
  // What is left of the rays where a cut counts: from the true surface, or from the end of what is left below
  // it, to the end of the material.
  BundleBatch ends_{};
  std::array<Box3, kLanes> boxes_;
  Box3 box_;
  std::size_t lowered_ = 0;  // since the last look
};

}  // namespace mpm
