// A second opinion on clearance by dense sampling: no proof, but independent of every positioning method.
#pragma once

#include <vector>

#include "mpm/surface/surface_model.h"
#include "mpm/tool/tool.h"

namespace mpm {

struct SampledClearance {
  double distance;     // mm, least signed distance found: the true clearance is at most this
  Vec3 witness;        // the surface point that has it
  std::uint32_t face;  // its face
};

class ClearanceSampler {
 public:
  ClearanceSampler(const SurfaceModel& model, const Tool& tool);

  // Least signed distance of sampled surface points (trimmed away ones left out) from the tool's body at
  // `pose`, refined round the lowest samples. Surfaces farther than `range` mm count as `range` away. Same
  // answer from any thread.
  SampledClearance operator()(const ToolPose& pose, double range) const;

 private:
  struct Tile {
    const BezierPatch* patch;
    std::uint32_t face;
    bool trimmed;
    ParamBox box;
  };
  struct Sample {
    double distance;
    double u, v;
    const Tile* tile;
  };
  void sample(const Tile& tile, const ParamBox& part, const ToolPose& pose, Sample& best) const;

  const SurfaceModel& model_;
  Tool tool_;
  std::vector<Tile> tiles_;
  BoxTree tree_;
};

}  // namespace mpm
