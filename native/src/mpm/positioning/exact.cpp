#include "mpm/positioning/exact.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/base/frame.h"
#include "mpm/contact/curvature_limit.h"
#include "mpm/contact/merging_contact.h"
#include "mpm/gouge/judge_cells.h"
#include "mpm/positioning/first_touch.h"

namespace mpm {
namespace {

// mm: the default of what the user asks; no part of the tool, as tolerances of parts are not.
constexpr double kGougeTolerance = 1e-3;
constexpr double kCellBudget = 200'000;
// rad: a second contact this close to the curvature limit may have rivals
constexpr double kNearLimit = 0.01;
constexpr double kNoDirection = 1e-9;  // part along the surface that a direction must have
constexpr double kNoTilt = 1e-9;       // rad

// The first contact, and how the tool turns about it.
struct Pivot {
  Touch first;
  Insert insert;
  double
      open_side;    // rad: the tilt that puts the contact on the ring's equator or, upright, that of the drop
  double tilt_max;  // rad
};

// The tool dropped over a plan point.
struct Dropped {
  Placement placement;  // without a pose where `tilts`: that comes with its certificate
  Touch first;
  ToolPose upright{Vec3::Constant(kNaN), Vec3::Constant(kNaN)};
  bool tilts = false;  // else the placement is all there is
};

class Exact final : public Method {
 public:
  Exact(const SurfaceModel& model, const Tool& tool, const MethodOptions& options)
      : model_(model),
        tool_(tool),
        cells_(options.cells ? options.cells : std::make_shared<CellTree>(judge_cells(model, tool))),
        tilt_max_(options.tilt_max),
        spin_(options.spin),
        gouge_(options.numbers.at("gouge_mm")),
        first_touch_(*cells_, tool_, gouge_, std::uint32_t(options.numbers.at("cell_budget"))) {}

  Placement place(const Vec2& at, Counters& counters) const override;
  Placement place(const GivenContact& at, Counters& counters) const override;
  std::unique_ptr<DroppedTool> drop(const Vec2& at, Counters& counters) const override;

 private:
  class ReadyTool;

  Dropped dropped(const Vec2& at, std::vector<Start>& starts, Counters& counters) const;
  Placement spun(const Dropped& dropped,
                 double spin,
                 const std::vector<Start>& starts,
                 Counters& counters) const;
  void look_beside(
      const Tilt& approach, const Touch& first, double curvature, Touch& second, Counters& counters) const;
  void tilt(const Pivot& pivot,
            const std::vector<Start>& starts,
            Placement& placement,
            Counters& counters) const;
  PositionStatus status_of(const Pivot& pivot, const Stop& stop, double curvature) const;
  void note_second(const Touch& second, const JudgedPose& judged, Placement& placement) const;
  void finish(Placement& placement, const JudgedPose& judged) const;

  const SurfaceModel& model_;
  Tool tool_;
  std::shared_ptr<const CellTree> cells_;
  double tilt_max_, spin_;
  double gouge_;  // mm
  FirstTouch first_touch_;
};

// The one place where a placement gets its pose: with the certificate of that pose.
void Exact::finish(Placement& placement, const JudgedPose& judged) const {
  placement.pose = judged.pose();
  placement.clearance_lo = judged.certificate().lo;
  // The contacts are points of the surface, whether the judge met them or not.
  placement.clearance_hi = judged.certificate().hi;
  for (const Vec3& contact : {placement.first_contact, placement.second_contact})
    if (contact.allFinite())
      placement.clearance_hi =
          std::min(placement.clearance_hi, signed_distance(tool_, placement.pose, contact));
  // What the tool cannot reach without cutting in (holder in the way, budget spent) is no place to cut.
  if (!judged.is_free()) placement.status = PositionStatus::undecided;
}

// A second contact that is about to merge with the first comes only a little before the curvature limit, and
// no start's own arrival need lead to it.
void Exact::look_beside(
    const Tilt& approach, const Touch& first, double curvature, Touch& second, Counters& counters) const {
  const Face& face = model_.faces()[first.face];
  const auto start = merging_contact(tool_, approach, face, first.at, curvature, second.found());
  if (!start) return;
  const Touch touch = first_touch_.refine(approach, first.face, start->x(), start->y(), counters);
  if (touch.at.value < second.at.value && !first_touch_.same_contact(touch, first)) second = touch;
}

PositionStatus Exact::status_of(const Pivot& pivot, const Stop& stop, double curvature) const {
  const bool merged = stop.last.found() && first_touch_.same_contact(stop.last, pivot.first);
  if (stop.x <= pivot.open_side + kNoTilt) return PositionStatus::bridged;
  if (stop.last.found() && !merged) return PositionStatus::two_contacts;
  if (merged || curvature <= pivot.tilt_max) return PositionStatus::curvature_matched;
  const bool held = pivot.first.at.on_border_u || pivot.first.at.on_border_v;
  return held ? PositionStatus::edge_contact : PositionStatus::tilt_limited;
}

// What stopped the tilt is the second contact, unless the tool begins beyond it.
void Exact::note_second(const Touch& second, const JudgedPose& judged, Placement& placement) const {
  if (judged.is_free() && std::abs(signed_distance(tool_, judged.pose(), second.at.s)) > gouge_) return;
  placement.second_contact = second.at.s;
  if (!second.body) placement.second_normal = -ring_distance(tool_, judged.pose(), second.at.s).gradient;
}

// Comes down from the curvature limit or the tilt limit to the first touch; the range ends at the open side.
void Exact::tilt(const Pivot& pivot,
                 const std::vector<Start>& starts,
                 Placement& placement,
                 Counters& counters) const {
  const Touch& first = pivot.first;
  const SurfacePoint p = model_.faces()[first.face].surface.evaluate(first.at.u, first.at.v);
  const double curvature = curvature_limit(tool_, pivot.insert, p, first.at);
  const Tilt approach(tool_, pivot.insert);
  const double most = std::max(pivot.open_side, std::min(curvature, pivot.tilt_max));
  Descent descent{most, pivot.open_side, most, {}, &first};
  Touch second = first_touch_.best_start(approach, starts, most, counters);
  if (second.found() && first_touch_.same_contact(second, first)) second = {};
  if (curvature <= pivot.tilt_max && !(second.at.value < curvature - kNearLimit))
    look_beside(approach, first, curvature, second, counters);
  if (second.found() && second.at.value < most) descent.from = second.at.value, descent.last = second;
  const Stop stop = first_touch_(approach, descent, counters);

  placement.tilt = stop.x;
  placement.status = status_of(pivot, stop, curvature);
  if (stop.last.found() && !first_touch_.same_contact(stop.last, first))
    note_second(stop.last, stop.judged, placement);
  finish(placement, stop.judged);
}

Dropped Exact::dropped(const Vec2& at, std::vector<Start>& starts, Counters& counters) const {
  first_touch_.starts_under(at, starts);
  Dropped found;
  Placement& placement = found.placement;
  placement.status = PositionStatus::off_part;
  const Drop approach(tool_, at);
  const Touch start = first_touch_.best_start(approach, starts, kInfinity, counters);
  if (!start.found()) return found;
  const double x = start.at.value;
  const Stop stop = first_touch_(approach, {x, first_touch_.highest_drop(), x, start}, counters);
  const ToolPose& pose = stop.judged.pose();
  const Touch& first = stop.last;
  if (model_.faces()[first.face].check) return found;
  placement.first_contact = first.at.s;
  placement.tilt = 0;
  placement.first_normal = first.body ? pose.axis : Vec3(-ring_distance(tool_, pose, first.at.s).gradient);
  const bool on_axis = !((first.at.s - pose.torus_center).head<2>().norm() > first_touch_.merged());
  found.first = first, found.upright = pose;
  found.tilts = tool_.major_radius > 0 && !on_axis && !first.body && stop.judged.is_free();
  if (found.tilts) return found;
  placement.status = PositionStatus::one_contact;
  finish(placement, stop.judged);
  return found;
}

// From the upright tool to the position.
Placement Exact::spun(const Dropped& dropped,
                      double spin,
                      const std::vector<Start>& starts,
                      Counters& counters) const {
  Placement placement = dropped.placement;
  if (dropped.tilts) {
    Insert insert = insert_through(tool_, dropped.upright, dropped.first.at.s);
    double open_side = 0;
    if (spin != 0) {
      const Vec3& normal = placement.first_normal;
      const Mat3 turn = rotation(normal, spin);
      insert = {insert.center, turn * insert.u1, turn * insert.v1, turn * insert.w1};
      open_side = -std::atan2(normal.dot(insert.w1), normal.dot(insert.v1));
    }
    tilt({dropped.first, insert, open_side, tilt_max_}, starts, placement, counters);
  }
  if (placement.pose.axis.allFinite()) placement.spin = spin;
  return placement;
}

Placement Exact::place(const Vec2& at, Counters& counters) const {
  thread_local std::vector<Start> starts;
  const Dropped found = dropped(at, starts, counters);
  return spun(found, spin_, starts, counters);
}

class Exact::ReadyTool final : public DroppedTool {
 public:
  ReadyTool(const Exact& method, const Vec2& at, Counters& counters)
      : method_(method), dropped_(method.dropped(at, starts_, counters)) {}

  Placement spun(double spin, Counters& counters) const override {
    return method_.spun(dropped_, spin, starts_, counters);
  }

 private:
  const Exact& method_;
  std::vector<Start> starts_;
  Dropped dropped_;
};

std::unique_ptr<DroppedTool> Exact::drop(const Vec2& at, Counters& counters) const {
  return std::make_unique<ReadyTool>(*this, at, counters);
}

// The insert's frame starts on the equator: v1 along the normal, the tool lying on the surface, and its far
// side comes down from there.
Placement Exact::place(const GivenContact& at, Counters& counters) const {
  Placement placement;
  const Face& face = model_.faces()[at.face];
  const ParamBox& domain = face.surface.domain();
  placement.status = PositionStatus::off_part;
  if (at.u < domain.u0 || at.u > domain.u1 || at.v < domain.v0 || at.v > domain.v1) return placement;
  if (face.check || !face.trim.contains(at.u, at.v)) return placement;
  const SurfacePoint p = face.surface.evaluate(at.u, at.v);
  Vec3 normal = p.su.cross(p.sv).normalized();
  if (normal.z() < 0) normal = -normal;
  const Vec3 along = at.ring_direction - at.ring_direction.dot(normal) * normal;
  const bool has_direction = along.norm() > kNoDirection * at.ring_direction.norm();
  const Vec3 u1 = along.normalized();
  placement.status = PositionStatus::undecided;
  // A pole has no normal, and a direction along the normal no part along the surface.
  if (!normal.allFinite() || !has_direction || !(tool_.major_radius > 0)) return placement;
  const Insert insert{p.s + tool_.minor_radius * normal, u1, normal, u1.cross(normal)};
  placement.first_contact = p.s, placement.first_normal = normal;
  placement.spin = 0;
  Touch first{at.face, {}, false};
  first.at.value = 0, first.at.u = at.u, first.at.v = at.v, first.at.s = p.s;
  thread_local std::vector<Start> starts;
  first_touch_.starts_round(p.s, 2 * tool_.radius(), starts);
  tilt({first, insert, 0, kPi / 2 + tilt_max_}, starts, placement, counters);
  return placement;
}

}  // namespace

std::map<std::string, double> exact_defaults() {
  return {{"gouge_mm", kGougeTolerance}, {"cell_budget", kCellBudget}};
}

std::unique_ptr<Method> make_exact(const SurfaceModel& model,
                                   const Tool& tool,
                                   const MethodOptions& options) {
  require(tool.minor_radius > 0,
          "minor_radius_mm: exact needs a rounded ring; for a flat end mill give its edge radius, for "
          "example 0.01");
  const double tolerance = options.numbers.at("gouge_mm"), budget = options.numbers.at("cell_budget");
  require(std::isfinite(tolerance) && tolerance > 0, "gouge_mm must be a positive number of mm");
  require(budget >= 1000 && budget <= 1e9, "cell_budget must be 1000 to 1e9");
  return std::make_unique<Exact>(model, tool, options);
}

}  // namespace mpm
