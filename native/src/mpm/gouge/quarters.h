// What the judges of poses and of motions do alike below the leaves of the tree: they quarter a piece of
// surface, and they look at its centre.
#pragma once

#include "mpm/surface/trim_region.h"

namespace mpm {

// mm: a smaller piece that a trim boundary crosses counts as surface, wherever its centre lies. Not a part of
// the tool: it stands against what the trims are good to, polygons off by some 1e-7 mm on parts of any size.
inline constexpr double kTrimResolution = 1e-6;
// mm: smaller pieces are all rounding, at coordinates of any part that a machine holds; hence no part of the
// tool.
inline constexpr double kFinestCell = 1e-10;
inline constexpr int kQuarters = 4;

// Quarter 0 to 3 of a piece: bit 0 is the upper half in u, bit 1 that in v.
inline ParamBox quarter_box(const ParamBox& box, int quarter) {
  const double um = box.u_mid(), vm = box.v_mid();
  return {quarter & 1 ? um : box.u0,
          quarter & 1 ? box.u1 : um,
          quarter & 2 ? vm : box.v0,
          quarter & 2 ? box.v1 : vm};
}

// Halved in both parameters, an eighth of the third derivative is left: its bound over a quarter, given that
// over the piece.
inline double quarter_third(double third) { return third / 8; }

struct QuarterCover {
  bool kept;     // some of it may belong to the face
  bool trimmed;  // and some may not
};

// A quarter of a piece that the trim crosses, when `trimmed`; else nothing is trimmed of it.
inline QuarterCover quarter_cover(const TrimRegion& trim, bool trimmed, const ParamBox& quarter) {
  if (!trimmed) return {true, false};
  const TrimRegion::Cover cover = trim.cover(quarter);
  return {cover != TrimRegion::Cover::outside, cover == TrimRegion::Cover::crossing};
}

// Whether (u, v) of a piece with this radius (mm) is a point of the face, or cannot be told from one.
inline bool counts_as_surface(const TrimRegion& trim, bool trimmed, double radius, double u, double v) {
  return !trimmed || !(radius > kTrimResolution) || trim.contains(u, v);
}

}  // namespace mpm
