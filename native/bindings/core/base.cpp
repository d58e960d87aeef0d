#include "common.h"
#include "mpm/base/context.h"
#include "mpm/base/direction.h"
#include "mpm/base/pose_motion.h"

namespace mpm::bindings {
namespace {

py::tuple between(
    const Vec3& tip, const Vec3& axis, const Vec3& tip_to, const Vec3& axis_to, double fraction) {
  const TipPose from{tip, to_direction(axis, "axis")}, to{tip_to, to_direction(axis_to, "axis_to")};
  require(angle_between(from.axis, to.axis) < kPi, "axis and axis_to must not be opposite");
  const TipPose pose = pose_between(from, to, fraction);
  return py::make_tuple(pose.tip, pose.axis);
}

}  // namespace

void bind_base(py::module_& m) {
  py::class_<Context>(m, "Context", "Progress and cancel of one long call; threads = 0 uses all cores.")
      .def(py::init<int>(), py::arg("threads") = 0)
      .def("cancel", &Context::cancel)
      .def_property_readonly("cancelled", &Context::cancelled)
      .def_property_readonly("done", &Context::done)
      .def_property_readonly("total", &Context::total);
  m.def("pose_between",
        &between,
        py::arg("tip"),
        py::arg("axis"),
        py::arg("tip_to"),
        py::arg("axis_to"),
        py::arg("fraction"),
        "The pose that far (0 to 1) from one pose to another: tip on the straight line, axis on the great "
        "circle.");
}

}  // namespace mpm::bindings
