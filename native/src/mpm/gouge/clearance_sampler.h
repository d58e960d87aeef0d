// A second opinion on clearance by dense sampling: no proof, but independent of every positioning method.
#pragma once

#include <vector>

#include "mpm/surface/surface_model.h"
#include "mpm/tool/tool.h"

namespace mpm {

struct SampledClearance {
  double distance;     // mm, least signed distance found: the true clearance is at most this
  Vec3 witness;        // the surface point that has it; NaN: none is within the range
  std::uint32_t face;  // its face
};

// Requires: the model outlives it; a tool that passes check_tool().
// Threads: any number may ask one.
class ClearanceSampler {
 public:
  ClearanceSampler(const SurfaceModel& model, const Tool& tool);

  // Least signed distance of sampled surface points (trimmed away ones left out) from the tool's body at
  // `pose`, refined round the lowest samples. Surfaces farther than `range` mm count as `range` away. Tiles
  // whose box proves that they cannot be among the lowest are not sampled; the answer is that of sampling
  // all.
  SampledClearance operator()(const ToolPose& pose, double range) const;

 private:
  struct Ball {
    Vec3 center;
    double radius;
  };
  struct Tile {
    const BezierPatch* patch;
    std::uint32_t face;
    bool trimmed;
    ParamBox box;
    Vec3 middle;  // one of the tile's samples
    Ball ball;    // contains the tile
  };
  struct Sample {
    double distance;
    double u, v;
    const Tile* tile;
  };
  struct Candidate {
    double bound;  // no point of the tile is nearer
    const Tile* tile;
  };
  static Ball ball_around(const Box3& box);
  double bound(const Ball& ball, const ToolPose& pose) const;
  std::vector<Candidate> candidates(const ToolPose& pose, double range) const;
  void sample(const Tile& tile, const ParamBox& part, const ToolPose& pose, Sample& best) const;

  const SurfaceModel& model_;
  Tool tool_;
  std::vector<Tile> tiles_;
  BoxTree tree_;
};

}  // namespace mpm
