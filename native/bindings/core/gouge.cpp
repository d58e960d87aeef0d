#include "columns.h"
#include "mpm/gouge/certify_motion.h"
#include "mpm/gouge/certify_poses.h"
#include "mpm/gouge/judge_cells.h"
#include "mpm/gouge/sample_poses.h"

namespace mpm::bindings {
namespace {

std::vector<ToolPose> to_poses(const Tool& tool,
                               const DoubleArray& tips,
                               const DoubleArray& axes,
                               const char* tip_name,
                               const char* axis_name) {
  const std::vector<Vec3> tip = to_vectors<Vec3>(tips, tip_name), axis = to_vectors<Vec3>(axes, axis_name);
  require(tip.size() == axis.size(),
          std::string(tip_name) + " and " + axis_name + " must have the same shape (N, 3)");
  std::vector<ToolPose> poses;
  for (std::size_t i = 0; i < tip.size(); ++i) poses.push_back(ToolPose::from_tip(tool, tip[i], axis[i]));
  return poses;
}

template <class Found>
py::dict to_dict(const std::vector<Found>& found) {
  return table({{"lo", column(found, &Found::lo)},
                {"hi", column(found, &Found::hi)},
                {"verdict", column(found, &Found::verdict)},
                {"cells", column(found, &Found::cells)}});
}

py::dict poses(const SurfaceModel& model,
               const Tool& tool,
               const DoubleArray& tips,
               const DoubleArray& axes,
               double tolerance_mm,
               Context& context) {
  const std::vector<ToolPose> all = to_poses(tool, tips, axes, "tips", "axes");
  for (const ToolPose& pose : all)
    require(pose.torus_center.allFinite() && pose.axis.allFinite(), "tips, axes: must be finite");
  return to_dict(without_gil([&] { return certify_poses(model, tool, all, tolerance_mm, context); }));
}

py::array_t<double> sampled_clearance(const SurfaceModel& model,
                                      const Tool& tool,
                                      const DoubleArray& tips,
                                      const DoubleArray& axes,
                                      Context& context) {
  const std::vector<ToolPose> all = to_poses(tool, tips, axes, "tips", "axes");
  return to_array(without_gil([&] { return sample_poses(model, tool, all, context); }));
}

// One number for all motions, or one for each.
double of_motion(const DoubleArray& values, std::size_t index) {
  return values.ndim() == 0 ? *values.data() : values.data()[index];
}

void check_count(const DoubleArray& values, std::size_t count, const char* name) {
  require(values.ndim() == 0 || (values.ndim() == 1 && std::size_t(values.size()) == count),
          std::string(name) + " must be a number or have shape (N,), got " + shape_of(values));
}

py::dict motions(const CellTree& cells,
                 const Tool& tool,
                 const DoubleArray& tips,
                 const DoubleArray& axes,
                 const DoubleArray& tips_to,
                 const DoubleArray& axes_to,
                 const DoubleArray& tolerance_mm,
                 const DoubleArray& axis_deviation_deg,
                 Context& context) {
  const std::vector<ToolPose> from = to_poses(tool, tips, axes, "tips", "axes");
  const std::vector<ToolPose> to = to_poses(tool, tips_to, axes_to, "tips_to", "axes_to");
  require(from.size() == to.size(), "tips, axes, tips_to and axes_to must have the same length");
  check_count(tolerance_mm, from.size(), "tolerance_mm");
  check_count(axis_deviation_deg, from.size(), "axis_deviation_deg");
  std::vector<Motion> all;
  for (std::size_t i = 0; i < from.size(); ++i) {
    CertifyMotionOptions options;
    options.tolerance = of_motion(tolerance_mm, i);
    options.axis_deviation = radians(of_motion(axis_deviation_deg, i));
    all.push_back({from[i], to[i], options});
  }
  return to_dict(without_gil([&] { return certify_motions(cells, tool, all, context); }));
}

}  // namespace

void bind_gouge(py::module_& m) {
  py::class_<CellTree, std::shared_ptr<CellTree>>(
      m, "CellTree", "The faces in pieces of all sizes, with bounds: what proofs about one tool work on.")
      .def(py::init([](const SurfaceModel& model, const Tool& tool) {
             return without_gil([&] { return std::make_shared<CellTree>(judge_cells(model, tool)); });
           }),
           py::arg("model"),
           py::arg("tool"),
           py::keep_alive<1, 2>());
  m.attr("VERDICTS") = to_tuple(kVerdictNames);
  m.def("certify_poses",
        &poses,
        py::arg("model"),
        py::arg("tool"),
        py::arg("tips"),
        py::arg("axes"),
        py::kw_only(),
        py::arg("tolerance_mm"),
        py::arg("context"),
        "Certificates of the poses tips, axes (N, 3); free: nothing cuts in deeper than tolerance_mm.");
  m.def("sampled_clearance",
        &sampled_clearance,
        py::arg("model"),
        py::arg("tool"),
        py::arg("tips"),
        py::arg("axes"),
        py::arg("context"),
        "Least sampled signed distance (mm) of the surfaces from the tool at each tip, axis (N, 3); at most "
        "the tool's radius.");
  m.def("certify_motions",
        &motions,
        py::arg("cells"),
        py::arg("tool"),
        py::arg("tips"),
        py::arg("axes"),
        py::arg("tips_to"),
        py::arg("axes_to"),
        py::kw_only(),
        py::arg("tolerance_mm"),
        py::arg("axis_deviation_deg") = DoubleArray(py::float_(0.0)),
        py::arg("context"),
        "Certificates of the moves from each tip, axis (N, 3) to tips_to, axes_to (N, 3): tip on a line, "
        "axis within "
        "axis_deviation_deg of the great circle. tolerance_mm may be cut in; negative, it is the clearance "
        "asked for.");
}

}  // namespace mpm::bindings
