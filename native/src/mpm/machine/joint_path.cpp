#include "mpm/machine/joint_path.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <string>

#include "mpm/base/direction.h"
#include "mpm/base/error.h"
#include "mpm/machine/rotary_candidates.h"

namespace mpm {
namespace {

// Changing the solution means going to clearance and swinging the head: worth this many seconds of rotary
// motion.
constexpr double kFlipSeconds = 1.0;
// How far a unit vector may be from unit length.
constexpr double kUnitSlack = 1e-6;

// Compared from the first member to the last.
struct Cost {
  std::size_t violations = 0;
  std::size_t not_preferred = 0;
  double seconds = 0;

  auto operator<=>(const Cost&) const = default;
  Cost operator+(const Cost& other) const {
    return {violations + other.violations, not_preferred + other.not_preferred, seconds + other.seconds};
  }
};

// One candidate of a pose in the search, with the best way to it.
struct Node {
  RotaryCandidate candidate;
  Cost total;
  std::size_t from = 0;  // index of the node before
};

// A pose whose rotary readings the geometry fixes (poses in the pole cone are filled in afterwards).
struct Stage {
  std::size_t pose;
  bool may_reposition;  // a move between the stage before and this one does not cut
  bool through_pole;    // poses between the two lie in the pole cone
  std::vector<Node> nodes;
};

class JointSearch {
 public:
  JointSearch(const KinematicChain& chain, const PosePath& path, const JointPathOptions& options)
      : chain_(chain), path_(path), options_(options) {}

  JointPath run() {
    solve_orientations();
    make_stages();
    for (std::size_t k = 0; k < stages_.size(); ++k) extend_to(k);
    take_best();
    fill_pole_poses();
    unwind();
    judge();
    return std::move(result_);
  }

 private:
  void solve_orientations() {
    const OrientationInverse inverse(chain_);
    solutions_.reserve(path_.size());
    for (const Vec3& axis : path_.axis) {
      solutions_.push_back(inverse.solve(axis.normalized()));
      result_.at_pole.push_back(solutions_.back().pole_distance <= options_.pole_cone);
    }
    result_.rotary.resize(path_.size());
    result_.branch.resize(path_.size());
  }

  void make_stages() {
    bool may_reposition = true;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      may_reposition = may_reposition || !path_.cutting[i];
      if (result_.at_pole[i]) continue;
      stages_.push_back({i, may_reposition, i > 0 && result_.at_pole[i - 1] != 0, nodes_of(i)});
      may_reposition = false;
    }
    if (stages_.empty() && path_.size() > 0)
      stages_.push_back({0, true, false, nodes_of(0)});  // the pole everywhere
  }

  std::vector<Node> nodes_of(std::size_t pose) const {
    std::vector<Node> nodes;
    for (const RotaryCandidate& c : rotary_candidates(chain_, solutions_[pose]))
      nodes.push_back({c, {violates(pose, c) ? 1u : 0u, is_preferred(pose, c) ? 0u : 1u, 0.0}, 0});
    return nodes;
  }

  bool violates(std::size_t pose, const RotaryCandidate& c) const {
    return !c.within_limits ||
           !linear_within(linear_readings(chain_, options_.setup, path_.tip[pose], c.rotary));
  }

  bool linear_within(const Vec3& linear) const {
    for (int k = 0; k < 3; ++k)
      if (linear[k] < chain_.linear[k].min_limit || linear[k] > chain_.linear[k].max_limit) return false;
    return true;
  }

  bool is_preferred(std::size_t pose, const RotaryCandidate& c) const {
    const double tilt = solutions_[pose].rotary[c.branch][1],
                 other = solutions_[pose].rotary[1 - c.branch][1];
    switch (chain_.solution_preference) {
      case SolutionPreference::positive:
        return tilt >= other;
      case SolutionPreference::negative:
        return tilt <= other;
      case SolutionPreference::shortest:
        break;
    }
    return true;
  }

  Cost cost_between(const Stage& to, const RotaryCandidate& a, const RotaryCandidate& b) const {
    const Vec2 change = rotary_change(chain_, a.rotary, b.rotary);
    const bool flip = a.branch != b.branch;
    const bool rewind = change.cwiseAbs().maxCoeff() > kPi + kHalfTurnSlack;
    const bool may_flip = chain_.allow_flip && (to.may_reposition || to.through_pole);
    const bool allowed = (!flip || may_flip) && (!rewind || to.may_reposition);
    const bool swings = flip && !to.through_pole;  // in the cone both solutions are next to each other
    return {allowed ? 0u : 1u, 0, rotary_seconds(chain_, change) + (swings ? kFlipSeconds : 0.0)};
  }

  void extend_to(std::size_t k) {
    Stage& stage = stages_[k];
    for (Node& node : stage.nodes) {
      if (k == 0) {
        node.total.seconds =
            rotary_seconds(chain_, rotary_change(chain_, Vec2::Zero(), node.candidate.rotary));
        continue;
      }
      const std::vector<Node>& before = stages_[k - 1].nodes;
      Cost best{std::size_t(-1), 0, 0};
      for (std::size_t j = 0; j < before.size(); ++j) {
        const Cost cost = before[j].total + cost_between(stage, before[j].candidate, node.candidate);
        if (cost < best) best = cost, node.from = j;
      }
      node.total = node.total + best;
    }
  }

  void take_best() {
    if (stages_.empty()) return;
    const auto cheaper = [](const Node& a, const Node& b) { return a.total < b.total; };
    const std::vector<Node>& last = stages_.back().nodes;
    std::size_t node = std::size_t(std::min_element(last.begin(), last.end(), cheaper) - last.begin());
    for (std::size_t k = stages_.size(); k-- > 0;) {
      const Node& chosen = stages_[k].nodes[node];
      result_.rotary[stages_[k].pose] = chosen.candidate.rotary;
      result_.branch[stages_[k].pose] = chosen.candidate.branch;
      node = chosen.from;
    }
  }

  void fill_pole_poses() {
    if (stages_.empty()) return;
    for (std::size_t i = 0; i < stages_.front().pose; ++i) copy_to_pole(stages_.front().pose, i);
    for (std::size_t k = 1; k < stages_.size(); ++k) fill_between(stages_[k - 1].pose, stages_[k].pose);
    for (std::size_t i = stages_.back().pose + 1; i < path_.size(); ++i) copy_to_pole(stages_.back().pose, i);
  }

  // Poses in the pole cone between two that are not: the first axis stands still up to the move that does not
  // cut and is then where it is needed next; without such a move it turns evenly.
  void fill_between(std::size_t before, std::size_t after) {
    std::size_t free_move = before + 1;
    while (free_move <= after && path_.cutting[free_move]) ++free_move;
    const Vec2 change = rotary_change(chain_, result_.rotary[before], result_.rotary[after]);
    for (std::size_t i = before + 1; i < after; ++i) {
      copy_to_pole(free_move <= after && i >= free_move ? after : before, i);
      if (free_move > after) {
        result_.rotary[i][0] += change[0] * double(i - before) / double(after - before);
        if (result_.branch[before] != result_.branch[after]) take_nearer_solution(i);
      }
    }
  }

  // Of the two readings of the second axis the one that points the tool nearer to where it should, the first
  // axis standing as it does.
  void take_nearer_solution(std::size_t pose) {
    Vec2& rotary = result_.rotary[pose];
    double least = kInfinity;
    for (std::uint8_t branch = 0; branch < 2; ++branch) {
      const Vec2 tried(rotary[0], nearest_turn(solutions_[pose].rotary[branch][1], rotary[1]));
      const double off = angle_between(tool_axis(chain_, tried), path_.axis[pose]);
      if (off < least) least = off, result_.branch[pose] = branch, rotary = tried;
    }
  }

  // Takes over the first axis and the solution of a neighbour; the second axis is the pose's own.
  void copy_to_pole(std::size_t neighbour, std::size_t pose) {
    const std::uint8_t branch = result_.branch[neighbour];
    const Vec2& near = result_.rotary[neighbour];
    result_.branch[pose] = branch;
    result_.rotary[pose] = {near[0], nearest_turn(solutions_[pose].rotary[branch][1], near[1])};
  }

  void unwind() {
    for (std::size_t i = 1; i < path_.size(); ++i)
      for (int k = 0; k < 2; ++k)
        if (is_unwound(chain_.rotary[k]))
          result_.rotary[i][k] = nearest_turn(result_.rotary[i][k], result_.rotary[i - 1][k]);
  }

  void judge() {
    for (std::size_t i = 0; i < path_.size(); ++i) {
      result_.linear.push_back(linear_readings(chain_, options_.setup, path_.tip[i], result_.rotary[i]));
      result_.status.push_back(status_of(i));
    }
  }

  JointStatus status_of(std::size_t i) const {
    if (!solutions_[i].reachable && !is_met_in_cone(i)) return JointStatus::unreachable;
    if (!within_limits(chain_, result_.rotary[i])) return JointStatus::rotary_limit;
    if (!linear_within(result_.linear[i])) return JointStatus::linear_limit;
    if (i > 0 && path_.cutting[i] && is_forced(i)) return JointStatus::forced_turn;
    return JointStatus::ok;
  }

  bool is_forced(std::size_t i) const {
    const Vec2 change = result_.rotary[i] - result_.rotary[i - 1];
    const bool in_cone = result_.at_pole[i] || result_.at_pole[i - 1];
    return (result_.branch[i] != result_.branch[i - 1] && !in_cone) ||
           change.cwiseAbs().maxCoeff() > kPi + kHalfTurnSlack;
  }

  bool is_met_in_cone(std::size_t i) const {
    return result_.at_pole[i] &&
           angle_between(tool_axis(chain_, result_.rotary[i]), path_.axis[i]) <= 2 * options_.pole_cone;
  }

  const KinematicChain& chain_;
  const PosePath& path_;
  const JointPathOptions& options_;
  std::vector<OrientationSolutions> solutions_;
  std::vector<Stage> stages_;
  JointPath result_;
};

void check_path(const PosePath& path) {
  require(path.axis.size() == path.size() && path.cutting.size() == path.size(),
          "tip, axis and cutting must have the same length");
  for (std::size_t i = 0; i < path.size(); ++i) {
    require(path.tip[i].allFinite(), "tip[" + std::to_string(i) + "] must be finite");
    require(std::abs(path.axis[i].norm() - 1.0) <= kUnitSlack,
            "axis[" + std::to_string(i) + "] must have length 1");
  }
}

}  // namespace

JointPath joint_path(const KinematicChain& chain, const PosePath& path, const JointPathOptions& options) {
  check_path(path);
  require(options.pole_cone >= 0, "pole_cone must not be negative");
  return JointSearch(chain, path, options).run();
}

}  // namespace mpm
