#include "mpm/gouge/certify_motion.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/contact/motion_bound.h"
#include "mpm/gouge/quarters.h"

namespace mpm {
namespace {

constexpr double kUnitTolerance = 1e-6;        // of the length of an axis that comes from a file
constexpr double kOppositeSlack = 1e-6;        // radians: nearer to opposite, the great circle is not known
constexpr std::uint64_t kCellsPerLook = 1024;  // between two looks at a cancel: a fraction of a millisecond

// A piece of surface: a node of the tree, or a part of a leaf below it.
struct Piece {
  std::uint32_t node;
  bool deep;
  bool trimmed;
  ParamBox box;
  double third;  // of a deep one
  QuadraticCell cell;
};

struct Interval {
  double t0, t1;
  ToolMotion::Stretch stretch;
  MotionBound bound;
  std::uint32_t half = 0;  // index of the first of two halves; 0: not made yet
};

// The lowest bound goes first. Depth first would wander along the surface points that are just as deep as the
// tolerance, each of which takes for ever, before it meets the deep ones.
struct Task {
  double lower;  // mm, the bound of what it is a part of
  std::uint32_t piece, interval;

  friend bool operator<(const Task& a, const Task& b) {  // as std::push_heap orders: the last is on top
    return std::tie(b.lower, b.piece, b.interval) < std::tie(a.lower, a.piece, a.interval);
  }
};

class Search {
 public:
  Search(const CellTree& tree,
         const Tool& tool,
         const ToolPose& from,
         const ToolPose& to,
         const CertifyMotionOptions& options,
         const Context& context)
      : tree_(tree),
        tool_(tool),
        motion_(tool, from, to),
        options_(options),
        context_(context),
        enough_(std::max(0.0, -options.tolerance)) {}

  MotionCertificate run() {
    double lo = enough_;
    if (!keeps_off_everything()) {
      add_interval(0.0, 1.0);
      for (std::uint32_t root : tree_.roots()) push_node(root, {-kInfinity, 0, 0});
    }
    while (!tasks_.empty()) {
      if (result_.cells >= options_.budget) return result_;
      if (result_.cells % kCellsPerLook == 0 && context_.cancelled()) return result_;
      std::pop_heap(tasks_.begin(), tasks_.end());
      const Task task = tasks_.back();
      tasks_.pop_back();
      const double lower = settle(task);
      if (hopeless_) return result_;
      lo = std::min(lo, lower);
    }
    if (lo >= -options_.tolerance) result_.verdict = Verdict::free, result_.lo = lo;
    return result_;
  }

 private:
  // By boxes: the way of the tool from end to end, and all faces.
  bool keeps_off_everything() const {
    const Box3& faces = tree_.model().bounds();
    const Box3 swept = motion_.swept_box(tool_, options_.axis_deviation);
    return (swept.lo - faces.hi).cwiseMax(faces.lo - swept.hi).maxCoeff() >= enough_;
  }

  void push(const Task& task) {
    tasks_.push_back(task);
    std::push_heap(tasks_.begin(), tasks_.end());
  }

  void push_piece(const Piece& piece, const Task& part_of) {
    push({part_of.lower, std::uint32_t(pieces_.size()), part_of.interval});
    pieces_.push_back(piece);
  }

  void push_node(std::uint32_t node, const Task& part_of) {
    const CellTree::Node& n = tree_.nodes()[node];
    push_piece({node, false, n.trimmed, n.box, 0, n.cell}, part_of);
  }

  void add_interval(double t0, double t1) {
    const ToolMotion::Stretch stretch = motion_.stretch(t0, t1);
    intervals_.push_back({t0, t1, stretch, MotionBound(tool_, stretch.middle, motion_.magnitude())});
  }

  // The bound that settles the task; infinity where its parts have to.
  double settle(const Task& task) {
    ++result_.cells;
    const Piece& piece = pieces_[task.piece];
    const Interval& interval = intervals_[task.interval];
    const MovingCell cell = moving_cell(piece.cell, interval.stretch, options_.axis_deviation);
    const MotionBound::Answer answer = interval.bound(cell, enough_);
    if (answer.lower >= -options_.tolerance) return answer.lower;
    look_at(piece, interval, answer.center, cell.allowance);
    if (hopeless_) return answer.lower;
    if (piece.cell.radius + cell.travel < kFinestCell) return answer.lower;
    if (cell.travel > piece.cell.radius)
      split_time({answer.lower, task.piece, task.interval});
    else
      split_surface({answer.lower, task.piece, task.interval});
    return kInfinity;
  }

  // Notes a surface point at a time; the search is hopeless when the motion cannot be proven free there.
  void look_at(const Piece& piece, const Interval& interval, double distance, double allowance) {
    if (distance >= result_.hi) return;
    const TrimRegion& trim = tree_.model().faces()[tree_.nodes()[piece.node].face].trim;
    if (!counts_as_surface(trim, piece.trimmed, piece.cell.radius, piece.box.u_mid(), piece.box.v_mid()))
      return;
    result_.hi = distance;
    result_.time = 0.5 * (interval.t0 + interval.t1);
    result_.s = piece.cell.c;
    if (distance < -options_.tolerance) result_.verdict = Verdict::gouge;
    hopeless_ = distance - allowance < -options_.tolerance;
  }

  void split_time(const Task& task) {
    if (intervals_[task.interval].half == 0) {
      const double t0 = intervals_[task.interval].t0, t1 = intervals_[task.interval].t1;
      const double middle = 0.5 * (t0 + t1);
      intervals_[task.interval].half = std::uint32_t(intervals_.size());
      add_interval(t0, middle);
      add_interval(middle, t1);
    }
    const std::uint32_t half = intervals_[task.interval].half;
    push({task.lower, task.piece, half});
    push({task.lower, task.piece, half + 1});
  }

  void split_surface(const Task& task) {
    const Piece piece = pieces_[task.piece];
    const CellTree::Node& node = tree_.nodes()[piece.node];
    if (!piece.deep && node.children > 0) {
      for (std::uint32_t i = 0; i < node.children; ++i) push_node(node.first_child + i, task);
      return;
    }
    const TrimRegion& trim = tree_.model().faces()[node.face].trim;
    const double third = quarter_third(piece.deep ? piece.third : node.third);
    for (int quarter = 0; quarter < kQuarters; ++quarter) {
      const ParamBox box = quarter_box(piece.box, quarter);
      const QuarterCover cover = quarter_cover(trim, piece.trimmed, box);
      if (!cover.kept) continue;
      push_piece({piece.node, true, cover.trimmed, box, third, taylor_cell(*node.patch, box, third)}, task);
    }
  }

  const CellTree& tree_;
  const Tool& tool_;
  ToolMotion motion_;
  const CertifyMotionOptions& options_;
  const Context& context_;
  double enough_;  // mm: bounds beyond this are not sharpened
  MotionCertificate result_;
  std::vector<Piece> pieces_;
  std::vector<Interval> intervals_;
  std::vector<Task> tasks_;  // a heap
  bool hopeless_ = false;
};

void check(const Motion& motion, std::size_t index) {
  const std::string which = ": motion " + std::to_string(index);
  const auto check_pose = [&](const ToolPose& pose, const char* tips, const char* axes) {
    require(pose.torus_center.allFinite(), tips + which + " must have finite numbers");
    require(std::abs(pose.axis.norm() - 1) < kUnitTolerance, axes + which + " must have a unit vector");
  };
  check_pose(motion.from, "tips", "axes");
  check_pose(motion.to, "tips_to", "axes_to");
  require(std::isfinite(motion.options.tolerance), "tolerance_mm" + which + " must be finite");
  require(std::isfinite(motion.options.axis_deviation) && motion.options.axis_deviation >= 0,
          "axis_deviation_deg" + which + " must not be negative");
}

}  // namespace

MotionCertificate certify_motion(const CellTree& tree,
                                 const Tool& tool,
                                 const ToolPose& from,
                                 const ToolPose& to,
                                 const CertifyMotionOptions& options,
                                 const Context& context) {
  const double turn = std::atan2(from.axis.cross(to.axis).norm(), from.axis.dot(to.axis));
  if (turn > kPi - kOppositeSlack) return {};
  return Search(tree, tool, from, to, options, context).run();
}

std::vector<MotionCertificate> certify_motions(const CellTree& tree,
                                               const Tool& tool,
                                               const std::vector<Motion>& motions,
                                               Context& context) {
  check_tool(tool);
  for (std::size_t i = 0; i < motions.size(); ++i) check(motions[i], i);
  std::vector<MotionCertificate> result(motions.size());
  context.start(motions.size());
  for_each_range(motions.size(), 1, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      result[i] = certify_motion(tree, tool, motions[i].from, motions[i].to, motions[i].options, context);
  });
  return result;
}

}  // namespace mpm
