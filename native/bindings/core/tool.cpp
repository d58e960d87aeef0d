#include "mpm/tool/tool.h"

#include "columns.h"

namespace mpm::bindings {

namespace {

py::array_t<double> distances(const Tool& tool,
                              const Vec3& tip,
                              const Vec3& axis,
                              const DoubleArray& points) {
  const ToolPose pose = ToolPose::from_tip(tool, tip, axis);
  return column(to_vectors<Vec3>(points, "points"),
                [&](const Vec3& p) { return signed_distance(tool, pose, p); });
}

}  // namespace

void bind_tool(py::module_& m) {
  py::class_<Tool>(m, "Tool", "A toroidal cutter with flutes, shank and holder (all mm).")
      .def(py::init([](double major_radius_mm,
                       double minor_radius_mm,
                       double recess_mm,
                       double flute_length_mm,
                       const std::vector<std::array<double, 3>>& segments) {
             Tool tool{major_radius_mm, minor_radius_mm, recess_mm, flute_length_mm, {}};
             for (const auto& s : segments) tool.segments.push_back({s[0], s[1], s[2]});
             check_tool(tool);
             return tool;
           }),
           py::arg("major_radius_mm"),
           py::arg("minor_radius_mm"),
           py::arg("recess_mm"),
           py::arg("flute_length_mm"),
           py::arg("segments") = std::vector<std::array<double, 3>>{},
           "segments: (bottom radius, top radius, length) of shank and holder, from the top of the flutes "
           "upwards.")
      .def_readonly("major_radius", &Tool::major_radius)
      .def_readonly("minor_radius", &Tool::minor_radius)
      .def_readonly("recess", &Tool::recess)
      .def_readonly("flute_length", &Tool::flute_length)
      .def_property_readonly("radius", &Tool::radius)
      .def_property_readonly("length", &Tool::length)
      .def_property_readonly("reach", &Tool::reach)
      .def("signed_distance",
           &distances,
           py::arg("tip"),
           py::arg("axis"),
           py::arg("points"),
           "Signed distance (mm) of points (N, 3) from the tool standing at tip with axis.");
}

}  // namespace mpm::bindings
