#include "mpm/occt/face_arrays.h"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include "mpm/base/error.h"
#include "mpm/occt/conversion.h"
#include "mpm/occt/failure.h"
#include "mpm/occt/trim_loops.h"

namespace mpm::occt {
namespace {

std::vector<double> flat(const TColStd_Array1OfReal& knots) { return {knots.begin(), knots.end()}; }

void copy_poles(const Geom_BSplineSurface& s, FaceArrays& face) {
  const bool rational = s.IsURational() || s.IsVRational();
  face.poles_u = std::size_t(s.NbUPoles());
  face.poles_v = std::size_t(s.NbVPoles());
  for (int i = 1; i <= s.NbUPoles(); ++i)
    for (int j = 1; j <= s.NbVPoles(); ++j) {
      const gp_Pnt p = s.Pole(i, j);
      face.poles.emplace_back(p.X(), p.Y(), p.Z());
      if (rational) face.weights.push_back(s.Weight(i, j));
    }
}

FaceArrays converted(const TopoDS_Face& face, const std::string& name, double chord_mm) {
  const ConvertedSurface surface = to_bspline(face);
  FaceArrays result;
  result.name = name;
  result.kind = surface.kind;
  result.degree_u = surface.surface->UDegree();
  result.degree_v = surface.surface->VDegree();
  result.knots_u = flat(surface.surface->UKnotSequence());
  result.knots_v = flat(surface.surface->VKnotSequence());
  copy_poles(*surface.surface, result);
  result.trim_loops = trim_loops(face, surface, chord_mm);
  result.reversed = face.Orientation() == TopAbs_REVERSED;
  result.deviation_mm = surface.deviation_mm;
  return result;
}

struct Knots {
  explicit Knots(int count) : values(1, count), multiplicities(1, count) {}
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
};

Knots grouped(const std::vector<double>& flat_knots) {
  std::vector<double> values;
  std::vector<int> counts;
  for (double k : flat_knots) {
    if (values.empty() || values.back() != k) values.push_back(k), counts.push_back(0);
    ++counts.back();
  }
  Knots result(int(values.size()));
  for (int i = 1; i <= int(values.size()); ++i) {
    result.values(i) = values[i - 1];
    result.multiplicities(i) = counts[i - 1];
  }
  return result;
}

}  // namespace

std::vector<TopoDS_Face> faces_in_order(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape map;
  if (!shape.IsNull()) TopExp::MapShapes(shape, TopAbs_FACE, map);
  std::vector<TopoDS_Face> faces;
  for (int i = 1; i <= map.Extent(); ++i) faces.push_back(TopoDS::Face(map(i)));
  return faces;
}

FaceArrays face_arrays(const TopoDS_Face& face, const std::string& name, double chord_mm) {
  return translating_failures(name, [&] { return converted(face, name, chord_mm); });
}

std::vector<FaceArrays> face_arrays(const TopoDS_Shape& shape, double chord_mm) {
  const std::vector<TopoDS_Face> faces = faces_in_order(shape);
  require(!faces.empty(), "there is no face in it");
  std::vector<FaceArrays> result;
  for (const TopoDS_Face& face : faces)
    result.push_back(face_arrays(face, "Face" + std::to_string(result.size() + 1), chord_mm));
  return result;
}

Handle(Geom_BSplineSurface) make_surface(const FaceArrays& face) {
  require(face.poles.size() == face.poles_u * face.poles_v, "poles: need poles_u x poles_v points");
  TColgp_Array2OfPnt poles(1, int(face.poles_u), 1, int(face.poles_v));
  TColStd_Array2OfReal weights(1, int(face.poles_u), 1, int(face.poles_v));
  for (std::size_t i = 0; i < face.poles.size(); ++i) {
    const int row = 1 + int(i / face.poles_v), column = 1 + int(i % face.poles_v);
    const Vec3& p = face.poles[i];
    poles(row, column) = gp_Pnt(p.x(), p.y(), p.z());
    weights(row, column) = face.weights.empty() ? 1.0 : face.weights[i];
  }
  const Knots u = grouped(face.knots_u), v = grouped(face.knots_v);
  return new Geom_BSplineSurface(
      poles, weights, u.values, v.values, u.multiplicities, v.multiplicities, face.degree_u, face.degree_v);
}

}  // namespace mpm::occt
