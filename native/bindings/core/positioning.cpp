#include <algorithm>
#include <memory>
#include <optional>

#include "common.h"
#include "mpm/base/context.h"
#include "mpm/footprint/plan_locator.h"
#include "mpm/positioning/contact_spacing.h"
#include "mpm/positioning/place_all.h"
#include "mpm/positioning/registry.h"

namespace mpm::bindings {
namespace {

py::dict to_dict(const Placements& placements, const Tool& tool) {
  const auto& all = placements.positions;
  const py::ssize_t n = py::ssize_t(all.size());
  py::array_t<double> tip({n, py::ssize_t(3)}), axis({n, py::ssize_t(3)});
  py::array_t<double> contacts({n, py::ssize_t(2), py::ssize_t(3)}),
      normals({n, py::ssize_t(2), py::ssize_t(3)});
  py::array_t<double> clearance({n, py::ssize_t(2)}), tilt_deg(n), spin_deg(n);
  py::array_t<std::uint8_t> status(n);
  const auto put = [](double* out, const Vec3& v) { std::copy_n(v.data(), 3, out); };
  for (py::ssize_t i = 0; i < n; ++i) {
    const Placement& p = all[std::size_t(i)];
    put(tip.mutable_data(i, 0), p.pose.tip(tool));
    put(axis.mutable_data(i, 0), p.pose.axis);
    put(contacts.mutable_data(i, 0, 0), p.first_contact);
    put(contacts.mutable_data(i, 1, 0), p.second_contact);
    put(normals.mutable_data(i, 0, 0), p.first_normal);
    put(normals.mutable_data(i, 1, 0), p.second_normal);
    clearance.mutable_at(i, 0) = p.clearance_lo;
    clearance.mutable_at(i, 1) = p.clearance_hi;
    tilt_deg.mutable_at(i) = degrees(p.tilt);
    spin_deg.mutable_at(i) = degrees(p.spin);
    status.mutable_at(i) = std::uint8_t(p.status);
  }
  py::dict counters;
  counters["evaluations"] = placements.counters.evaluations;
  counters["newton_steps"] = placements.counters.newton_steps;
  counters["cells"] = placements.counters.cells;
  counters["seeds"] = placements.counters.seeds;
  py::dict result;
  result["tip"] = tip, result["axis"] = axis, result["contacts"] = contacts, result["normals"] = normals;
  result["status"] = status, result["tilt_deg"] = tilt_deg, result["spin_deg"] = spin_deg;
  result["clearance"] = clearance, result["counters"] = counters;
  return result;
}

// A method made ready for one model and tool: what it has to prepare is done once.
class Positioner {
 public:
  Positioner(const std::string& method,
             const SurfaceModel& model,
             const Tool& tool,
             double tilt_max_deg,
             double spin_deg,
             const std::map<std::string, double>& options,
             const std::shared_ptr<CellTree>& cells)
      : model_(model), tool_(tool), tilt_max_(radians(tilt_max_deg)) {
    py::gil_scoped_release release;
    method_ = make_method(method, model, tool_, {radians(tilt_max_deg), radians(spin_deg), options, cells});
  }

  py::dict place_contacts(const std::vector<std::uint32_t>& faces,
                          const DoubleArray& uv,
                          const DoubleArray& ring_directions,
                          Context& context) const {
    const std::vector<Vec2> at = to_vectors<Vec2>(uv, "uv");
    const std::vector<Vec3> along = to_vectors<Vec3>(ring_directions, "ring_directions");
    require(faces.size() == at.size() && at.size() == along.size(),
            "faces (N,), uv (N, 2) and ring_directions (N, 3) must have the same N");
    std::vector<GivenContact> contacts;
    for (std::size_t i = 0; i < at.size(); ++i)
      contacts.push_back({faces[i], at[i].x(), at[i].y(), along[i]});
    Placements placements;
    {
      py::gil_scoped_release release;
      placements = place_all(*method_, model_, contacts, context);
    }
    return to_dict(placements, tool_);
  }

  py::dict place(const DoubleArray& points,
                 const std::optional<DoubleArray>& spins_deg,
                 Context& context) const {
    const std::vector<Vec2> at = to_vectors<Vec2>(points, "points");
    std::vector<double> spins;
    if (spins_deg) spins = to_radians(*spins_deg);
    Placements placements;
    {
      py::gil_scoped_release release;
      placements = spins_deg ? place_spun(*method_, at, spins, context) : place_all(*method_, at, context);
    }
    return to_dict(placements, tool_);
  }

  py::dict place_spins(const DoubleArray& points, const DoubleArray& spins_deg, Context& context) const {
    const std::vector<Vec2> at = to_vectors<Vec2>(points, "points");
    const std::vector<double> spins = to_radians(spins_deg);
    Placements placements;
    {
      py::gil_scoped_release release;
      placements = mpm::place_spins(*method_, at, spins, context);
    }
    return to_dict(placements, tool_);
  }

  py::dict place_spaced(const DoubleArray& points,
                        const std::vector<std::int64_t>& pass_index,
                        double contact_spacing_mm,
                        const std::string& measure,
                        const DoubleArray& feed,
                        int samples,
                        Context& context) const {
    const std::vector<Vec2> at = to_vectors<Vec2>(points, "points");
    require(measure == "across" || measure == "direct", "measure must be across or direct");
    const std::vector<Vec3> along = to_vectors<Vec3>(feed, "feed");
    require(along.size() == 1 && along[0].allFinite() && !along[0].isZero(0),
            "feed must be one finite vector, not zero");
    const SpacingRules rules{contact_spacing_mm,
                             measure == "across" ? SpacingMeasure::across : SpacingMeasure::direct,
                             along[0].normalized(),
                             tilt_max_,
                             samples};
    SpacedPlacements spaced;
    {
      py::gil_scoped_release release;
      spaced = mpm::place_spaced(*method_, at, pass_index, rules, context);
    }
    py::dict result = to_dict(spaced.placed, tool_);
    result["contact_spacing_mm"] = from_scalars(spaced.spacing);
    result["nearest_spacing_mm"] = from_scalars(spaced.nearest);
    return result;
  }

 private:
  static std::vector<double> to_radians(const DoubleArray& angles_deg) {
    std::vector<double> angles = to_doubles(angles_deg, "spins_deg");
    for (double& angle : angles) angle = radians(angle);
    return angles;
  }

  const SurfaceModel& model_;
  Tool tool_;
  double tilt_max_;
  std::unique_ptr<Method> method_;
};

py::array_t<bool> restrict_to_faces(const SurfaceModel& model,
                                    const Tool& tool,
                                    const DoubleArray& points,
                                    double margin_mm) {
  const std::vector<bool> over =
      over_faces(PlanLocator(model, tool.radius() / 2), to_vectors<Vec2>(points, "points"), margin_mm);
  py::array_t<bool> result(py::ssize_t(over.size()));
  for (std::size_t i = 0; i < over.size(); ++i) result.mutable_at(py::ssize_t(i)) = over[i];
  return result;
}

py::dict method_table() {
  py::dict result;
  for (const MethodInfo& m : methods()) {
    py::dict one;
    one["guarantee"] = m.guarantee;
    one["spins"] = m.spins;
    one["options"] = m.numbers;
    result[m.name] = one;
  }
  return result;
}

}  // namespace

void bind_positioning(py::module_& m) {
  m.attr("METHODS") = method_table();
  py::list names;
  for (const char* name : kPositionStatusNames) names.append(name);
  m.attr("POSITION_STATUS") = py::tuple(names);
  py::class_<Positioner>(
      m, "Positioner", "A method of METHODS, with its options, made ready for one model and tool.")
      .def(py::init<const std::string&,
                    const SurfaceModel&,
                    const Tool&,
                    double,
                    double,
                    const std::map<std::string, double>&,
                    const std::shared_ptr<CellTree>&>(),
           py::arg("method"),
           py::arg("model"),
           py::arg("tool"),
           py::kw_only(),
           py::arg("tilt_max_deg") = 45.0,
           py::arg("spin_deg") = 0.0,
           py::arg("options") = std::map<std::string, double>{},
           py::arg("cells") = py::none(),
           py::keep_alive<1, 3>(),
           "cells: of the model and the tool, to be shared; None: a method that needs them makes its own.")
      .def("place",
           &Positioner::place,
           py::arg("points"),
           py::kw_only(),
           py::arg("spins_deg") = py::none(),
           py::arg("context"),
           "Positions over plan points (N, 2) of the set-up frame. Dict of tip, axis (N, 3), contacts, "
           "normals (N, 2, 3; NaN: none), status (N,) codes of POSITION_STATUS, tilt_deg, spin_deg (N,), "
           "clearance (N, 2) mm bounds (infinite: nobody proved or measured one) and counters. spins_deg: "
           "(N,), a spin for each point in place of the positioner's own.")
      .def("place_spins",
           &Positioner::place_spins,
           py::arg("points"),
           py::arg("spins_deg"),
           py::kw_only(),
           py::arg("context"),
           "Every point (N, 2) with every spin (K,): as `place`, with N K rows, point by point. The drop is "
           "done once a point.")
      .def("place_spaced",
           &Positioner::place_spaced,
           py::arg("points"),
           py::arg("pass_index"),
           py::arg("contact_spacing_mm"),
           py::kw_only(),
           py::arg("measure") = "across",
           py::arg("feed"),
           py::arg("samples") = SpacingRules{}.samples,
           py::arg("context"),
           "Positions over points (N, 2) whose contacts are contact_spacing_mm apart: across, seen along the "
           "direction feed (3,), or direct. Points of one pass_index (N,) follow each other; the pass takes "
           "the spins that turn its axis least. As `place`, with contact_spacing_mm (N,), what each position "
           "has (NaN: none), and nearest_spacing_mm (N,), what of all spins comes nearest.")
      .def("place_contacts",
           &Positioner::place_contacts,
           py::arg("faces"),
           py::arg("uv"),
           py::arg("ring_directions"),
           py::kw_only(),
           py::arg("context"),
           "Positions at given first contacts: face index (N,), parameters (N, 2) and, in the set-up frame, "
           "the "
           "direction (N, 3) of the ring's tangent there. Result as of `place`; tilt_deg is the contact "
           "angle, 0 "
           "on the ring's equator and 90 on its bottom.");
  m.def("restrict_to_faces",
        &restrict_to_faces,
        py::arg("model"),
        py::arg("tool"),
        py::arg("points"),
        py::arg("margin_mm") = 0.0,
        "Which plan points (N, 2) lie over a face to machine, or within margin_mm of one in plan.");
}

}  // namespace mpm::bindings
