#include "mpm/occt/conversion.h"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Precision.hxx>
#include <algorithm>
#include <vector>

#include "mpm/base/error.h"
#include "mpm/base/types.h"
#include "mpm/surface/bezier_patch.h"

namespace mpm::occt {
namespace {

// What a surface without an exact B-spline form may deviate from it, mm: a tenth of the usual gouge
// tolerance.
constexpr double kApproximationTolerance_mm = 1e-4;
constexpr int kApproximationDegree = 8;
constexpr int kApproximationSegments = 200;
// Two evaluations of the same point agree to this part of the surface's size.
constexpr double kSamePoint = 1e-9;
constexpr int kMapSamples = 9;

Handle(Geom_Surface) without_frame_of_trim(Handle(Geom_Surface) surface) {
  while (true) {
    const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface);
    if (trimmed.IsNull()) return surface;
    surface = trimmed->BasisSurface();
  }
}

std::string kind_of(const Handle(Geom_Surface) & surface) {
  switch (GeomAdaptor_Surface(surface).GetType()) {
    case GeomAbs_Plane:
      return "plane";
    case GeomAbs_Cylinder:
      return "cylinder";
    case GeomAbs_Cone:
      return "cone";
    case GeomAbs_Sphere:
      return "sphere";
    case GeomAbs_Torus:
      return "torus";
    case GeomAbs_SurfaceOfRevolution:
      return "revolution";
    case GeomAbs_SurfaceOfExtrusion:
      return "extrusion";
    case GeomAbs_BezierSurface:
      return "bezier";
    case GeomAbs_BSplineSurface:
      return "bspline";
    case GeomAbs_OffsetSurface:
      return "offset";
    default:
      return "other";
  }
}

// One direction of the face's UV box, kept within what the surface has: the kernel's box may be a little too
// large.
void clamp_range(double& lo, double& hi, double first, double last, bool periodic) {
  if (periodic) {
    hi = std::min(hi, lo + (last - first));
    return;
  }
  if (!Precision::IsNegativeInfinite(first)) lo = std::max(lo, first);
  if (!Precision::IsPositiveInfinite(last)) hi = std::min(hi, last);
}

ParamBox uv_box(const TopoDS_Face& face, const Handle(Geom_Surface) & surface) {
  ParamBox box, own;
  BRepTools::UVBounds(face, box.u0, box.u1, box.v0, box.v1);
  surface->Bounds(own.u0, own.u1, own.v0, own.v1);
  clamp_range(box.u0, box.u1, own.u0, own.u1, surface->IsUPeriodic());
  clamp_range(box.v0, box.v1, own.v0, own.v1, surface->IsVPeriodic());
  require(box.u0 < box.u1 && box.v0 < box.v1, "its range of parameters is empty");
  return box;
}

bool within(double lo, double hi, double first, double last) {
  const double slack = Precision::PConfusion();
  return first - slack <= lo && hi <= last + slack;
}

// A periodic B-spline opened where the face lies: at its own seam, unless the face crosses that.
void open_periodic(Geom_BSplineSurface& s, const ParamBox& face) {
  ParamBox own;
  s.Bounds(own.u0, own.u1, own.v0, own.v1);
  const bool cut_u = s.IsUPeriodic() && !within(face.u0, face.u1, own.u0, own.u1);
  const bool cut_v = s.IsVPeriodic() && !within(face.v0, face.v1, own.v0, own.v1);
  if (cut_u || cut_v)
    s.Segment(cut_u ? face.u0 : own.u0,
              cut_u ? face.u1 : own.u1,
              cut_v ? face.v0 : own.v0,
              cut_v ? face.v1 : own.v1);
  if (s.IsUPeriodic()) s.SetUNotPeriodic();
  if (s.IsVPeriodic()) s.SetVNotPeriodic();
}

// Approximation keeps the parameters, so the face's pcurves fit it as they are.
void approximate(const Handle(Geom_Surface) & surface, ConvertedSurface& result) {
  const GeomConvert_ApproxSurface approximation(surface,
                                                kApproximationTolerance_mm,
                                                GeomAbs_C1,
                                                GeomAbs_C1,
                                                kApproximationDegree,
                                                kApproximationDegree,
                                                kApproximationSegments,
                                                0);
  require(approximation.HasResult(), "its " + result.kind + " surface cannot be approximated by a B-spline");
  result.surface = approximation.Surface();
  result.deviation_mm = approximation.MaxError();
}

std::vector<double> distinct(const TColStd_Array1OfReal& knots) { return {knots.begin(), knots.end()}; }

double size_of(const Geom_BSplineSurface& s) {
  Box3 box;
  for (int i = 1; i <= s.NbUPoles(); ++i)
    for (int j = 1; j <= s.NbVPoles(); ++j)
      box.extend(Vec3(s.Pole(i, j).X(), s.Pole(i, j).Y(), s.Pole(i, j).Z()));
  return box.diagonal();
}

// Does `converted` under its maps run like `surface` over its whole domain?
bool same_parameters(const Handle(Geom_Surface) & surface, const ConvertedSurface& converted) {
  ParamBox box;
  converted.surface->Bounds(box.u0, box.u1, box.v0, box.v1);
  const double tolerance = kSamePoint * size_of(*converted.surface);
  for (int i = 0; i < kMapSamples; ++i)
    for (int j = 0; j < kMapSamples; ++j) {
      const double u = box.u0 + (box.u1 - box.u0) * (i + 0.5) / kMapSamples;
      const double v = box.v0 + (box.v1 - box.v0) * (j + 0.5) / kMapSamples;
      const gp_Pnt ours = converted.surface->Value(converted.map_u(u), converted.map_v(v));
      if (surface->Value(u, v).Distance(ours) > tolerance) return false;
    }
  return true;
}

// Which parameters are angles that the conversion has re-parametrized? Tried rather than deduced from the
// kind, so that a swept circle, a revolved ellipse and a torus all come out right, and nothing is believed
// unchecked.
bool find_maps(const Handle(Geom_Surface) & surface, ConvertedSurface& converted) {
  const ParameterMap angle_u(distinct(converted.surface->UKnots())),
      angle_v(distinct(converted.surface->VKnots()));
  for (const ParameterMap& u : {ParameterMap(), angle_u})
    for (const ParameterMap& v : {ParameterMap(), angle_v}) {
      converted.map_u = u, converted.map_v = v;
      if (same_parameters(surface, converted)) return true;
    }
  converted.map_u = converted.map_v = ParameterMap();
  return false;
}

void convert_analytic(const Handle(Geom_Surface) & surface, const ParamBox& box, ConvertedSurface& result) {
  const Handle(Geom_Surface) cut =
      new Geom_RectangularTrimmedSurface(surface, box.u0, box.u1, box.v0, box.v1);
  if (result.kind != "offset" && result.kind != "other") {
    result.surface = GeomConvert::SurfaceToBSplineSurface(cut);
    open_periodic(*result.surface, box);
    if (find_maps(surface, result)) return;
  }
  approximate(cut, result);
}

bool degree_fits(const Geom_BSplineSurface& s) {
  return s.UDegree() <= kMaxDegree && s.VDegree() <= kMaxDegree;
}

}  // namespace

ConvertedSurface to_bspline(const TopoDS_Face& face) {
  Handle(Geom_Surface) surface = without_frame_of_trim(BRep_Tool::Surface(face));
  require(!surface.IsNull(), "it has no surface");
  ConvertedSurface result;
  result.kind = kind_of(surface);
  if (const auto offset = Handle(Geom_OffsetSurface)::DownCast(surface); !offset.IsNull()) {
    const Handle(Geom_Surface) exact =
        offset->Surface();  // an offset plane is a plane, and so on; null if there is none
    if (!exact.IsNull()) surface = without_frame_of_trim(exact), result.kind = kind_of(surface);
  }
  const ParamBox box = uv_box(face, surface);
  if (result.kind == "bspline") {
    result.surface = Handle(Geom_BSplineSurface)::DownCast(surface->Copy());
    open_periodic(*result.surface, box);
  } else if (result.kind == "bezier") {
    result.surface = GeomConvert::SurfaceToBSplineSurface(surface);
  } else {
    convert_analytic(surface, box, result);
  }
  if (!degree_fits(*result.surface)) approximate(result.surface, result);
  return result;
}

}  // namespace mpm::occt
