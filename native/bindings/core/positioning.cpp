#include <memory>
#include <optional>

#include "columns.h"
#include "mpm/base/context.h"
#include "mpm/footprint/footprint_locator.h"
#include "mpm/positioning/contact_spacing.h"
#include "mpm/positioning/place_all.h"
#include "mpm/positioning/registry.h"

namespace mpm::bindings {
namespace {

py::dict to_dict(const Counters& counters) {
  return table({{"evaluations", py::cast(counters.evaluations)},
                {"newton_steps", py::cast(counters.newton_steps)},
                {"cells", py::cast(counters.cells)},
                {"seeds", py::cast(counters.seeds)}});
}

py::dict to_dict(const Placements& placements, const Tool& tool) {
  using P = Placement;
  const std::vector<P>& all = placements.positions;
  return table({{"tip", column(all, [&](const P& p) { return p.pose.tip(tool); })},
                {"axis", column(all, [](const P& p) { return p.pose.axis; })},
                {"contacts",
                 column(all,
                        [](const P& p) {
                          return std::array{p.first_contact, p.second_contact};
                        })},
                {"normals",
                 column(all,
                        [](const P& p) {
                          return std::array{p.first_normal, p.second_normal};
                        })},
                {"status", column(all, &P::status)},
                {"tilt_deg", column(all, [](const P& p) { return degrees(p.tilt); })},
                {"spin_deg", column(all, [](const P& p) { return degrees(p.spin); })},
                {"clearance", column(all, [](const P& p) { return Vec2(p.clearance_lo, p.clearance_hi); })},
                {"counters", to_dict(placements.counters)}});
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
    method_ = without_gil([&] {
      return make_method(method, model, tool_, {radians(tilt_max_deg), radians(spin_deg), options, cells});
    });
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
    return to_dict(without_gil([&] { return place_all(*method_, model_, contacts, context); }), tool_);
  }

  py::dict place(const DoubleArray& points,
                 const std::optional<DoubleArray>& spins_deg,
                 Context& context) const {
    const std::vector<Vec2> at = to_vectors<Vec2>(points, "points");
    if (!spins_deg) return to_dict(without_gil([&] { return place_all(*method_, at, context); }), tool_);
    const std::vector<double> spins = to_radians(*spins_deg);
    return to_dict(without_gil([&] { return place_spun(*method_, at, spins, context); }), tool_);
  }

  py::dict place_spins(const DoubleArray& points, const DoubleArray& spins_deg, Context& context) const {
    const std::vector<Vec2> at = to_vectors<Vec2>(points, "points");
    const std::vector<double> spins = to_radians(spins_deg);
    return to_dict(without_gil([&] { return mpm::place_spins(*method_, at, spins, context); }), tool_);
  }

  py::dict place_spaced(const DoubleArray& points,
                        const std::vector<std::int64_t>& pass_index,
                        double contact_spacing_mm,
                        const std::string& measure,
                        const Vec3& feed,
                        int samples,
                        Context& context) const {
    const std::vector<Vec2> at = to_vectors<Vec2>(points, "points");
    const SpacingRules rules{contact_spacing_mm,
                             from_name<SpacingMeasure>(kSpacingMeasureNames, "measure", measure),
                             to_direction(feed, "feed"),
                             tilt_max_,
                             samples};
    const SpacedPlacements spaced =
        without_gil([&] { return mpm::place_spaced(*method_, at, pass_index, rules, context); });
    py::dict result = to_dict(spaced.placed, tool_);
    result["contact_spacing_mm"] = to_array(spaced.spacing);
    result["nearest_spacing_mm"] = to_array(spaced.nearest);
    return result;
  }

 private:
  static std::vector<double> to_radians(const DoubleArray& angles_deg) {
    std::vector<double> angles = to_scalars(angles_deg, "spins_deg");
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
  return to_array(
      over_faces(FootprintLocator(model, tool.radius() / 2), to_vectors<Vec2>(points, "points"), margin_mm));
}

py::dict method_table() {
  py::dict result;
  for (const MethodInfo& m : methods())
    result[m.name] = table({{"guarantee", py::cast(m.guarantee)},
                            {"spins", py::cast(m.spins)},
                            {"options", py::cast(m.numbers)}});
  return result;
}

// Ways to make one, and to place over plan points.
void bind_positioner(py::class_<Positioner>& c) {
  c.def(py::init<const std::string&,
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
        "cells: of the model and the tool, to be shared; None: a method that needs them makes its own.");
  c.def("place",
        &Positioner::place,
        py::arg("points"),
        py::kw_only(),
        py::arg("spins_deg") = py::none(),
        py::arg("context"),
        "Positions over plan points (N, 2) of the set-up frame. spins_deg: (N,), a spin for each point, not "
        "the "
        "positioner's own.");
}

void bind_spins(py::class_<Positioner>& c) {
  c.def(
      "place_spins",
      &Positioner::place_spins,
      py::arg("points"),
      py::arg("spins_deg"),
      py::kw_only(),
      py::arg("context"),
      "Every point (N, 2) with every spin (K,): as `place`, with N K rows, point by point. The drop is done "
      "once a point.");
  c.def("place_spaced",
        &Positioner::place_spaced,
        py::arg("points"),
        py::arg("pass_index"),
        py::arg("contact_spacing_mm"),
        py::kw_only(),
        py::arg("measure") = kSpacingMeasureNames[0],
        py::arg("feed"),
        py::arg("samples") = SpacingRules{}.samples,
        py::arg("context"),
        "Positions over points (N, 2) whose contacts are contact_spacing_mm apart: across, seen along the "
        "direction feed (3,), or direct. Points of one pass_index (N,) follow each other; the pass takes the "
        "spins that turn its axis least.");
}

void bind_contacts(py::class_<Positioner>& c) {
  c.def("place_contacts",
        &Positioner::place_contacts,
        py::arg("faces"),
        py::arg("uv"),
        py::arg("ring_directions"),
        py::kw_only(),
        py::arg("context"),
        "Positions at given first contacts: face index (N,), parameters (N, 2) and, in the set-up frame, the "
        "direction (N, 3) of the ring's tangent there. As `place`; tilt_deg is the contact angle, 0 on the "
        "ring's equator and 90 on its bottom.");
}

}  // namespace

void bind_positioning(py::module_& m) {
  m.attr("METHODS") = method_table();
  m.attr("POSITION_STATUS") = to_tuple(kPositionStatusNames);
  py::class_<Positioner> positioner(
      m, "Positioner", "A method of METHODS, with its options, made ready for one model and tool.");
  bind_positioner(positioner);
  bind_spins(positioner);
  bind_contacts(positioner);
  m.def("restrict_to_faces",
        &restrict_to_faces,
        py::arg("model"),
        py::arg("tool"),
        py::arg("points"),
        py::arg("margin_mm") = 0.0,
        "Which plan points (N, 2) lie over a face to machine, or within margin_mm of one in plan.");
}

}  // namespace mpm::bindings
