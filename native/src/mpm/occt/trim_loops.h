// The boundary of a face as polygons in the parameters of its converted surface.
#pragma once

#include <TopoDS_Face.hxx>
#include <vector>

#include "mpm/base/types.h"
#include "mpm/occt/conversion.h"

namespace mpm::occt {

// Closed polygons (even-odd rule; the last point is not repeated) whose sides are within `chord_mm` of the
// trimming curves, measured on the surface. Points on the edge of the surface's domain lie on it exactly.
// Empty when the boundary is the whole edge of the domain: the face is not trimmed.
//
// Fails: std::invalid_argument when a boundary is broken or encloses nothing, and for a chord_mm that is not
//   positive.
std::vector<std::vector<Vec2>> trim_loops(const TopoDS_Face& face,
                                          const ConvertedSurface& surface,
                                          double chord_mm);

}  // namespace mpm::occt
