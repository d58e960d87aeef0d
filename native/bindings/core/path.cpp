#include <optional>

#include "columns.h"
#include "mpm/path/link_passes.h"

namespace mpm::bindings {
namespace {

py::dict to_dict(const ToolPath& path) {
  return table({{"kind", to_array(path.kind)},
                {"tip", to_array(path.tip)},
                {"axis", to_array(path.axis)},
                {"position", to_array(path.position)},
                {"pass_index", to_array(path.pass)},
                {"clearance", to_array(path.clearance)},
                {"proven", to_flags(path.proven)},
                {"blocked", to_flags(path.blocked)}});
}

py::dict link(const CellTree& cells,
              const Tool& tool,
              const DoubleArray& tip,
              const DoubleArray& axis,
              const IntArray& pass_index,
              const FlagArray& usable,
              const LinkOptions& options,
              const std::optional<DoubleArray>& cut_clearance,
              Context& context) {
  const PathPositions positions{
      to_vectors<Vec3>(tip, "tip"),
      to_vectors<Vec3>(axis, "axis"),
      to_scalars<std::int32_t>(pass_index, "pass_index"),
      to_scalars<std::uint8_t>(usable, "usable"),
      cut_clearance ? to_scalars(*cut_clearance, "cut_clearance") : std::vector<double>{}};
  return to_dict(without_gil([&] { return link_passes(cells, tool, positions, options, context); }));
}

LinkOptions make_options(double safe_clearance_mm,
                         double approach_distance_mm,
                         double gouge_mm,
                         double cut_gouge_mm,
                         double check_step_mm,
                         double cut_length_max_mm,
                         double cut_turn_max_deg,
                         double rapid_turn_max_deg,
                         double depth_mm,
                         double tip_deviation_mm,
                         double axis_deviation_deg) {
  return {safe_clearance_mm,
          approach_distance_mm,
          gouge_mm,
          cut_gouge_mm,
          check_step_mm,
          cut_length_max_mm,
          radians(cut_turn_max_deg),
          radians(rapid_turn_max_deg),
          depth_mm,
          tip_deviation_mm,
          radians(axis_deviation_deg)};
}

}  // namespace

void bind_path(py::module_& m) {
  m.attr("MOVE_KINDS") = to_tuple(kMoveKindNames);
  py::class_<LinkOptions>(m, "LinkOptions", "Heights, distances and limits of the links between cuts.")
      .def(py::init(&make_options),
           py::kw_only(),
           py::arg("safe_clearance_mm") = LinkOptions{}.safe_clearance,
           py::arg("approach_distance_mm") = LinkOptions{}.approach_distance,
           py::arg("gouge_mm") = LinkOptions{}.gouge,
           py::arg("cut_gouge_mm") = LinkOptions{}.cut_gouge,
           py::arg("check_step_mm") = LinkOptions{}.check_step,
           py::arg("cut_length_max_mm") = LinkOptions{}.cut_length_max,
           py::arg("cut_turn_max_deg") = degrees(LinkOptions{}.cut_turn_max),
           py::arg("rapid_turn_max_deg") = degrees(LinkOptions{}.rapid_turn_max),
           py::arg("depth_mm") = LinkOptions{}.depth,
           py::arg("tip_deviation_mm") = LinkOptions{}.tip_deviation,
           py::arg("axis_deviation_deg") = degrees(LinkOptions{}.axis_deviation),
           "safe_clearance: tool above everything on the safe plane; approach_distance: where rapids end; "
           "gouge, "
           "cut_gouge: how much deeper than its positions a link or a cut may go; check_step: between "
           "checked poses; "
           "cut_length_max, cut_turn_max: what one cut may join; rapid_turn_max: axis motion of one rapid; "
           "depth: what a proven plunge or retract may cut in, the real tip and axis being off by their "
           "deviations.");
  m.def("link_passes",
        &link,
        py::arg("cells"),
        py::arg("tool"),
        py::arg("tip"),
        py::arg("axis"),
        py::arg("pass_index"),
        py::arg("usable"),
        py::kw_only(),
        py::arg("options") = LinkOptions{},
        py::arg("cut_clearance") = py::none(),
        py::arg("context"),
        "Joins the usable positions (tip, axis (N, 3), pass_index, usable (N,); set-up frame) to a path: "
        "cuts along "
        "the passes, checked links over every gap. cut_clearance (N,): proven clearance (mm) of the cut that "
        "ends in "
        "each position, NaN where it must not be cut; None: sampling decides.");
}

}  // namespace mpm::bindings
