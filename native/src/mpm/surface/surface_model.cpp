#include "mpm/surface/surface_model.h"

#include <algorithm>

#include "mpm/base/error.h"
#include "mpm/surface/tight_bounds.h"

namespace mpm {

SurfaceModel::SurfaceModel(std::vector<Face> faces) : faces_(std::move(faces)) {
  require(std::any_of(faces_.begin(), faces_.end(), [](const Face& f) { return !f.check; }),
          "faces: need at least one face to machine");
  std::vector<Box3> boxes;
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (const BezierPatch& patch : faces_[f].surface.patches()) {
      const TrimRegion::Cover cover = faces_[f].trim.cover(patch.box());
      if (cover == TrimRegion::Cover::outside) continue;
      patches_.push_back({&patch, f, cover});
      boxes.push_back(patch.bounds());
    }
  require(!patches_.empty(), "faces: the trim loops leave nothing of them");
  tree_ = BoxTree(boxes);
}

Box3 SurfaceModel::machined_bounds() const {
  Box3 box;
  for (const PatchRef& p : patches_)
    if (!faces_[p.face].check) extend_by_face(box, *p.patch, faces_[p.face].trim);
  return box;
}

}  // namespace mpm
