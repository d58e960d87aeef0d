#include "mpm/positioning/vcrf.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/contact/drop.h"
#include "mpm/contact/insert.h"
#include "mpm/positioning/tool_shadow.h"

namespace mpm {
namespace {

constexpr double kWalkSteps = 8;           // steps of the walk to a window's border, if the surface were even
constexpr double kMinWalkPart = 1.0 / 64;  // a step is at most this part of the parameter range
// Of the cutter's radius: a node nearer to P than this is P itself, whose circular ray is 0/0.
constexpr double kSamePoint = 1e-7;

struct Node {
  double value, u, v;
  std::uint32_t face;
  Vec3 s;
  bool found = false;
};

// The grid of fig. 4.9 and 4.10 with its resets (4.4.5): keeps the node with the least `value` over all
// windows.
class RayGrid {
 public:
  RayGrid(const SurfaceModel& model, int divisions, int rounds, Counters& counters)
      : model_(model), divisions_(divisions), rounds_(rounds), counters_(counters) {}

  // `ray(s)`: what to minimise at surface point s; NaN or +inf where the ray misses the torus.
  template <class Ray>
  void search(std::uint32_t face, ParamBox window, const Ray& ray, Node& best) const {
    Node local{kInfinity, 0, 0, face, Vec3::Zero()};
    for (int round = 0; round < rounds_; ++round) {
      const double du = (window.u1 - window.u0) / divisions_, dv = (window.v1 - window.v0) / divisions_;
      scan(window, du, dv, ray, local);
      if (!local.found) return;
      const ParamBox& d = model_.faces()[face].surface.domain();
      window = {std::max(local.u - du, d.u0),
                std::min(local.u + du, d.u1),
                std::max(local.v - dv, d.v0),
                std::min(local.v + dv, d.v1)};
    }
    if (!best.found || local.value < best.value) best = local;
  }

 private:
  template <class Ray>
  void scan(const ParamBox& window, double du, double dv, const Ray& ray, Node& local) const {
    const Face& face = model_.faces()[local.face];
    const bool trimmed = !face.trim.everything();
    for (int i = 0; i <= divisions_; ++i) {
      const double u = i == divisions_ ? window.u1 : window.u0 + i * du;
      for (int j = 0; j <= divisions_; ++j) {
        const double v = j == divisions_ ? window.v1 : window.v0 + j * dv;
        if (trimmed && !face.trim.contains(u, v)) continue;
        const Vec3 s = face.surface.point(u, v);
        const double value = ray(s);
        if (value < local.value)
          local.value = value, local.u = u, local.v = v, local.s = s, local.found = true;
      }
    }
    counters_.evaluations += std::uint64_t(divisions_ + 1) * std::uint64_t(divisions_ + 1);
  }

  const SurfaceModel& model_;
  int divisions_, rounds_;
  Counters& counters_;
};

class Vcrf final : public Method {
 public:
  Vcrf(const SurfaceModel& model, const Tool& tool, const MethodOptions& options)
      : model_(model),
        tool_(tool),
        tilt_max_(options.tilt_max),
        divisions_(int(options.numbers.at("divisions"))),
        rounds_(int(options.numbers.at("rounds"))),
        window_(options.numbers.at("window_factor") * tool.radius()),
        locator_(model, tool.radius() / 2) {}

  Placement place(const Vec2& at, Counters& counters) const override;

 private:
  ParamBox window_round(std::uint32_t face, double u, double v, Counters& counters) const;
  double walk(
      const BSplineSurface& surface, double u, double v, int direction, int sign, Counters& counters) const;
  Node drop(const Vec2& at, const RayGrid& grid, Counters& counters) const;
  void tilt(const Node& first, const RayGrid& grid, Placement& placement, Counters& counters) const;

  const SurfaceModel& model_;
  Tool tool_;
  double tilt_max_;
  int divisions_, rounds_;
  double window_;  // half-width of the grid's window, mm
  FootprintLocator locator_;
};

// The parameter window of section 4.4.4 without its assumption of a uniform net: along both iso-lines through
// (u, v) as far as `window_` mm in plan. On a uniform net this is the thesis' window.
ParamBox Vcrf::window_round(std::uint32_t face, double u, double v, Counters& counters) const {
  const BSplineSurface& surface = model_.faces()[face].surface;
  return {walk(surface, u, v, 0, -1, counters),
          walk(surface, u, v, 0, +1, counters),
          walk(surface, u, v, 1, -1, counters),
          walk(surface, u, v, 1, +1, counters)};
}

double Vcrf::walk(
    const BSplineSurface& surface, double u, double v, int direction, int sign, Counters& counters) const {
  const ParamBox& d = surface.domain();
  const double end = direction == 0 ? (sign < 0 ? d.u0 : d.u1) : (sign < 0 ? d.v0 : d.v1);
  const double longest = kMinWalkPart * (direction == 0 ? d.u1 - d.u0 : d.v1 - d.v0);
  double t = direction == 0 ? u : v, gone = 0;
  const auto plan_point = [&](double at) -> Vec2 {
    ++counters.evaluations;
    return (direction == 0 ? surface.point(at, v) : surface.point(u, at)).head<2>();
  };
  const Vec2 start = plan_point(t);
  double step = longest;
  while (t != end) {
    double next = t + sign * step;
    if (sign * (next - end) >= 0) next = end;
    const double distance = (plan_point(next) - start).norm();
    if (distance > window_)
      return next - (next - t) * std::clamp((distance - window_) / (distance - gone), 0.0, 1.0);
    // Keep each step at about window_ / kWalkSteps of plan, never longer than `longest`.
    if (distance > gone)
      step = std::min(longest, std::abs(next - t) * window_ / kWalkSteps / (distance - gone));
    t = next, gone = distance;
  }
  return end;
}

Node Vcrf::drop(const Vec2& at, const RayGrid& grid, Counters& counters) const {
  Node best{};
  for (const Seed& seed : seeds_under_tool(locator_, tool_, at))
    grid.search(
        seed.face,
        window_round(seed.face, seed.u, seed.v, counters),
        [&](const Vec3& s) { return -drop_height(tool_, at, s); },
        best);
  return best;
}

void Vcrf::tilt(const Node& first, const RayGrid& grid, Placement& placement, Counters& counters) const {
  const Insert insert = insert_through(tool_, placement.pose, first.s);
  const auto ray = [&](const Vec3& s) {
    return (s - first.s).norm() <= kSamePoint * tool_.radius() ? kNaN
                                                               : circular_ray(tool_, insert.to_local(s));
  };
  Node second{};
  for (const Seed& seed : seeds_under_tool(locator_, tool_, placement.pose.torus_center.head<2>())) {
    const bool own = seed.face == first.face;
    grid.search(seed.face,
                window_round(seed.face, own ? first.u : seed.u, own ? first.v : seed.v, counters),
                ray,
                second);
  }
  placement.status = !second.found              ? PositionStatus::one_contact
                     : second.value > tilt_max_ ? PositionStatus::tilt_limited
                     : second.value <= 0        ? PositionStatus::bridged
                                                : PositionStatus::two_contacts;
  placement.tilt = !second.found ? 0.0 : std::clamp(second.value, 0.0, tilt_max_);
  placement.pose = tilted(tool_, insert, placement.tilt);
  if (!second.found || second.value > tilt_max_) return;
  placement.second_contact = second.s;
  placement.second_normal = ring_normal(tool_, placement.pose, second.s);
}

Placement Vcrf::place(const Vec2& at, Counters& counters) const {
  const RayGrid grid(model_, divisions_, rounds_, counters);
  Placement placement;
  const Node first = drop(at, grid, counters);
  if (!first.found || model_.faces()[first.face].check) {
    placement.status = PositionStatus::off_part;
    return placement;
  }
  placement.pose = {Vec3(at.x(), at.y(), -first.value), Vec3::UnitZ()};
  placement.first_contact = first.s;
  placement.tilt = placement.spin = 0.0;
  const Vec2 radial = first.s.head<2>() - at;
  const bool on_axis = !(radial.norm() > kOnAxis * tool_.radius());
  Vec3 around = Vec3::Zero();
  if (!on_axis) around.head<2>() = radial * (tool_.major_radius / radial.norm());
  placement.first_normal = (placement.pose.torus_center + around - first.s).normalized();
  placement.status =
      PositionStatus::one_contact;  // a ball, or a contact on the axis, has no insert to tilt about
  if (tool_.major_radius > 0 && !on_axis) tilt(first, grid, placement, counters);
  return placement;
}

}  // namespace

std::map<std::string, double> vcrf_defaults() {
  return {{"divisions", 32}, {"rounds", 4}, {"window_factor", 1.5}};
}

std::unique_ptr<Method> make_vcrf(const SurfaceModel& model, const Tool& tool, const MethodOptions& options) {
  require(options.spin == 0, "spin_deg: vcrf cannot spin; use 0");
  for (const char* name : {"divisions", "rounds"}) {
    const double value = options.numbers.at(name);
    require(value >= 1 && value <= 4096 && value == std::floor(value),
            std::string(name) + " must be 1 to 4096");
  }
  const double factor = options.numbers.at("window_factor");
  require(std::isfinite(factor) && factor > 0, "window_factor must be positive");
  return std::make_unique<Vcrf>(model, tool, options);
}

}  // namespace mpm
