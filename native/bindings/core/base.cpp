#include "common.h"
#include "mpm/base/context.h"

namespace mpm::bindings {

void bind_base(py::module_& m) {
  py::class_<Context>(m, "Context", "Progress and cancel of one long call; threads = 0 uses all cores.")
      .def(py::init<int>(), py::arg("threads") = 0)
      .def("cancel", &Context::cancel)
      .def_property_readonly("cancelled", &Context::cancelled)
      .def_property_readonly("done", &Context::done)
      .def_property_readonly("total", &Context::total);
}

}  // namespace mpm::bindings
