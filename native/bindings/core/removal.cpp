#include "common.h"
#include "mpm/removal/height_map.h"

namespace mpm::bindings {
namespace {

py::array_t<double> machined_heights(
    const Tool& tool,
    const DoubleArray& tip,
    const DoubleArray& axis,
    const py::array_t<bool, py::array::c_style | py::array::forcecast>& removes,
    const Vec2& lo,
    const Vec2& hi,
    double cell_mm,
    double top_mm,
    double step_mm,
    double tolerance_mm,
    Context& context) {
  const std::vector<Vec3> tips = to_vectors<Vec3>(tip, "tip"), axes = to_vectors<Vec3>(axis, "axis");
  require(tips.size() == axes.size(), "tip and axis must have the same shape (M, 3)");
  require(removes.ndim() == 1, "removes must have shape (M,), got " + shape_of(removes));
  SweptPath path;
  for (std::size_t i = 0; i < tips.size(); ++i) path.poses.push_back({tips[i], axes[i]});
  path.removes.assign(removes.data(), removes.data() + removes.size());
  HeightMap stock = make_stock(lo, hi, cell_mm, top_mm);
  {
    py::gil_scoped_release release;
    remove_material(stock, tool, path, {step_mm, tolerance_mm}, context);
  }
  py::array_t<double> result({py::ssize_t(stock.rows), py::ssize_t(stock.columns)});
  std::copy(stock.height.begin(), stock.height.end(), result.mutable_data());
  return result;
}

}  // namespace

void bind_removal(py::module_& m) {
  m.def("machined_heights",
        &machined_heights,
        py::arg("tool"),
        py::arg("tip"),
        py::arg("axis"),
        py::arg("removes"),
        py::arg("lo"),
        py::arg("hi"),
        py::kw_only(),
        py::arg("cell_mm"),
        py::arg("top_mm"),
        py::arg("step_mm"),
        py::arg("tolerance_mm") = RemovalOptions{}.tolerance,
        py::arg("context"),
        "What the moves leave of a stock with a flat top at top_mm over the plan rectangle lo..hi of the "
        "set-up frame: "
        "heights (rows, columns) at x = lo[0] + column * cell_mm, y = lo[1] + row * cell_mm. tip, axis (M, "
        "3); removes "
        "(M,): does the move from pose i - 1 to pose i take material away? step_mm: largest motion of the "
        "tool between "
        "simulated poses, best half a cell.");
}

}  // namespace mpm::bindings
