#include "mpm/positioning/pam.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/contact/insert.h"
#include "mpm/positioning/newton_drop.h"

namespace mpm {
namespace {

constexpr int kSeeds = 50;  // starts of the drop
// mm, well below any tolerance: exact derivatives reach it in a step or two more.
constexpr double kNewtonTolerance = 1e-9;
// Curvature times tool radius; what bends by less is flat. The rounding of second derivatives, about 1e-12 on
// parts of a metre, must not decide by its sign; over a tool it is 1e-8 mm.
constexpr double kFlat = 1e-9;
constexpr double kNoTilt = 1e-9;  // rad: an upright tool nearer than this to the match has it

NewtonRules exact_rules() {
  NewtonRules rules;
  rules.analytic = true;
  rules.tolerance = kNewtonTolerance;
  return rules;
}

// Largest normal curvature (1/mm), positive where the surface bends towards its normal n.
double largest_curvature(const SurfacePoint& p, const Vec3& n) {
  const double e = p.su.dot(p.su), f = p.su.dot(p.sv), g = p.sv.dot(p.sv);
  const double l = p.suu.dot(n), m = p.suv.dot(n), k = p.svv.dot(n);
  const double det = e * g - f * f;
  const double mean = (e * k - 2 * f * m + g * l) / (2 * det), gauss = (l * k - m * m) / det;
  return mean + std::sqrt(std::max(mean * mean - gauss, 0.0));
}

class Pam final : public Method {
 public:
  Pam(const SurfaceModel& model, const Tool& tool, double tilt_max, double step, const ToolGrid& grid)
      : model_(model),
        tool_(tool),
        tilt_max_(tilt_max),
        step_(step),
        grid_(grid),
        locator_(model, tool.radius() / 2) {}

  Placement place(const Vec2& at, Counters& counters) const override;

 private:
  double matching_tilt(const Insert& insert, const Vec3& n, double curvature) const;
  void incline(const TangentPoint& p, const Insert& insert, Placement& placement, Counters& counters) const;

  const SurfaceModel& model_;
  Tool tool_;
  double tilt_max_, step_;
  ToolGrid grid_;
  FootprintLocator locator_;
};

// The tilt at which the ring's curvature at the contact, cos(theta)/(Ro + Ri cos(theta)) with cos(theta) = n
// . v1 after the tilt, is `curvature`. Where the surface is flat that is theta = 90 degrees, and where it
// bends away nothing comes closer. Negative: even the upright tool is less curved than the surface.
double Pam::matching_tilt(const Insert& insert, const Vec3& n, double curvature) const {
  const double free = 1 - curvature * tool_.minor_radius;
  const double cosine = curvature <= 0 ? 0.0 : free > 0 ? curvature * tool_.major_radius / free : kInfinity;
  return std::acos(std::min(cosine, 1.0)) - std::atan2(n.dot(insert.w1), n.dot(insert.v1));
}

void Pam::incline(const TangentPoint& p,
                  const Insert& insert,
                  Placement& placement,
                  Counters& counters) const {
  const double curvature = largest_curvature(model_.faces()[p.face].surface.evaluate(p.u, p.v), p.n);
  ++counters.evaluations;
  const double flat = kFlat / tool_.radius();
  const double wanted = matching_tilt(insert, p.n, curvature);
  const std::vector<Seed> faces = seeds_under_tool(locator_, tool_, placement.pose.torus_center.head<2>());
  double tilt = std::clamp(wanted, 0.0, tilt_max_);
  const double first = tilt;
  while (tilt > 0 && grid_.gouges(model_, tool_, tilted(tool_, insert, tilt), faces, counters))
    tilt = std::max(tilt - step_, 0.0);
  placement.tilt = tilt;
  placement.pose = tilted(tool_, insert, tilt);
  placement.status = tilt < first         ? PositionStatus::one_contact
                     : wanted > tilt_max_ ? PositionStatus::tilt_limited
                     : wanted < -kNoTilt  ? PositionStatus::bridged
                     : curvature < -flat  ? PositionStatus::one_contact
                                          : PositionStatus::curvature_matched;
}

Placement Pam::place(const Vec2& at, Counters& counters) const {
  Placement placement;
  const std::vector<Seed> faces = seeds_under_tool(locator_, tool_, at);
  SeedSource random(at);
  std::optional<DropSolution> drop;
  if (!faces.empty())
    drop = newton_drop(model_, tool_, at, faces, exact_rules(), grid_, kSeeds, random, counters);
  if (!drop || model_.faces()[drop->contact.face].check) {
    placement.status = faces.empty() || drop ? PositionStatus::off_part : PositionStatus::undecided;
    return placement;
  }
  const TangentPoint& p = drop->contact;
  placement.pose = {Vec3(at.x(), at.y(), drop->height), Vec3::UnitZ()};
  placement.first_contact = p.s, placement.first_normal = p.n;
  placement.tilt = placement.spin = 0.0;
  placement.status = PositionStatus::one_contact;
  if (tool_.major_radius > 0 && (p.s.head<2>() - at).norm() > kOnAxis * tool_.radius())
    incline(p, insert_through(tool_, placement.pose, p.s), placement, counters);
  return placement;
}

}  // namespace

std::map<std::string, double> pam_defaults() {
  const ToolGrid grid;
  return {{"phi_divisions", double(grid.phi_divisions)},
          {"theta_divisions", double(grid.theta_divisions)},
          {"gouge_mm", grid.gouge},
          {"step_deg", 0.5}};
}

std::unique_ptr<Method> make_pam(const SurfaceModel& model, const Tool& tool, const MethodOptions& options) {
  require(options.spin == 0, "spin_deg: pam cannot spin; use 0");
  for (const char* name : {"phi_divisions", "theta_divisions"}) {
    const double value = options.numbers.at(name);
    require(value >= 1 && value <= 4096 && value == std::floor(value),
            std::string(name) + " must be 1 to 4096");
  }
  for (const char* name : {"gouge_mm", "step_deg"}) {
    const double value = options.numbers.at(name);
    require(std::isfinite(value) && value > 0, std::string(name) + " must be positive");
  }
  const ToolGrid grid{int(options.numbers.at("phi_divisions")),
                      int(options.numbers.at("theta_divisions")),
                      options.numbers.at("gouge_mm")};
  return std::make_unique<Pam>(model, tool, options.tilt_max, radians(options.numbers.at("step_deg")), grid);
}

}  // namespace mpm
