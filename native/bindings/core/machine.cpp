#include "columns.h"
#include "mpm/machine/joint_motion.h"
#include "mpm/machine/orientation.h"
#include "mpm/machine/refine.h"

namespace mpm::bindings {
namespace {

constexpr double kSecondsPerMinute = 60.0;

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
          from_name<AxisRole>(kAxisRoleNames, "role", role),
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
  const auto preference =
      from_name<SolutionPreference>(kSolutionPreferenceNames, "solution_preference", solution_preference);
  return checked({rotary, linear, spindle_axis, preference, allow_flip});
}

std::vector<Vec2> to_radians(const DoubleArray& degrees_of, const char* name) {
  std::vector<Vec2> result = to_vectors<Vec2>(degrees_of, name);
  for (Vec2& v : result) v = {radians(v[0]), radians(v[1])};
  return result;
}

Vec2 in_degrees(const Vec2& rotary) { return {degrees(rotary[0]), degrees(rotary[1])}; }

std::vector<Vec3> to_axes(const DoubleArray& array) {
  std::vector<Vec3> axes = to_vectors<Vec3>(array, "axis");
  for (std::size_t i = 0; i < axes.size(); ++i)
    axes[i] = to_direction(axes[i], "axis[" + std::to_string(i) + "]");
  return axes;
}

std::vector<Joints> to_joints(const DoubleArray& linear_mm,
                              const DoubleArray& rotary_deg,
                              const char* names) {
  const std::vector<Vec3> linear = to_vectors<Vec3>(linear_mm, "linear_mm");
  const std::vector<Vec2> rotary = to_radians(rotary_deg, "rotary_deg");
  require_same_length(linear.size(), rotary.size(), names);
  std::vector<Joints> joints;
  for (std::size_t i = 0; i < linear.size(); ++i) joints.push_back({linear[i], rotary[i]});
  return joints;
}

py::tuple forward_all(const KinematicChain& chain,
                      const DoubleArray& linear_mm,
                      const DoubleArray& rotary_deg,
                      const PartSetup& setup) {
  std::vector<TipPose> found;
  for (const Joints& one : to_joints(linear_mm, rotary_deg, "linear_mm and rotary_deg"))
    found.push_back(forward(chain, setup, one));
  return py::make_tuple(column(found, &TipPose::tip), column(found, &TipPose::axis));
}

py::tuple deviations(const KinematicChain& chain,
                     const DoubleArray& linear_mm,
                     const DoubleArray& rotary_deg,
                     const DoubleArray& linear_to_mm,
                     const DoubleArray& rotary_to_deg,
                     const PartSetup& setup) {
  const std::vector<Joints> from = to_joints(linear_mm, rotary_deg, "linear_mm and rotary_deg");
  const std::vector<Joints> to = to_joints(linear_to_mm, rotary_to_deg, "linear_to_mm and rotary_to_deg");
  require_same_length(from.size(), to.size(), "linear_mm and linear_to_mm");
  std::vector<MotionDeviation> found;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const AxisWay own{tool_axis(chain, from[i].rotary), tool_axis(chain, to[i].rotary)};
    found.push_back(deviation_bound(chain, setup, from[i], to[i], own));
  }
  return py::make_tuple(column(found, &MotionDeviation::tip),
                        column(found, [](const MotionDeviation& d) { return degrees(d.axis); }));
}

// Both solutions of one pose.
struct Solutions {
  std::array<Vec2, 2> rotary_deg;
  std::array<Vec3, 2> linear_mm;
  bool reachable;
  double pole_distance_deg;
};

Solutions solve(const KinematicChain& chain,
                const PartSetup& setup,
                const OrientationInverse& orientation,
                const Vec3& tip,
                const Vec3& axis) {
  const OrientationSolutions found = orientation.solve(axis);
  const auto& [first, second] = found.rotary;
  return {{in_degrees(first), in_degrees(second)},
          {linear_readings(chain, setup, tip, first), linear_readings(chain, setup, tip, second)},
          found.reachable,
          degrees(found.pole_distance)};
}

py::dict inverse_all(const KinematicChain& chain,
                     const DoubleArray& tip_mm,
                     const DoubleArray& axis_array,
                     const PartSetup& setup) {
  const std::vector<Vec3> tip = to_vectors<Vec3>(tip_mm, "tip"), axis = to_axes(axis_array);
  require_same_length(tip.size(), axis.size(), "tip and axis");
  const OrientationInverse orientation(chain);
  std::vector<Solutions> found;
  for (std::size_t i = 0; i < tip.size(); ++i)
    found.push_back(solve(chain, setup, orientation, tip[i], axis[i]));
  return table({{"rotary_deg", column(found, &Solutions::rotary_deg)},
                {"linear_mm", column(found, &Solutions::linear_mm)},
                {"reachable", column(found, &Solutions::reachable)},
                {"pole_distance_deg", column(found, &Solutions::pole_distance_deg)}});
}

PosePath make_path(const DoubleArray& tip, const DoubleArray& axis, const FlagArray& cutting) {
  return {to_vectors<Vec3>(tip, "tip"), to_axes(axis), to_scalars<std::uint8_t>(cutting, "cutting")};
}

py::dict to_dict(const JointPath& joints) {
  return table({{"rotary_deg", column(joints.rotary, in_degrees)},
                {"linear_mm", to_array(joints.linear)},
                {"branch", to_array(joints.branch)},
                {"at_pole", to_flags(joints.at_pole)},
                {"status", to_array(joints.status)}});
}

py::dict joint_path_of(const KinematicChain& chain,
                       const DoubleArray& tip,
                       const DoubleArray& axis,
                       const FlagArray& cutting,
                       const PartSetup& setup,
                       double pole_cone_deg) {
  const PosePath path = make_path(tip, axis, cutting);
  return to_dict(without_gil([&] { return joint_path(chain, path, {setup, radians(pole_cone_deg)}); }));
}

py::dict refine_of(const KinematicChain& chain,
                   const DoubleArray& tip,
                   const DoubleArray& axis,
                   const FlagArray& cutting,
                   const PartSetup& setup,
                   double pole_cone_deg,
                   double axis_tolerance_deg,
                   double tip_tolerance_mm,
                   double max_rotary_step_deg) {
  const PosePath path = make_path(tip, axis, cutting);
  const RefineOptions options{{setup, radians(pole_cone_deg)},
                              radians(axis_tolerance_deg),
                              tip_tolerance_mm,
                              radians(max_rotary_step_deg)};
  const RefinedPath refined = without_gil([&] { return refine(chain, path, options); });
  py::dict result = to_dict(refined.joints);
  result["tip"] = to_array(refined.poses.tip);
  result["axis"] = to_array(refined.poses.axis);
  result["source"] = to_array(refined.source);
  result["keeps"] = to_flags(refined.keeps);
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

void bind_setup(py::module_& m) {
  py::class_<PartSetup>(m, "PartSetup", "Where the part stands on the machine, and how long the tool is.")
      .def(py::init([](const Vec3& part_origin_mm, double tool_length_mm) {
             return PartSetup{part_origin_mm, tool_length_mm};
           }),
           py::kw_only(),
           py::arg("part_origin_mm") = PartSetup{}.part_origin,
           py::arg("tool_length_mm") = PartSetup{}.tool_length,
           "part_origin_mm: of the part's frame in the machine frame, rotary axes at their zero offsets; "
           "tool_length_mm: from the spindle gauge point to the tip.");
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
           py::arg("setup") = PartSetup{},
           "Readings (N, 3) and (N, 2) -> tip (N, 3) in mm and unit tool axis (N, 3), part frame.")
      .def("deviation_bound",
           &deviations,
           py::arg("linear_mm"),
           py::arg("rotary_deg"),
           py::arg("linear_to_mm"),
           py::arg("rotary_to_deg"),
           py::kw_only(),
           py::arg("setup") = PartSetup{},
           "All five axes run evenly from readings (N, 3), (N, 2) to others: bounds of how far that takes "
           "the tip off "
           "its straight line, mm (N,), and the axis off its great circle, degrees (N,).")
      .def("inverse",
           &inverse_all,
           py::arg("tip"),
           py::arg("axis"),
           py::kw_only(),
           py::arg("setup") = PartSetup{},
           "Both solutions of each pose.");
}

}  // namespace

void bind_machine(py::module_& m) {
  bind_axes(m);
  bind_setup(m);
  bind_chain(m);
  m.attr("JOINT_STATUS") = to_tuple(kJointStatusNames);
  m.def("joint_path",
        &joint_path_of,
        py::arg("chain"),
        py::arg("tip"),
        py::arg("axis"),
        py::arg("cutting"),
        py::kw_only(),
        py::arg("setup") = PartSetup{},
        py::arg("pole_cone_deg") = 0.0,
        "Joints of a whole path: tip (N, 3), axis (N, 3), cutting (N,) (native joint_path.h).");
  m.def("refine_path",
        &refine_of,
        py::arg("chain"),
        py::arg("tip"),
        py::arg("axis"),
        py::arg("cutting"),
        py::kw_only(),
        py::arg("setup") = PartSetup{},
        py::arg("pole_cone_deg") = 0.0,
        py::arg("axis_tolerance_deg"),
        py::arg("tip_tolerance_mm") = kInfinity,
        py::arg("max_rotary_step_deg") = kInfinity,
        "As joint_path, with cuts split until the tool stays within axis_tolerance_deg of the great circle "
        "between two "
        "poses and no axis turns more than max_rotary_step_deg. A finite tip_tolerance_mm: of the tip from "
        "its line "
        "while the joints run evenly; rapids are split too.");
}

}  // namespace mpm::bindings
