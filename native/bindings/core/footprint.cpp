#include "columns.h"
#include "mpm/footprint/raster.h"

namespace mpm::bindings {

void bind_footprint(py::module_& m) {
  m.def(
      "raster",
      [](const Vec2& lo,
         const Vec2& hi,
         double direction_deg,
         double side_step_mm,
         double forward_step_mm,
         double margin_mm,
         bool zigzag) {
        const Footprint f =
            raster(lo, hi, {radians(direction_deg), side_step_mm, forward_step_mm, margin_mm, zigzag});
        return py::make_tuple(to_array(f.points), to_array(f.pass));
      },
      py::arg("lo"),
      py::arg("hi"),
      py::kw_only(),
      py::arg("direction_deg"),
      py::arg("side_step_mm"),
      py::arg("forward_step_mm"),
      py::arg("margin_mm") = 0.0,
      py::arg("zigzag") = false,
      "XY-parallel passes over the rectangle lo..hi of the set-up's plane: points (N, 2) and pass index "
      "(N,).");
}

}  // namespace mpm::bindings
