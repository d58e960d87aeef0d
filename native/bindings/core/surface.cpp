#include "common.h"
#include "mpm/surface/surface_model.h"

namespace mpm::bindings {
namespace {

BSplineSurface make_surface(int degree_u,
                            int degree_v,
                            const DoubleArray& knots_u,
                            const DoubleArray& knots_v,
                            const DoubleArray& poles,
                            const std::optional<DoubleArray>& weights) {
  require(poles.ndim() == 3 && poles.shape(2) == 3,
          "poles must have shape (nu, nv, 3), got " + shape_of(poles));
  std::vector<double> w;
  if (weights) {
    require(
        weights->ndim() == 2 && weights->shape(0) == poles.shape(0) && weights->shape(1) == poles.shape(1),
        "weights must have shape (nu, nv) like the poles, got " + shape_of(*weights));
    w.assign(weights->data(), weights->data() + weights->size());
  }
  const std::vector<double> ku = to_scalars(knots_u, "knots_u"), kv = to_scalars(knots_v, "knots_v");
  require(py::ssize_t(ku.size()) == poles.shape(0) + degree_u + 1,
          "knots_u must have nu + degree_u + 1 = " + std::to_string(poles.shape(0) + degree_u + 1) +
              " entries, got " + std::to_string(ku.size()));
  require(py::ssize_t(kv.size()) == poles.shape(1) + degree_v + 1,
          "knots_v must have nv + degree_v + 1 = " + std::to_string(poles.shape(1) + degree_v + 1) +
              " entries, got " + std::to_string(kv.size()));
  return BSplineSurface(degree_u, degree_v, ku, kv, to_vectors<Vec3>(poles, "poles"), w);
}

py::array_t<double> evaluate(const BSplineSurface& surface, const DoubleArray& u, const DoubleArray& v) {
  require(u.ndim() == 1 && v.ndim() == 1 && u.size() == v.size(), "u and v must have the same shape (N,)");
  py::array_t<double> result({u.size(), py::ssize_t(6), py::ssize_t(3)});
  double* out = result.mutable_data();
  for (py::ssize_t i = 0; i < u.size(); ++i) {
    const SurfacePoint p = surface.evaluate(u.at(i), v.at(i));
    for (const Vec3& one : {p.s, p.su, p.sv, p.suu, p.suv, p.svv}) {
      Eigen::Map<Vec3> target(out);
      target = one;
      out += 3;
    }
  }
  return result;
}

Face make_face(const std::string& name,
               const BSplineSurface& surface,
               const std::vector<DoubleArray>& trim_loops,
               bool check) {
  std::vector<std::vector<Vec2>> loops;
  for (const DoubleArray& loop : trim_loops) loops.push_back(to_vectors<Vec2>(loop, "trim loop"));
  return Face{name, surface, TrimRegion(std::move(loops)), check};
}

}  // namespace

void bind_surface(py::module_& m) {
  py::class_<BSplineSurface>(m, "BSplineSurface", "B-spline surface of degree 1 to 10, rational or not.")
      .def(py::init(&make_surface),
           py::arg("degree_u"),
           py::arg("degree_v"),
           py::arg("knots_u"),
           py::arg("knots_v"),
           py::arg("poles"),
           py::arg("weights") = py::none(),
           "knots: flat, with multiplicities written out; poles (nu, nv, 3) in mm; weights (nu, nv) or None.")
      .def_property_readonly("domain",
                             [](const BSplineSurface& s) {
                               const ParamBox& d = s.domain();
                               return py::make_tuple(d.u0, d.u1, d.v0, d.v1);
                             })
      .def("evaluate",
           &evaluate,
           py::arg("u"),
           py::arg("v"),
           "Point and derivatives S, Su, Sv, Suu, Suv, Svv at u (N,), v (N,): array (N, 6, 3).");
  py::class_<Face>(
      m, "Face", "A surface with its trimming loops; a check face is kept clear of, not machined.")
      .def(py::init(&make_face),
           py::arg("name"),
           py::arg("surface"),
           py::arg("trim_loops") = std::vector<DoubleArray>{},
           py::arg("check") = false,
           "trim_loops: closed polygons (N, 2) in (u, v) under the even-odd rule; none: untrimmed.")
      .def_readonly("name", &Face::name)
      .def_readonly("check", &Face::check);
  py::class_<SurfaceModel>(m, "SurfaceModel", "The surface set: all faces to machine and to keep clear of.")
      .def(py::init([](const std::vector<Face>& faces) { return SurfaceModel(faces); }), py::arg("faces"))
      .def_property_readonly("patches", [](const SurfaceModel& s) { return s.patches().size(); })
      .def(
          "bounds",
          [](const SurfaceModel& s) { return py::make_tuple(s.bounds().lo, s.bounds().hi); },
          "Box (lo, hi) of all faces, mm.")
      .def(
          "machined_bounds",
          [](const SurfaceModel& s) {
            const Box3 box = s.machined_bounds();
            return py::make_tuple(box.lo, box.hi);
          },
          "Box (lo, hi) of the faces to machine, mm.");
}

}  // namespace mpm::bindings
