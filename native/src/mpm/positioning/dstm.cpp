#include "mpm/positioning/dstm.h"

#include <cmath>

#include "mpm/base/error.h"
#include "mpm/contact/insert.h"
#include "mpm/positioning/newton_drop.h"

namespace mpm {
namespace {

constexpr double kFirstTilt = kPi / 36;  // 5 degrees: the first start of the tilt
constexpr double kOpposite = 0.5 * kPi;  // phi of the far side of the major circle

struct Options {
  NewtonRules rules;
  ToolGrid grid;
  int seeds;
  double vicinity;  // half-sides of the box round P, in parts of the face's parameter ranges
  bool spins;
};

class Dstm final : public Method {
 public:
  Dstm(const SurfaceModel& model, const Tool& tool, double tilt_max, double spin, const Options& options)
      : model_(model),
        tool_(tool),
        tilt_max_(tilt_max),
        spin_(spin),
        options_(options),
        locator_(model, tool.radius() / 2) {}

  Placement place(const Vec2& at, Counters& counters) const override {
    return Dropped(*this, at, counters).spun(spin_, counters);
  }
  std::unique_ptr<DroppedTool> drop(const Vec2& at, Counters& counters) const override {
    require(options_.spins, "spin_deg: dtm cannot spin; dstm can");
    return std::make_unique<Dropped>(*this, at, counters);
  }

 private:
  class Dropped final : public DroppedTool {
   public:
    Dropped(const Dstm& method, const Vec2& at, Counters& counters);
    Placement spun(double spin, Counters& counters) const override;

   private:
    const Dstm& method_;
    SeedSource random_;  // as the drop left it: every spin's tilt draws the same numbers
    TangentPoint p_{};
    Placement upright_;
    bool tilts_ = false;
  };

  TiltSolution first_start(const TangentPoint& p, const Insert& insert) const;
  bool acceptable(const TiltSolution& found, const TangentPoint& p, const ToolPose& pose) const;
  void tilt(const TangentPoint& p,
            const Insert& insert,
            SeedSource& random,
            Placement& placement,
            Counters& counters) const;

  const SurfaceModel& model_;
  Tool tool_;
  double tilt_max_, spin_;
  Options options_;
  FootprintLocator locator_;
};

Insert turned(const Insert& insert, const Vec3& normal, double spin) {
  const Mat3 turn = Eigen::AngleAxisd(spin, normal).toRotationMatrix();
  return {insert.center, turn * insert.u1, turn * insert.v1, turn * insert.w1};
}

// In place of the neighbour's solution, which a method without memory does not have: the far side of the
// tool.
TiltSolution Dstm::first_start(const TangentPoint& p, const Insert& insert) const {
  TiltSolution start{p, kFirstTilt, kOpposite};
  const Vec2 far = (insert.center + 2 * tool_.major_radius * insert.v1).head<2>();
  double nearest = kInfinity;
  locator_.visit_near(far, tool_.radius(), [&](const Seed& s) {
    const double distance = (s.s.head<2>() - far).norm();
    if (distance < nearest) nearest = distance, start.contact = {s.face, s.u, s.v, s.s, Vec3::UnitZ()};
  });
  return start;
}

// The paper's checks 1 (vicinity of P) and 2 (direction of the axis), and the tilt limit.
bool Dstm::acceptable(const TiltSolution& found, const TangentPoint& p, const ToolPose& pose) const {
  const TangentPoint& q = found.contact;
  const ParamBox& d = model_.faces()[p.face].surface.domain();
  const bool beside_p = q.face == p.face && std::abs(q.u - p.u) <= options_.vicinity * (d.u1 - d.u0) &&
                        std::abs(q.v - p.v) <= options_.vicinity * (d.v1 - d.v0);
  return !beside_p && found.beta > 0 && found.beta <= tilt_max_ && pose.axis.z() > 0;
}

void Dstm::tilt(const TangentPoint& p,
                const Insert& insert,
                SeedSource& random,
                Placement& placement,
                Counters& counters) const {
  const std::vector<Seed> faces = seeds_under_tool(locator_, tool_, placement.pose.torus_center.head<2>());
  for (int i = 0; i < options_.seeds && !faces.empty(); ++i) {
    TiltSolution start = first_start(p, insert);
    if (i > 0) start = {random_point(model_, faces, random), random(0, tilt_max_), random(-kPi, kPi)};
    const auto found = solve_tilt(model_, tool_, insert, options_.rules, start, counters);
    if (!found) continue;
    const ToolPose pose = tilted(tool_, insert, found->beta);
    if (!acceptable(*found, p, pose) || options_.grid.gouges(model_, tool_, pose, faces, counters)) continue;
    placement.pose = pose;
    placement.tilt = found->beta;
    placement.status = PositionStatus::two_contacts;
    placement.second_contact = found->contact.s, placement.second_normal = found->contact.n;
    return;
  }
  // The paper: without a valid tilt the second contact is the first.
  placement.second_contact = placement.first_contact, placement.second_normal = placement.first_normal;
}

Dstm::Dropped::Dropped(const Dstm& method, const Vec2& at, Counters& counters)
    : method_(method), random_(at) {
  const SurfaceModel& model = method.model_;
  const Tool& tool = method.tool_;
  const Options& options = method.options_;
  upright_.status = PositionStatus::off_part;
  const std::vector<Seed> faces = seeds_under_tool(method.locator_, tool, at);
  if (faces.empty()) return;
  upright_.status = PositionStatus::undecided;
  const auto drop =
      newton_drop(model, tool, at, faces, options.rules, options.grid, options.seeds, random_, counters);
  if (!drop) return;
  p_ = drop->contact;
  upright_.status = PositionStatus::off_part;
  if (model.faces()[p_.face].check) return;
  upright_.status = PositionStatus::one_contact;
  upright_.pose = {Vec3(at.x(), at.y(), drop->height), Vec3::UnitZ()};
  upright_.first_contact = p_.s, upright_.first_normal = p_.n;
  upright_.tilt = 0;
  tilts_ = tool.major_radius > 0 && (p_.s.head<2>() - at).norm() > kOnAxis * tool.radius();
}

Placement Dstm::Dropped::spun(double spin, Counters& counters) const {
  Placement placement = upright_;
  if (placement.status == PositionStatus::one_contact) placement.spin = spin;
  if (!tilts_) return placement;
  const Insert insert = turned(insert_through(method_.tool_, placement.pose, p_.s), p_.n, spin);
  placement.pose = tilted(method_.tool_, insert, 0);
  SeedSource random = random_;
  method_.tilt(p_, insert, random, placement, counters);
  return placement;
}

double positive(const MethodOptions& options, const char* name) {
  const double value = options.numbers.at(name);
  require(std::isfinite(value) && value > 0, std::string(name) + " must be positive");
  return value;
}

int whole(const MethodOptions& options, const char* name, int least, int most) {
  const double value = options.numbers.at(name);
  require(value >= least && value <= most && value == std::floor(value),
          std::string(name) + " must be a whole number from " + std::to_string(least) + " to " +
              std::to_string(most));
  return int(value);
}

}  // namespace

std::map<std::string, double> dstm_defaults() {
  const NewtonRules rules;
  const ToolGrid grid;
  return {{"analytic", 0},
          {"printed_equation_7", 0},
          {"richardson_step", rules.step},
          {"richardson_tolerance", rules.step_tolerance},
          {"newton_tolerance_mm", rules.tolerance},
          {"iterations", double(rules.iterations)},
          {"seeds", 50},
          {"vicinity", 0.005},
          {"phi_divisions", double(grid.phi_divisions)},
          {"theta_divisions", double(grid.theta_divisions)},
          {"gouge_mm", grid.gouge}};
}

namespace {

std::unique_ptr<Method> make(const SurfaceModel& model,
                             const Tool& tool,
                             const MethodOptions& options,
                             bool spins) {
  const NewtonRules rules{whole(options, "analytic", 0, 1) == 1,
                          whole(options, "printed_equation_7", 0, 1) == 1,
                          positive(options, "richardson_step"),
                          positive(options, "richardson_tolerance"),
                          positive(options, "newton_tolerance_mm"),
                          whole(options, "iterations", 1, 10000)};
  const ToolGrid grid{whole(options, "phi_divisions", 1, 4096),
                      whole(options, "theta_divisions", 1, 4096),
                      positive(options, "gouge_mm")};
  return std::make_unique<Dstm>(
      model,
      tool,
      options.tilt_max,
      options.spin,
      Options{rules, grid, whole(options, "seeds", 1, 100000), positive(options, "vicinity"), spins});
}

}  // namespace

std::unique_ptr<Method> make_dstm(const SurfaceModel& model, const Tool& tool, const MethodOptions& options) {
  return make(model, tool, options, true);
}

std::unique_ptr<Method> make_dtm(const SurfaceModel& model, const Tool& tool, const MethodOptions& options) {
  require(options.spin == 0, "spin_deg: dtm cannot spin; use 0, or method dstm");
  return make(model, tool, options, false);
}

}  // namespace mpm
