#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <Precision.hxx>
#include <Standard_Version.hxx>
#include <TopoDS_Compound.hxx>

#include "core/columns.h"
#include "mpm/occt/face_arrays.h"
#include "mpm/occt/failure.h"
#include "mpm/occt/shape_file.h"

namespace mpm::bindings {
namespace {

using occt::FaceArrays;

py::dict to_dict(const FaceArrays& face) {
  const py::ssize_t nu = py::ssize_t(face.poles_u), nv = py::ssize_t(face.poles_v);
  py::object weights = py::none();
  if (!face.weights.empty()) weights = to_array(face.weights).reshape({nu, nv});
  py::list loops;
  for (const auto& loop : face.trim_loops) loops.append(to_array(loop));
  return table({{"name", py::cast(face.name)},
                {"kind", py::cast(face.kind)},
                {"degree_u", py::cast(face.degree_u)},
                {"degree_v", py::cast(face.degree_v)},
                {"knots_u", to_array(face.knots_u)},
                {"knots_v", to_array(face.knots_v)},
                {"poles", to_array(face.poles).reshape({nu, nv, py::ssize_t(3)})},
                {"weights", weights},
                {"trim_loops", loops},
                {"reversed", py::cast(face.reversed)},
                {"deviation_mm", py::cast(face.deviation_mm)}});
}

py::list to_dicts(const std::vector<FaceArrays>& faces) {
  py::list result;
  for (const FaceArrays& face : faces) result.append(to_dict(face));
  return result;
}

FaceArrays surface_arrays(int degree_u,
                          int degree_v,
                          const DoubleArray& knots_u,
                          const DoubleArray& knots_v,
                          const DoubleArray& poles,
                          const std::optional<DoubleArray>& weights) {
  require(poles.ndim() == 3 && poles.shape(2) == 3,
          "poles must have shape (nu, nv, 3), got " + shape_of(poles));
  FaceArrays face;
  face.degree_u = degree_u;
  face.degree_v = degree_v;
  face.knots_u = to_scalars(knots_u, "knots_u");
  face.knots_v = to_scalars(knots_v, "knots_v");
  face.poles_u = std::size_t(poles.shape(0));
  face.poles_v = std::size_t(poles.shape(1));
  face.poles = to_vectors<Vec3>(poles, "poles");
  if (weights) {
    require(weights->size() * 3 == poles.size(), "weights must have shape (nu, nv) like the poles");
    face.weights.assign(weights->data(), weights->data() + weights->size());
  }
  return face;
}

// One surface from the dictionary that read_file gives; its trim loops are not used.
FaceArrays from_dict(const py::dict& d) {
  std::optional<DoubleArray> weights;
  if (d.contains("weights") && !d["weights"].is_none()) weights = d["weights"].cast<DoubleArray>();
  return surface_arrays(d["degree_u"].cast<int>(),
                        d["degree_v"].cast<int>(),
                        d["knots_u"].cast<DoubleArray>(),
                        d["knots_v"].cast<DoubleArray>(),
                        d["poles"].cast<DoubleArray>(),
                        weights);
}

py::list read_file(const std::string& path, double chord_mm) {
  return to_dicts(without_gil([&] {
    const TopoDS_Shape shape = occt::read_shape(path);
    return occt::translating_failures(path, [&] { return occt::face_arrays(shape, chord_mm); });
  }));
}

py::list read_brep_string(const std::string& text, double chord_mm) {
  return to_dicts(without_gil([&] {
    const TopoDS_Shape shape = occt::read_brep_text(text);
    return occt::translating_failures("BREP text", [&] { return occt::face_arrays(shape, chord_mm); });
  }));
}

TopoDS_Shape compound_of(const std::vector<FaceArrays>& faces) {
  const BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (const FaceArrays& face : faces)
    builder.Add(compound, BRepBuilderAPI_MakeFace(occt::make_surface(face), Precision::Confusion()).Face());
  return faces.size() == 1
             ? TopoDS_Shape(BRepBuilderAPI_MakeFace(occt::make_surface(faces[0]), Precision::Confusion()))
             : TopoDS_Shape(compound);
}

void write_step(const std::string& path, const std::vector<py::dict>& dicts, const std::string& name) {
  require(!dicts.empty(), "faces: need at least one");
  std::vector<FaceArrays> faces;
  for (const py::dict& d : dicts) faces.push_back(from_dict(d));
  without_gil([&] {
    occt::write_step(occt::translating_failures("faces", [&] { return compound_of(faces); }), path, name);
  });
}

void evaluate_into(const Geom_BSplineSurface& surface, double u, double v, double* out) {
  gp_Pnt p;
  gp_Vec su, sv, suu, svv, suv;
  surface.D2(u, v, p, su, sv, suu, svv, suv);
  for (const gp_XYZ& one : {p.XYZ(), su.XYZ(), sv.XYZ(), suu.XYZ(), suv.XYZ(), svv.XYZ()})
    for (int axis = 1; axis <= 3; ++axis) *out++ = one.Coord(axis);
}

py::array_t<double> evaluate(int degree_u,
                             int degree_v,
                             const DoubleArray& knots_u,
                             const DoubleArray& knots_v,
                             const DoubleArray& poles,
                             const std::optional<DoubleArray>& weights,
                             const DoubleArray& u,
                             const DoubleArray& v) {
  require(u.ndim() == 1 && v.ndim() == 1 && u.size() == v.size(), "u and v must have the same shape (N,)");
  const FaceArrays face = surface_arrays(degree_u, degree_v, knots_u, knots_v, poles, weights);
  py::array_t<double> result({u.size(), py::ssize_t(6), py::ssize_t(3)});
  occt::translating_failures("surface", [&] {
    const Handle(Geom_BSplineSurface) surface = occt::make_surface(face);
    for (py::ssize_t i = 0; i < u.size(); ++i)
      evaluate_into(*surface, u.at(i), v.at(i), result.mutable_data(i, 0, 0));
  });
  return result;
}

}  // namespace
}  // namespace mpm::bindings

PYBIND11_MODULE(_occt, m) {
  using namespace mpm::bindings;
  constexpr double kDefaultChord_mm = 0.01;
  m.doc() = "OpenCASCADE reader: STEP, IGES and BREP to arrays. Lengths in mm.";
  m.attr("OCC_VERSION") = OCC_VERSION_COMPLETE;
  m.def("read_file",
        &read_file,
        py::arg("path"),
        py::arg("chord_mm") = kDefaultChord_mm,
        "All faces of a STEP, IGES or BREP file as B-spline surfaces with trim loops within chord_mm of the "
        "trimming "
        "curves. ValueError names file and face.");
  m.def("read_brep_string",
        &read_brep_string,
        py::arg("text"),
        py::arg("chord_mm") = kDefaultChord_mm,
        "The same from the text of a BREP file, such as FreeCAD's Shape.exportBrepToString() gives.");
  m.def("write_step",
        &write_step,
        py::arg("path"),
        py::arg("faces"),
        py::arg("name") = "part",
        "Write untrimmed B-spline faces (dictionaries with degrees, knots, poles, weights) as STEP in mm.");
  m.def("evaluate",
        &evaluate,
        py::arg("degree_u"),
        py::arg("degree_v"),
        py::arg("knots_u"),
        py::arg("knots_v"),
        py::arg("poles"),
        py::arg("weights"),
        py::arg("u"),
        py::arg("v"),
        "OpenCASCADE's own S, Su, Sv, Suu, Suv, Svv at u (N,), v (N,): array (N, 6, 3). To check other "
        "evaluators.");
}
