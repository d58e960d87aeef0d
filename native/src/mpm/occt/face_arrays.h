// One face as plain arrays: what crosses from OpenCASCADE to the rest of the program.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "mpm/base/types.h"

namespace mpm::occt {

// A face in the part frame (its placement applied), mm. The surface is a B-spline of degree 1 to 10 that is
// not periodic; `kind` tells what it was in the file.
struct FaceArrays {
  std::string name;  // Face1, Face2, … in the order of TopExp, as FreeCAD counts
  // plane, cylinder, cone, sphere, torus, revolution, extrusion, bezier, bspline, offset, other
  std::string kind;
  int degree_u = 1, degree_v = 1;
  std::vector<double> knots_u, knots_v;  // flat: multiplicities written out
  std::size_t poles_u = 0, poles_v = 0;
  std::vector<Vec3> poles;      // poles_u * poles_v, row-major in u
  std::vector<double> weights;  // as many, or empty: not rational
  // Closed polygons in (u, v), even-odd; none: the whole rectangle.
  std::vector<std::vector<Vec2>> trim_loops;
  bool reversed = false;      // the material lies on the side of Su x Sv
  double deviation_mm = 0.0;  // 0: exact; else the kernel's bound for its approximation of the surface
};

// All faces of `shape`, converted. `chord_mm`: how far a side of a trim loop may be from the trimming curve.
//
// Fails: std::invalid_argument when there is no face or when one, which it names, cannot be converted, and
//   for a chord_mm that is not positive.
std::vector<FaceArrays> face_arrays(const TopoDS_Shape& shape, double chord_mm);

FaceArrays face_arrays(const TopoDS_Face& face, const std::string& name, double chord_mm);

// The faces of `shape` in the order in which they are named.
std::vector<TopoDS_Face> faces_in_order(const TopoDS_Shape& shape);

// Back to OpenCASCADE: the surface of `face`, without its trim.
//
// Fails: std::invalid_argument where poles_u * poles_v is not the number of poles; Standard_Failure where
//   OpenCASCADE refuses the rest.
Handle(Geom_BSplineSurface) make_surface(const FaceArrays& face);

}  // namespace mpm::occt
