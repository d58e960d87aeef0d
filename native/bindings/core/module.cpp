#include "common.h"

// Python sees the same names as C++. Arrays are float64, row-major; lengths in mm, angles in radians unless
// the name says otherwise. std::invalid_argument arrives as ValueError.
PYBIND11_MODULE(_core, m) {
  using namespace mpm::bindings;
  m.doc() = "Multi-point machining: the C++ core.";
  bind_base(m);
  bind_surface(m);
  bind_tool(m);
  bind_footprint(m);
  bind_gouge(m);
  bind_positioning(m);
  bind_machine(m);
  bind_path(m);
  bind_removal(m);
}
