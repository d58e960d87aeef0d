// The surface set Σ: every face to machine and every face to keep clear of, ready to be searched.
#pragma once

#include <string>
#include <vector>

#include "mpm/surface/box_tree.h"
#include "mpm/surface/bspline_surface.h"
#include "mpm/surface/trim_region.h"

namespace mpm {

struct Face {
  std::string name;
  BSplineSurface surface;
  TrimRegion trim;
  bool check = false;  // a check face is kept clear of but not machined
};

// A Bézier patch of the model that carries some of its face.
struct PatchRef {
  const BezierPatch* patch;
  std::uint32_t face;
  TrimRegion::Cover cover;  // inside or crossing: patches outside the trim are left out
};

// Never changes once it is made; all faces are in one frame, mm.
//
// Threads: any number may share one.
class SurfaceModel {
 public:
  // Fails: std::invalid_argument where all faces are check faces, or the trims leave nothing of any face.
  explicit SurfaceModel(std::vector<Face> faces);
  SurfaceModel(const SurfaceModel&) = delete;
  SurfaceModel& operator=(const SurfaceModel&) = delete;
  SurfaceModel(SurfaceModel&&) = default;

  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<PatchRef>& patches() const { return patches_; }
  const BoxTree& tree() const { return tree_; }          // over patches()
  const Box3& bounds() const { return tree_.bounds(); }  // of all control points
  // Of the faces that are not check faces, within their trim and tight (tight_bounds.h).
  Box3 machined_bounds() const;

 private:
  std::vector<Face> faces_;
  std::vector<PatchRef> patches_;
  BoxTree tree_;
};

}  // namespace mpm
