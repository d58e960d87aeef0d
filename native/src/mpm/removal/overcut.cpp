#include "mpm/removal/overcut.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/direction.h"
#include "mpm/base/parallel.h"
#include "mpm/surface/box_tree.h"

namespace mpm {
namespace {

constexpr std::size_t kPointsATask = 64;
constexpr double kEnlarged = 1e-9;  // mm: what rounding may take off a box

constexpr double kGolden = 0.6180339887498949;
constexpr int kGoldenRounds = 24;  // to 1e-5 of a look's step

struct Move {
  std::int32_t number;
  TipPose from, to;
  double travel, turn;  // mm, radians
};

std::vector<Move> removing_moves(const SweptPath& path) {
  std::vector<Move> moves;
  for (std::size_t i = 1; i < path.poses.size(); ++i)
    if (path.removes[i]) {
      const TipPose &a = path.poses[i - 1], &b = path.poses[i];
      moves.push_back({std::int32_t(i), a, b, (b.tip - a.tip).norm(), angle_between(a.axis, b.axis)});
    }
  return moves;
}

// Every point of the tool moves on an arc about a tip that moves on a line: it leaves the chord between its
// ends by the arc's sagitta at most.
Box3 swept_box(const Tool& tool, const Move& move) {
  const double lever = hypotenuse(tool.length(), tool.reach());
  const double margin = lever * (1 - std::cos(std::min(move.turn, kPi) / 2)) + kEnlarged;
  Box3 box = tool_bounds(tool, ToolPose::from_tip(tool, move.from.tip, move.from.axis), margin);
  box.extend(tool_bounds(tool, ToolPose::from_tip(tool, move.to.tip, move.to.axis), margin));
  return box;
}

// Searches the moves for the one that holds a point deepest.
class Search {
 public:
  Search(const Tool& tool, const Vec3& point) : tool_(tool), point_(point) {}

  double depth() const { return 0 - least_; }
  std::int32_t move() const { return move_; }

  void look_at(const Move& move) {
    const double lever = (point_ - 0.5 * (move.from.tip + move.to.tip)).norm() + move.travel / 2;
    const double rate = move.travel + move.turn * lever, before = least_;
    look(move, 0.0);
    look(move, 1.0);
    halve(move, 0.0, 1.0, rate);
    if (least_ < before) refine(move, kOvercutStep / std::max(rate, kOvercutStep));
  }

 private:
  double distance(const Move& move, double time) const {
    const TipPose at = pose_between(move.from, move.to, time);
    return signed_distance(tool_, ToolPose::from_tip(tool_, at.tip, at.axis), point_);
  }

  double look(const Move& move, double time) {
    const double found = distance(move, time);
    if (found < least_) least_ = found, time_ = time, move_ = move.number;
    return found;
  }

  // rate: mm by which the distance can change while the move's time goes from 0 to 1.
  void halve(const Move& move, double begin, double end, double rate) {
    const double middle = 0.5 * (begin + end), reach = rate * (end - begin) / 2, found = look(move, middle);
    if (found - reach >= least_ || reach <= kOvercutStep / 2) return;
    halve(move, begin, middle, rate);
    halve(move, middle, end, rate);
  }

  // The deepest within `step` of the time of the deepest look, by golden section.
  void refine(const Move& move, double step) {
    double begin = std::max(time_ - step, 0.0), end = std::min(time_ + step, 1.0);
    for (int round = 0; round < kGoldenRounds; ++round) {
      const double part = kGolden * (end - begin);
      if (distance(move, end - part) < distance(move, begin + part))
        end = begin + part;
      else
        begin = end - part;
    }
    least_ = std::min(least_, distance(move, 0.5 * (begin + end)));
  }

  const Tool& tool_;
  const Vec3& point_;
  double least_ = 0, time_ = 0;
  std::int32_t move_ = -1;
};

}  // namespace

Overcut find_overcut(const std::vector<Vec3>& points,
                     const Tool& tool,
                     const SweptPath& path,
                     Context& context) {
  check_tool(tool);
  check_swept_path(path);
  const std::vector<Move> moves = removing_moves(path);
  std::vector<Box3> boxes;
  for (const Move& move : moves) boxes.push_back(swept_box(tool, move));
  const BoxTree tree(boxes);
  Overcut result{std::vector<double>(points.size(), 0.0), std::vector<std::int32_t>(points.size(), -1)};
  context.start(points.size());
  for_each_range(points.size(), kPointsATask, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !context.cancelled(); ++i) {
      Search search(tool, points[i]);
      tree.visit(Box3{points[i], points[i]}, [&](std::uint32_t k) { search.look_at(moves[k]); });
      result.depth[i] = search.depth(), result.move[i] = search.move();
    }
  });
  return result;
}

}  // namespace mpm
