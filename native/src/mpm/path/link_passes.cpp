#include "mpm/path/link_passes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/direction.h"
#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/base/pose_motion.h"
#include "mpm/gouge/clearance_sampler.h"
#include "mpm/path/escape.h"

namespace mpm {
namespace {

constexpr double kUnitTolerance = 1e-6;  // of the length of an axis that comes from a file
constexpr std::size_t kGrain = 8;

void check_option(double value, const char* name) {
  require(std::isfinite(value) && value > 0, std::string(name) + " must be a positive number");
}

void check_options(const LinkOptions& o) {
  check_option(o.safe_clearance, "safe_clearance_mm");
  check_option(o.approach_distance, "approach_distance_mm");
  check_option(o.gouge, "gouge_mm");
  check_option(o.cut_gouge, "cut_gouge_mm");
  check_option(o.check_step, "check_step_mm");
  check_option(o.cut_length_max, "cut_length_max_mm");
  check_option(o.cut_turn_max, "cut_turn_max_deg");
  check_option(o.rapid_turn_max, "rapid_turn_max_deg");
  check_option(o.depth, "depth_mm");
  require(std::isfinite(o.tip_deviation) && o.tip_deviation >= 0 && o.tip_deviation <= o.depth,
          "tip_deviation_mm must be at least 0 and at most depth_mm");
  require(std::isfinite(o.axis_deviation) && o.axis_deviation >= 0,
          "axis_deviation_deg must not be negative");
}

void check_positions(const PathPositions& p) {
  require(p.axis.size() == p.tip.size() && p.pass.size() == p.tip.size() && p.usable.size() == p.tip.size(),
          "tip, axis, pass and usable must have the same length");
  require(p.cut_clearance.empty() || p.cut_clearance.size() == p.tip.size(),
          "cut_clearance must be empty or have the length of tip");
  for (std::size_t i = 0; i < p.tip.size(); ++i) {
    if (!p.usable[i]) continue;
    require(p.tip[i].allFinite(), "tip: position " + std::to_string(i) + " is usable but not finite");
    require(std::abs(p.axis[i].norm() - 1) < kUnitTolerance && p.axis[i].z() > 0,
            "axis: position " + std::to_string(i) + " needs a unit vector with z > 0 (tool from above)");
  }
}

// A stretch of positions joined by cuts: [first, last].
struct Run {
  std::size_t first, last;
};

class Linker {
 public:
  Linker(const CellTree& cells, const Tool& tool, const PathPositions& positions, const LinkOptions& options)
      : cells_(cells), sampler_(cells.model(), tool), tool_(tool), positions_(positions), options_(options) {
    safe_z_ = safe_z(cells.model().bounds().hi.z());
  }

  ToolPath link(Context& context);

 private:
  TipPose pose(std::size_t i) const { return {positions_.tip[i], positions_.axis[i]}; }
  double clearance(const TipPose& at) const {
    return sampler_(ToolPose::from_tip(tool_, at.tip, at.axis), options_.approach_distance).distance;
  }
  double safe_z(double surface_top) const;
  bool near(std::size_t i) const;
  double cut_clearance(std::size_t i) const;
  void measure_cuts(Context& context);
  std::vector<Run> runs() const;
  Escape escape(std::size_t i, const Context& context) const;
  std::vector<Escape> escapes(const std::vector<Run>& runs, Context& context) const;

  void add(MoveKind kind,
           const TipPose& to,
           std::int64_t position,
           std::size_t of,
           double clearance,
           bool proven,
           bool blocked = false);
  void add_traverse(const TipPose& from, const TipPose& to, std::size_t target);
  void add_approach(std::size_t i, const Escape& escape);
  void add_retract(std::size_t i, const Escape& escape);
  void add_run(const Run& run, const Escape& in, const Escape& out);

  const CellTree& cells_;
  ClearanceSampler sampler_;
  const Tool& tool_;
  const PathPositions& positions_;
  const LinkOptions& options_;
  double safe_z_;
  std::vector<double> at_position_,
      along_cut_;  // clearances; along the cut that ends in the position (NaN: no cut)
  ToolPath path_;
};

// Below its tip the tool reaches deepest where it is tilted most, and a great circle between two axes is
// nowhere more tilted than its ends: what clears the part at the most tilted position does so on every link.
double Linker::safe_z(double surface_top) const {
  Vec3 flattest = Vec3::UnitZ();
  double highest_tip = -kInfinity;
  for (std::size_t i = 0; i < positions_.tip.size(); ++i) {
    if (!positions_.usable[i]) continue;
    if (positions_.axis[i].z() < flattest.z()) flattest = positions_.axis[i];
    highest_tip = std::max(highest_tip, positions_.tip[i].z());
  }
  const double drop = -tool_bounds(tool_, ToolPose::from_tip(tool_, Vec3::Zero(), flattest), 0.0).lo.z();
  return std::max(surface_top + drop, highest_tip) + options_.safe_clearance;
}

// May a cut join position i with the one before it, as far as their distance tells?
bool Linker::near(std::size_t i) const {
  if (i == 0 || !positions_.usable[i] || !positions_.usable[i - 1]) return false;
  return positions_.pass[i] == positions_.pass[i - 1] &&
         (positions_.tip[i] - positions_.tip[i - 1]).norm() <= options_.cut_length_max &&
         angle_between(positions_.axis[i], positions_.axis[i - 1]) <= options_.cut_turn_max;
}

double Linker::cut_clearance(std::size_t i) const {
  const TipPose a = pose(i - 1), b = pose(i);
  const int steps = std::max(2, int(std::ceil((b.tip - a.tip).norm() / options_.check_step)));
  double least = at_position_[i];
  for (int k = 1; k < steps; ++k) least = std::min(least, clearance(pose_between(a, b, double(k) / steps)));
  return least;
}

void Linker::measure_cuts(Context& context) {
  const std::size_t n = positions_.tip.size();
  at_position_.assign(n, kNaN);
  along_cut_.assign(n, kNaN);
  if (!positions_.cut_clearance.empty()) {
    for (std::size_t i = 0; i < n; ++i)
      if (near(i)) along_cut_[i] = positions_.cut_clearance[i];
    return;
  }
  context.start(2 * n);
  for_each_range(n, kGrain, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (positions_.usable[i]) at_position_[i] = clearance(pose(i));
  });
  for_each_range(n, kGrain, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!near(i)) continue;
      const double least = cut_clearance(i);
      const double allowed = std::min({at_position_[i - 1], at_position_[i], 0.0}) - options_.cut_gouge;
      if (least >= allowed) along_cut_[i] = least;
    }
  });
}

std::vector<Run> Linker::runs() const {
  std::vector<Run> result;
  for (std::size_t i = 0; i < positions_.tip.size(); ++i) {
    if (!positions_.usable[i]) continue;
    if (std::isnan(along_cut_[i])) result.push_back({i, i});
    result.back().last = i;
  }
  return result;
}

Escape Linker::escape(std::size_t i, const Context& context) const {
  return find_escape(sampler_,
                     cells_,
                     tool_,
                     pose(i),
                     {safe_z_,
                      options_.approach_distance,
                      options_.gouge,
                      options_.check_step,
                      options_.depth,
                      options_.tip_deviation,
                      options_.axis_deviation},
                     context);
}

void Linker::add(MoveKind kind,
                 const TipPose& to,
                 std::int64_t position,
                 std::size_t of,
                 double clearance,
                 bool proven,
                 bool blocked) {
  path_.kind.push_back(kind);
  path_.tip.push_back(to.tip);
  path_.axis.push_back(to.axis);
  path_.position.push_back(position);
  path_.pass.push_back(positions_.pass[of]);
  path_.clearance.push_back(clearance);
  path_.proven.push_back(proven);
  path_.blocked.push_back(blocked);
}

// On the safe plane, where everything is clear by construction.
void Linker::add_traverse(const TipPose& from, const TipPose& to, std::size_t target) {
  const double turn = angle_between(from.axis, to.axis);
  const int steps = std::max(1, int(std::ceil(turn / options_.rapid_turn_max)));
  for (int k = 1; k <= steps; ++k)
    add(MoveKind::rapid,
        pose_between(from, to, double(k) / steps),
        -1,
        target,
        options_.safe_clearance,
        true);
}

void Linker::add_approach(std::size_t i, const Escape& way) {
  const TipPose at = pose(i);
  add(MoveKind::rapid, {way.plunge_start(at.tip), at.axis}, -1, i, options_.approach_distance, way.proven);
  add(MoveKind::plunge, at, std::int64_t(i), i, way.clearance, way.proven, way.blocked);
}

void Linker::add_retract(std::size_t i, const Escape& way) {
  const TipPose at = pose(i);
  add(MoveKind::retract, {way.top(at.tip), at.axis}, -1, i, way.clearance, way.proven, way.blocked);
}

void Linker::add_run(const Run& run, const Escape& in, const Escape& out) {
  const TipPose first = pose(run.first);
  const TipPose top{in.top(first.tip), first.axis};
  add_traverse(path_.size() == 0 ? top : TipPose{path_.tip.back(), path_.axis.back()}, top, run.first);
  add_approach(run.first, in);
  for (std::size_t i = run.first + 1; i <= run.last; ++i)
    add(MoveKind::cut, pose(i), std::int64_t(i), i, along_cut_[i], !positions_.cut_clearance.empty());
  add_retract(run.last, out);
}

// Into and out of each run, in turn.
std::vector<Escape> Linker::escapes(const std::vector<Run>& runs, Context& context) const {
  std::vector<Escape> ways(2 * runs.size());
  context.start(ways.size());
  for_each_range(ways.size(), 1, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w)
      ways[w] = escape(w % 2 == 0 ? runs[w / 2].first : runs[w / 2].last, context);
  });
  return ways;
}

ToolPath Linker::link(Context& context) {
  measure_cuts(context);
  if (context.cancelled()) return {};
  const std::vector<Run> all = runs();
  const std::vector<Escape> ways = escapes(all, context);
  if (context.cancelled()) return {};
  for (std::size_t r = 0; r < all.size(); ++r) add_run(all[r], ways[2 * r], ways[2 * r + 1]);
  return std::move(path_);
}

}  // namespace

ToolPath link_passes(const CellTree& cells,
                     const Tool& tool,
                     const PathPositions& positions,
                     const LinkOptions& options,
                     Context& context) {
  check_tool(tool);
  check_options(options);
  check_positions(positions);
  return Linker(cells, tool, positions, options).link(context);
}

}  // namespace mpm
