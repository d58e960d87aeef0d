// Any surface of a face as a B-spline that is not periodic.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Face.hxx>
#include <string>

#include "mpm/occt/parameter_map.h"

namespace mpm::occt {

struct ConvertedSurface {
  std::string kind;                     // what the file says it is (see FaceArrays)
  Handle(Geom_BSplineSurface) surface;  // placed, not periodic, degree at most 10
  ParameterMap map_u, map_v;  // from the face's own parameters (those of its pcurves) to the B-spline's
  double deviation_mm = 0.0;  // 0: exact; else the bound of the approximation
};

// Conversion by OpenCASCADE. B-splines and Béziers keep their poles; unbounded surfaces are cut to the face's
// UV box first; offset surfaces without an exact form and degrees over 10 are approximated (`deviation_mm`).
//
// Fails: std::invalid_argument for a face without a surface or a range of parameters, and where the
//   approximation gives nothing; OpenCASCADE's own Standard_Failure, which face_arrays() translates.
ConvertedSurface to_bspline(const TopoDS_Face& face);

}  // namespace mpm::occt
