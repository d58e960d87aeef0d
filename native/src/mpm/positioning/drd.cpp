#include "mpm/positioning/drd.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/contact/insert.h"
#include "mpm/contact/vertical_ray.h"
#include "mpm/positioning/tool_shadow.h"

namespace mpm {
namespace {

constexpr int kRaySteps = 30;        // Newton steps a ray may take; 2 to 6 are usual
constexpr int kMostBisections = 60;  // 45 degrees halved so often is below a double's resolution

// The source's options, in mm as it has them; who wants others gives them.
constexpr double kNewtonTolerance = 1e-6;  // mm in plan: far below the drop difference of 0.01
constexpr double kSameContact = 1e-3;      // mm: about the last grid of rays

struct Options {
  int rays, refinements, equal_contacts;
  double epsilon, newton_tolerance, same_contact;
  bool inner_half;
};

struct Drop {
  double height = -kInfinity;  // of the torus centre
  double u = 0, v = 0;
  std::uint32_t face = 0;
  double theta = 0, phi = 0;
  Vec3 s = Vec3::Zero();  // turned
  bool found() const { return height > -kInfinity; }
};

class Drd final : public Method {
 public:
  Drd(const SurfaceModel& model, const Tool& tool, double tilt_max, const Options& options)
      : model_(model),
        tool_(tool),
        tilt_max_(tilt_max),
        options_(options),
        locator_(model, tool.radius() / 2) {}

  Placement place(const Vec2& at, Counters& counters) const override;

 private:
  Drop drop(const Vec2& at,
            const SurfaceTurn& turned,
            const std::vector<Seed>& seeds,
            Counters& counters) const;
  void drop_on(const Vec2& at, const SurfaceTurn& turned, Seed seed, Drop& best, Counters& counters) const;
  void tilt(const Vec2& at, const std::vector<Seed>& seeds, Placement& placement, Counters& counters) const;

  const SurfaceModel& model_;
  Tool tool_;
  double tilt_max_;
  Options options_;
  FootprintLocator locator_;
};

// Fig. 3.6 on one face: rays from a grid on the ring, the grid closed in round the best one.
void Drd::drop_on(
    const Vec2& at, const SurfaceTurn& turned, Seed seed, Drop& best, Counters& counters) const {
  Drop local;
  double theta0 = options_.inner_half ? kPi : 1.5 * kPi, theta1 = 2 * kPi, phi0 = 0, phi1 = 2 * kPi;
  RayWork work;
  for (int round = 0; round < options_.refinements; ++round) {
    const double step_theta = (theta1 - theta0) / options_.rays, step_phi = (phi1 - phi0) / options_.rays;
    for (int i = 0; i <= options_.rays; ++i)
      for (int j = 0; j <= options_.rays; ++j) {
        const double theta = theta0 + i * step_theta, phi = phi0 + j * step_phi;
        const double r = tool_.major_radius + tool_.minor_radius * std::cos(theta);
        const Vec2 from = at + r * Vec2(std::cos(phi), std::sin(phi));
        Vec3 s;
        ++counters.seeds;
        if (!meet_vertical_ray(model_.faces()[seed.face],
                               turned,
                               from,
                               {options_.newton_tolerance, kRaySteps},
                               seed.u,
                               seed.v,
                               s,
                               work))
          continue;
        const double height = s.z() - tool_.minor_radius * std::sin(theta);
        if (height > local.height) local = {height, seed.u, seed.v, seed.face, theta, phi, s};
      }
    if (!local.found()) break;
    theta0 = local.theta - step_theta, theta1 = local.theta + step_theta;
    phi0 = local.phi - step_phi, phi1 = local.phi + step_phi;
  }
  counters.evaluations += work.evaluations, counters.newton_steps += work.steps;
  if (local.height > best.height) best = local;
}

Drop Drd::drop(const Vec2& at,
               const SurfaceTurn& turned,
               const std::vector<Seed>& seeds,
               Counters& counters) const {
  Drop best;
  for (const Seed& seed : seeds) drop_on(at, turned, seed, best, counters);
  return best;
}

// Fig. 3.5, steps 4.4 to 4.9: bisection on the turn of the surface: by beta about u1, as `tilted` turns the
// tool by -beta about it.
void Drd::tilt(const Vec2& at,
               const std::vector<Seed>& seeds,
               Placement& placement,
               Counters& counters) const {
  const Insert insert = insert_through(tool_, placement.pose, placement.first_contact);
  const double height = placement.pose.torus_center.z();
  double low = 0, high = tilt_max_, beta = high;
  Vec3 second = Vec3::Constant(kNaN);
  for (int equal = 1, i = 0; equal < options_.equal_contacts && i < kMostBisections; ++i) {
    beta = (high + low) / 2;
    const SurfaceTurn turned{Eigen::AngleAxisd(beta, insert.u1).toRotationMatrix(), insert.center};
    const Drop next = drop(at, turned, seeds, counters);
    (next.height - height > options_.epsilon ? high : low) = beta;
    if (!next.found()) continue;
    const Vec3 contact = model_.faces()[next.face].surface.point(next.u, next.v);
    ++counters.evaluations;
    equal = (contact - second).norm() <= options_.same_contact ? equal + 1 : 1;
    second = contact;
  }
  placement.tilt = beta;
  placement.pose = tilted(tool_, insert, beta);
  if (high == tilt_max_) {  // every turn was free
    placement.status = PositionStatus::tilt_limited;
    return;
  }
  placement.status = low == 0 ? PositionStatus::bridged : PositionStatus::two_contacts;
  placement.second_contact = second;
  placement.second_normal = ring_normal(tool_, placement.pose, second);
}

Placement Drd::place(const Vec2& at, Counters& counters) const {
  Placement placement;
  const std::vector<Seed> seeds = seeds_under_tool(locator_, tool_, at);
  const Drop first = drop(at, {}, seeds, counters);
  if (!first.found() || model_.faces()[first.face].check) {
    placement.status = PositionStatus::off_part;
    return placement;
  }
  placement.pose = {Vec3(at.x(), at.y(), first.height), Vec3::UnitZ()};
  placement.first_contact = first.s;
  placement.tilt = placement.spin = 0.0;
  placement.status = PositionStatus::one_contact;  // a ball, or a contact on the axis, has no insert
  const bool on_axis = (first.s.head<2>() - at).norm() <= kOnAxis * tool_.radius();
  placement.first_normal = on_axis ? Vec3::UnitZ() : ring_normal(tool_, placement.pose, first.s);
  if (tool_.major_radius > 0 && !on_axis) tilt(at, seeds, placement, counters);
  return placement;
}

}  // namespace

std::map<std::string, double> drd_defaults() {
  return {{"rays", 10},
          {"refinements", 5},
          {"equal_contacts", 10},
          {"epsilon_mm", 0.01},
          {"newton_tolerance_mm", kNewtonTolerance},
          {"same_contact_mm", kSameContact},
          {"inner_half", 0}};
}

std::unique_ptr<Method> make_drd(const SurfaceModel& model, const Tool& tool, const MethodOptions& options) {
  require(options.spin == 0, "spin_deg: drd cannot spin; use 0");
  for (const char* name : {"rays", "refinements", "equal_contacts"}) {
    const double value = options.numbers.at(name);
    require(value >= 2 && value <= 1000 && value == std::floor(value),
            std::string(name) + " must be 2 to 1000");
  }
  for (const char* name : {"epsilon_mm", "newton_tolerance_mm", "same_contact_mm"}) {
    const double value = options.numbers.at(name);
    require(std::isfinite(value) && value > 0, std::string(name) + " must be positive");
  }
  const double inner = options.numbers.at("inner_half");
  require(inner == 0 || inner == 1, "inner_half must be 0 or 1");
  const auto whole = [&](const char* name) { return int(options.numbers.at(name)); };
  return std::make_unique<Drd>(model,
                               tool,
                               options.tilt_max,
                               Options{whole("rays"),
                                       whole("refinements"),
                                       whole("equal_contacts"),
                                       options.numbers.at("epsilon_mm"),
                                       options.numbers.at("newton_tolerance_mm"),
                                       options.numbers.at("same_contact_mm"),
                                       inner == 1});
}

}  // namespace mpm
