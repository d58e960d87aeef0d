#include <map>

#include "common.h"
#include "mpm/machine/joint_motion.h"
#include "mpm/machine/orientation.h"
#include "mpm/machine/refine.h"

namespace mpm::bindings {
namespace {

constexpr double kSecondsPerMinute = 60.0;

AxisRole role_of(const std::string& name) {
  if (name == "table_rotary") return AxisRole::table_rotary;
  require(name == "head_rotary", "role must be 'table_rotary' or 'head_rotary', got '" + name + "'");
  return AxisRole::head_rotary;
}

SolutionPreference preference_of(const std::string& name) {
  const std::map<std::string, SolutionPreference> known{{"shortest", SolutionPreference::shortest},
                                                        {"positive", SolutionPreference::positive},
                                                        {"negative", SolutionPreference::negative}};
  const auto found = known.find(name);
  require(found != known.end(),
          "solution_preference must be 'shortest', 'positive' or 'negative', got '" + name + "'");
  return found->second;
}

RotaryAxis make_rotary(const std::string& name,
                       const std::string& role,
                       const Vec3& rotation_vector,
                       const Vec3& joint_origin_mm,
                       int sense,
                       double zero_offset_deg,
                       double min_limit_deg,
                       double max_limit_deg,
                       double max_velocity_deg_per_min,
                       double max_acceleration_deg_per_s2) {
  require(name.size() == 1, "name must be one letter, got '" + name + "'");
  return {name[0],
          role_of(role),
          rotation_vector,
          joint_origin_mm,
          sense,
          radians(zero_offset_deg),
          radians(min_limit_deg),
          radians(max_limit_deg),
          radians(max_velocity_deg_per_min) / kSecondsPerMinute,
          radians(max_acceleration_deg_per_s2)};
}

LinearAxis make_linear(double min_limit_mm,
                       double max_limit_mm,
                       double max_velocity_mm_per_min,
                       double max_acceleration_mm_per_s2) {
  return {
      min_limit_mm, max_limit_mm, max_velocity_mm_per_min / kSecondsPerMinute, max_acceleration_mm_per_s2};
}

KinematicChain make_chain(const std::array<RotaryAxis, 2>& rotary,
                          const std::array<LinearAxis, 3>& linear,
                          const Vec3& spindle_axis,
                          const std::string& solution_preference,
                          bool allow_flip) {
  return checked({rotary, linear, spindle_axis, preference_of(solution_preference), allow_flip});
}

std::vector<Vec2> to_radians(const DoubleArray& degrees_of, const char* name) {
  std::vector<Vec2> result = to_vectors<Vec2>(degrees_of, name);
  for (Vec2& v : result) v = {radians(v[0]), radians(v[1])};
  return result;
}

py::array_t<double> from_radians(std::vector<Vec2> rotary) {
  for (Vec2& v : rotary) v = {degrees(v[0]), degrees(v[1])};
  return from_vectors(rotary);
}

std::vector<Vec3> to_axes(const DoubleArray& array) {
  std::vector<Vec3> axes = to_vectors<Vec3>(array, "axis");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double length = axes[i].norm();
    require(std::isfinite(length) && length > 0,
            "axis[" + std::to_string(i) + "] must be finite and not zero");
    axes[i] /= length;
  }
  return axes;
}

void require_same_length(std::size_t a, std::size_t b, const char* names) {
  require(a == b,
          std::string(names) + " must have the same length, got " + std::to_string(a) + " and " +
              std::to_string(b));
}

py::tuple forward_all(const KinematicChain& chain,
                      const DoubleArray& linear_mm,
                      const DoubleArray& rotary_deg,
                      const Vec3& part_origin_mm,
                      double tool_length_mm) {
  const std::vector<Vec3> linear = to_vectors<Vec3>(linear_mm, "linear_mm");
  const std::vector<Vec2> rotary = to_radians(rotary_deg, "rotary_deg");
  require_same_length(linear.size(), rotary.size(), "linear_mm and rotary_deg");
  std::vector<Vec3> tip, axis;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const CutterLocation at = forward(chain, {part_origin_mm, tool_length_mm}, {linear[i], rotary[i]});
    tip.push_back(at.tip);
    axis.push_back(at.axis);
  }
  return py::make_tuple(from_vectors(tip), from_vectors(axis));
}

py::tuple deviations(const KinematicChain& chain,
                     const DoubleArray& linear_mm,
                     const DoubleArray& rotary_deg,
                     const DoubleArray& linear_to_mm,
                     const DoubleArray& rotary_to_deg,
                     const Vec3& part_origin_mm,
                     double tool_length_mm) {
  const std::vector<Vec3> linear = to_vectors<Vec3>(linear_mm, "linear_mm"),
                          linear_to = to_vectors<Vec3>(linear_to_mm, "linear_to_mm");
  const std::vector<Vec2> rotary = to_radians(rotary_deg, "rotary_deg"),
                          rotary_to = to_radians(rotary_to_deg, "rotary_to_deg");
  require_same_length(linear.size(), rotary.size(), "linear_mm and rotary_deg");
  require_same_length(linear.size(), linear_to.size(), "linear_mm and linear_to_mm");
  require_same_length(linear.size(), rotary_to.size(), "linear_mm and rotary_to_deg");
  std::vector<double> tip_mm, axis_deg;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const AxisWay own{tool_axis(chain, rotary[i]), tool_axis(chain, rotary_to[i])};
    const MotionDeviation off = deviation_bound(
        chain, {part_origin_mm, tool_length_mm}, {linear[i], rotary[i]}, {linear_to[i], rotary_to[i]}, own);
    tip_mm.push_back(off.tip);
    axis_deg.push_back(degrees(off.axis));
  }
  return py::make_tuple(from_scalars(tip_mm), from_scalars(axis_deg));
}

py::array_t<double> in_pairs(const std::vector<Vec2>& v) {
  return from_vectors(v).reshape({py::ssize_t(v.size() / 2), py::ssize_t(2), py::ssize_t(2)});
}

py::dict inverse_all(const KinematicChain& chain,
                     const DoubleArray& tip_mm,
                     const DoubleArray& axis_array,
                     const Vec3& part_origin_mm,
                     double tool_length_mm) {
  const std::vector<Vec3> tip = to_vectors<Vec3>(tip_mm, "tip"), axis = to_axes(axis_array);
  require_same_length(tip.size(), axis.size(), "tip and axis");
  const OrientationInverse orientation(chain);
  std::vector<Vec2> rotary;
  std::vector<Vec3> linear;
  std::vector<std::uint8_t> reachable;
  std::vector<double> pole_distance;
  for (std::size_t i = 0; i < tip.size(); ++i) {
    const OrientationSolutions solutions = orientation.solve(axis[i]);
    reachable.push_back(solutions.reachable);
    pole_distance.push_back(degrees(solutions.pole_distance));
    for (const Vec2& r : solutions.rotary) {
      rotary.push_back({degrees(r[0]), degrees(r[1])});
      linear.push_back(linear_readings(chain, {part_origin_mm, tool_length_mm}, tip[i], r));
    }
  }
  py::dict result;
  result["rotary_deg"] = in_pairs(rotary);
  result["linear_mm"] =
      from_vectors(linear).reshape({py::ssize_t(tip.size()), py::ssize_t(2), py::ssize_t(3)});
  result["reachable"] = from_scalars(reachable).attr("astype")("bool");
  result["pole_distance_deg"] = from_scalars(pole_distance);
  return result;
}

PosePath make_path(const DoubleArray& tip, const DoubleArray& axis, const py::array_t<bool>& cutting) {
  PosePath path{to_vectors<Vec3>(tip, "tip"), to_axes(axis), {}};
  require(cutting.ndim() == 1, "cutting must have shape (N,), got " + shape_of(cutting));
  for (py::ssize_t i = 0; i < cutting.size(); ++i) path.cutting.push_back(cutting.at(i));
  return path;
}

py::dict joints_to_dict(const JointPath& joints) {
  std::vector<std::uint8_t> status;
  for (JointStatus s : joints.status) status.push_back(std::uint8_t(s));
  py::dict result;
  result["rotary_deg"] = from_radians(joints.rotary);
  result["linear_mm"] = from_vectors(joints.linear);
  result["branch"] = from_scalars(joints.branch);
  result["at_pole"] = from_scalars(joints.at_pole).attr("astype")("bool");
  result["status"] = from_scalars(status);
  return result;
}

py::dict joint_path_of(const KinematicChain& chain,
                       const DoubleArray& tip,
                       const DoubleArray& axis,
                       const py::array_t<bool>& cutting,
                       const Vec3& part_origin_mm,
                       double tool_length_mm,
                       double pole_cone_deg) {
  const PosePath path = make_path(tip, axis, cutting);
  const JointPathOptions options{{part_origin_mm, tool_length_mm}, radians(pole_cone_deg)};
  JointPath joints;
  {
    py::gil_scoped_release unlocked;
    joints = joint_path(chain, path, options);
  }
  return joints_to_dict(joints);
}

py::dict refine_of(const KinematicChain& chain,
                   const DoubleArray& tip,
                   const DoubleArray& axis,
                   const py::array_t<bool>& cutting,
                   const Vec3& part_origin_mm,
                   double tool_length_mm,
                   double pole_cone_deg,
                   double axis_tolerance_deg,
                   double tip_tolerance_mm,
                   double max_rotary_step_deg) {
  const PosePath path = make_path(tip, axis, cutting);
  const RefineOptions options{{{part_origin_mm, tool_length_mm}, radians(pole_cone_deg)},
                              radians(axis_tolerance_deg),
                              tip_tolerance_mm,
                              radians(max_rotary_step_deg)};
  RefinedPath refined;
  {
    py::gil_scoped_release unlocked;
    refined = refine(chain, path, options);
  }
  py::dict result = joints_to_dict(refined.joints);
  result["tip"] = from_vectors(refined.poses.tip);
  result["axis"] = from_vectors(refined.poses.axis);
  result["source"] = from_scalars(refined.source);
  result["keeps"] = from_scalars(refined.keeps).attr("astype")("bool");
  return result;
}

void bind_axes(py::module_& m) {
  py::class_<RotaryAxis>(
      m, "RotaryAxis", "A rotary axis; a reading is positive as ISO 841 has it (docs/machine.md).")
      .def(py::init(&make_rotary),
           py::kw_only(),
           py::arg("name"),
           py::arg("role"),
           py::arg("rotation_vector"),
           py::arg("joint_origin_mm") = Vec3(Vec3::Zero()),
           py::arg("sense") = 1,
           py::arg("zero_offset_deg") = 0.0,
           py::arg("min_limit_deg") = -kInfinity,
           py::arg("max_limit_deg") = kInfinity,
           py::arg("max_velocity_deg_per_min") = kInfinity,
           py::arg("max_acceleration_deg_per_s2") = kInfinity,
           "role: 'table_rotary' or 'head_rotary'; infinite limits: an unwound axis.")
      .def_property_readonly("name", [](const RotaryAxis& a) { return std::string(1, a.name); });
  py::class_<LinearAxis>(m, "LinearAxis", "X, Y or Z.")
      .def(py::init(&make_linear),
           py::kw_only(),
           py::arg("min_limit_mm") = -kInfinity,
           py::arg("max_limit_mm") = kInfinity,
           py::arg("max_velocity_mm_per_min") = kInfinity,
           py::arg("max_acceleration_mm_per_s2") = kInfinity);
}

void bind_chain(py::module_& m) {
  py::class_<KinematicChain>(
      m, "KinematicChain", "Two rotary axes, listed from the part to the tool, and X, Y, Z.")
      .def(py::init(&make_chain),
           py::kw_only(),
           py::arg("rotary"),
           py::arg("linear") = std::array<LinearAxis, 3>{},
           py::arg("spindle_axis") = Vec3(Vec3::UnitZ()),
           py::arg("solution_preference") = "shortest",
           py::arg("allow_flip") = true)
      .def("forward",
           &forward_all,
           py::arg("linear_mm"),
           py::arg("rotary_deg"),
           py::kw_only(),
           py::arg("part_origin_mm") = Vec3(Vec3::Zero()),
           py::arg("tool_length_mm") = 0.0,
           "Readings (N, 3) and (N, 2) -> tip (N, 3) in mm and unit tool axis (N, 3), part frame.")
      .def(
          "deviation_bound",
          &deviations,
          py::arg("linear_mm"),
          py::arg("rotary_deg"),
          py::arg("linear_to_mm"),
          py::arg("rotary_to_deg"),
          py::kw_only(),
          py::arg("part_origin_mm") = Vec3(Vec3::Zero()),
          py::arg("tool_length_mm") = 0.0,
          "All five axes run evenly from readings (N, 3), (N, 2) to others: bounds of how far that takes the "
          "tip off its\nstraight line, mm (N,), and the axis off its great circle, degrees (N,).")
      .def("inverse",
           &inverse_all,
           py::arg("tip"),
           py::arg("axis"),
           py::kw_only(),
           py::arg("part_origin_mm") = Vec3(Vec3::Zero()),
           py::arg("tool_length_mm") = 0.0,
           "Both solutions of each pose: dict of rotary_deg (N, 2 solutions, 2 axes), linear_mm (N, 2, 3),\n"
           "reachable (N,) (else the nearest orientation is given) and pole_distance_deg (N,).");
}

}  // namespace

void bind_machine(py::module_& m) {
  bind_axes(m);
  bind_chain(m);
  m.attr("JOINT_STATUS") = py::make_tuple("ok", "unreachable", "rotary_limit", "linear_limit", "forced_turn");
  m.def(
      "joint_path",
      &joint_path_of,
      py::arg("chain"),
      py::arg("tip"),
      py::arg("axis"),
      py::arg("cutting"),
      py::kw_only(),
      py::arg("part_origin_mm") = Vec3(Vec3::Zero()),
      py::arg("tool_length_mm") = 0.0,
      py::arg("pole_cone_deg") = 0.0,
      "Joints of a whole path (native joint_path.h): tip (N, 3), axis (N, 3), cutting (N,) bool -> dict of "
      "rotary_deg\n"
      "(N, 2) unwound, linear_mm (N, 3), branch (N,), at_pole (N,), status (N,) as index into JOINT_STATUS.");
  m.def("refine_path",
        &refine_of,
        py::arg("chain"),
        py::arg("tip"),
        py::arg("axis"),
        py::arg("cutting"),
        py::kw_only(),
        py::arg("part_origin_mm") = Vec3(Vec3::Zero()),
        py::arg("tool_length_mm") = 0.0,
        py::arg("pole_cone_deg") = 0.0,
        py::arg("axis_tolerance_deg"),
        py::arg("tip_tolerance_mm") = kInfinity,
        py::arg("max_rotary_step_deg") = kInfinity,
        "As joint_path, with cuts split until the tool stays within axis_tolerance_deg of the great circle "
        "between two\n"
        "poses and no axis turns more than max_rotary_step_deg: also tip (M, 3), axis (M, 3), source (M,), "
        "keeps (M,)\n"
        "bool. A finite tip_tolerance_mm: of the tip from its line while the joints run evenly; rapids are "
        "split too.");
}

}  // namespace mpm::bindings
