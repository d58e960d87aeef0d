#include "mpm/surface/tight_bounds.h"

#include <algorithm>

namespace mpm {
namespace {

constexpr int kMaxHalvings = 16;  // 8 in each direction

bool reaches_beyond(const Box3& piece, const Box3& box, double slack) {
  return (piece.lo.array() < box.lo.array() - slack).any() ||
         (piece.hi.array() > box.hi.array() + slack).any();
}

class FaceExtender {
 public:
  FaceExtender(Box3& box, const BezierPatch& patch, const TrimRegion& trim)
      : box_(box), trim_(trim), slack_(kTightness * patch.bounds().diagonal()) {}

  void extend(const BezierPatch& piece, int halvings) {
    const Box3 bounds = piece.bounds();
    if (!reaches_beyond(bounds, box_, slack_)) return;
    const TrimRegion::Cover cover = trim_.cover(piece.box());
    if (cover == TrimRegion::Cover::outside) return;
    add_corners(piece, cover);
    if (cover == TrimRegion::Cover::crossing) add_boundary(piece);
    if (halvings > 0)
      halve(piece, halvings);
    else if (cover == TrimRegion::Cover::inside)
      grow(bounds.lo), grow(bounds.hi);
  }

 private:
  void add_corners(const BezierPatch& piece, TrimRegion::Cover cover) {
    const ParamBox& b = piece.box();
    for (double u : {b.u0, b.u1})
      for (double v : {b.v0, b.v1})
        if (cover == TrimRegion::Cover::inside || trim_.contains(u, v)) grow(piece.point(u, v));
  }

  void add_boundary(const BezierPatch& piece) {
    trim_.visit_sides(piece.box(), [&](const Vec2& a, const Vec2& b) {
      grow(piece.point(a.x(), a.y()));
      grow(piece.point(b.x(), b.y()));
    });
  }

  void halve(const BezierPatch& piece, int halvings) {
    ParamBox first = piece.box(), second = first;
    if (halvings % 2 == 0)
      first.u1 = second.u0 = first.u_mid();
    else
      first.v1 = second.v0 = first.v_mid();
    extend(piece.restricted(first), halvings - 1);
    extend(piece.restricted(second), halvings - 1);
  }

  // Only where the point is clearly outside: rounding must not turn a straight edge at 150 into
  // 150.00000000000003.
  void grow(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < box_.lo[axis] - slack_) box_.lo[axis] = p[axis];
      if (p[axis] > box_.hi[axis] + slack_) box_.hi[axis] = p[axis];
    }
  }

  Box3& box_;
  const TrimRegion& trim_;
  double slack_;
};

}  // namespace

void extend_by_face(Box3& box, const BezierPatch& patch, const TrimRegion& trim) {
  FaceExtender(box, patch, trim).extend(patch, kMaxHalvings);
}

}  // namespace mpm
