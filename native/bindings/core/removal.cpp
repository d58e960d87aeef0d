#include "columns.h"
#include "mpm/removal/dexel_mesh.h"
#include "mpm/removal/dexel_stock.h"
#include "mpm/removal/normal_rays.h"
#include "mpm/removal/overcut.h"
#include "mpm/removal/surface_samples.h"

namespace mpm::bindings {
namespace {

SweptPath to_path(const DoubleArray& tip, const DoubleArray& axis, const FlagArray& removes) {
  const std::vector<Vec3> tips = to_vectors<Vec3>(tip, "tip"), axes = to_vectors<Vec3>(axis, "axis");
  require(tips.size() == axes.size(), "tip and axis must have the same shape (M, 3)");
  SweptPath path;
  for (std::size_t i = 0; i < tips.size(); ++i) path.poses.push_back({tips[i], axes[i]});
  path.removes = to_scalars<std::uint8_t>(removes, "removes");
  return path;
}

ToolSweep make_sweep(const Tool& tool,
                     const DoubleArray& tip,
                     const DoubleArray& axis,
                     const FlagArray& removes) {
  return {tool, to_path(tip, axis, removes)};
}

py::tuple overcut(const Tool& tool,
                  const DoubleArray& tip,
                  const DoubleArray& axis,
                  const FlagArray& removes,
                  const DoubleArray& points,
                  Context& context) {
  const SweptPath path = to_path(tip, axis, removes);
  const std::vector<Vec3> at = to_vectors<Vec3>(points, "points");
  const Overcut found = without_gil([&] { return find_overcut(at, tool, path, context); });
  return py::make_tuple(to_array(found.depth), to_array(found.move));
}

py::tuple cut_free_rays(const ToolSweep& sweep,
                        const DoubleArray& origins,
                        const DoubleArray& directions,
                        const DoubleArray& height,
                        const std::optional<IntArray>& move,
                        double below_mm,
                        Context& context) {
  const std::size_t count = vectors_in<Vec3>(origins, "origins");
  require(count == vectors_in<Vec3>(directions, "directions"),
          "origins and directions must have the same shape (N, 3)");
  NormalRays rays{{}, to_scalars(height, "height"), {}, below_mm};
  rays.rays.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    rays.rays.push_back({vector_at<Vec3>(origins, i), vector_at<Vec3>(directions, i)});
  rays.move.assign(count, -1);
  if (move) rays.move = to_scalars<std::int32_t>(*move, "move");
  without_gil([&] { cut_rays(rays, sweep, context); });
  return py::make_tuple(to_array(rays.height), to_array(rays.move));
}

py::tuple mesh_of(const DexelStock& stock) {
  const TriangleMesh mesh = without_gil([&] { return stock_mesh(stock); });
  return py::make_tuple(to_array(mesh.vertices), to_array(mesh.triangles));
}

py::list dexel(const DexelStock& stock, int axis, std::size_t u, std::size_t v) {
  require(axis >= 0 && axis < 3, "axis must be 0, 1 or 2");
  const DexelField& field = stock.fields[std::size_t(axis)];
  require(u < field.count_u() && v < field.count_v(), "u, v: no such dexel");
  py::list spans;
  for (const Span* s = field.begin(u, v); s != field.end(u, v); ++s)
    spans.append(py::make_tuple(s->from, s->to));
  return spans;
}

py::dict surface_samples(
    const SurfaceModel& model, double spacing_mm, const Vec3& lo, const Vec3& hi, Context& context) {
  const SurfaceSamples samples = without_gil([&] {
    return sample_surfaces(model, spacing_mm, Box3{lo, hi}, context);
  });
  return table({{"points", to_array(samples.points)},
                {"normals", to_array(samples.normals)},
                {"at", to_array(samples.at)},
                {"face", to_array(samples.face)},
                {"triangles", to_array(samples.triangles)}});
}

void bind_stock(py::module_& m) {
  py::class_<DexelStock>(
      m,
      "DexelStock",
      "A block of stock lo..hi (set-up frame, mm) as dexels along x, y and z, cell_mm apart.")
      .def(py::init([](const Vec3& lo, const Vec3& hi, double cell_mm) {
             return DexelStock(make_dexel_grid(lo, hi, cell_mm));
           }),
           py::arg("lo"),
           py::arg("hi"),
           py::arg("cell_mm"))
      .def_static(
          "bytes_needed",
          [](const Vec3& lo, const Vec3& hi, double cell_mm) {
            return dexel_bytes(make_dexel_grid(lo, hi, cell_mm));
          },
          py::arg("lo"),
          py::arg("hi"),
          py::arg("cell_mm"),
          "Memory of such a stock while each dexel holds one piece of material.")
      .def_property_readonly("counts", [](const DexelStock& s) { return s.grid.count; })
      .def_property_readonly(
          "bytes",
          [](const DexelStock& s) { return s.fields[0].bytes() + s.fields[1].bytes() + s.fields[2].bytes(); })
      .def_property_readonly("volume_mm3", &DexelStock::volume)
      .def("cut",
           &cut_stock,
           py::arg("sweep"),
           py::arg("context"),
           py::call_guard<py::gil_scoped_release>(),
           "Takes what the tool sweeps out of the stock.")
      .def("dexel",
           &dexel,
           py::arg("axis"),
           py::arg("u"),
           py::arg("v"),
           "Spans (from, to) of material on the dexel along axis through node u of axis + 1 and v of axis + "
           "2 (cyclic).")
      .def("mesh",
           &mesh_of,
           "Closed surface: vertices (V, 3), triangles (T, 3) counter-clockwise seen from outside.");
}

}  // namespace

void bind_removal(py::module_& m) {
  py::class_<ToolSweep>(m, "ToolSweep", "What a tool sweeps on its way.")
      .def(py::init(&make_sweep),
           py::arg("tool"),
           py::arg("tip"),
           py::arg("axis"),
           py::arg("removes"),
           "tip, axis (M, 3) in the set-up frame; removes (M,): does the move from pose i - 1 to pose i take "
           "material away?")
      .def_property_readonly("strokes", [](const ToolSweep& s) { return s.strokes().size(); });
  bind_stock(m);
  m.def(
      "cut_rays",
      &cut_free_rays,
      py::arg("sweep"),
      py::arg("origins"),
      py::arg("directions"),
      py::arg("height"),
      py::kw_only(),
      py::arg("move") = py::none(),
      py::arg("below_mm"),
      py::arg("context"),
      "Where the material on rays from the true surface outwards ends after the cut: height (N,) mm, below 0 "
      "where the tool cut in, down to -below_mm; and the moves (N,) that cut there, -1: none. height, move: "
      "before the cut.");
  m.def("overcut",
        &overcut,
        py::arg("tool"),
        py::arg("tip"),
        py::arg("axis"),
        py::arg("removes"),
        py::arg("points"),
        py::kw_only(),
        py::arg("context"),
        "How deep points (N, 3) that are to stay lie inside what the tool sweeps: depth (N,) mm, 0 where it "
        "never "
        "holds them, and the moves (N,) that go deepest there, -1: none. tip, axis, removes: as for "
        "ToolSweep.");
  m.def("sample_surfaces",
        &surface_samples,
        py::arg("model"),
        py::kw_only(),
        py::arg("spacing_mm"),
        py::arg("lo"),
        py::arg("hi"),
        py::arg("context"),
        "Points of the faces to machine about spacing_mm apart, those well outside of lo..hi left out.");
}

}  // namespace mpm::bindings
