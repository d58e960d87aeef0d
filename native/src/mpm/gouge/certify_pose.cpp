#include "mpm/gouge/certify_pose.h"

#include <algorithm>
#include <vector>

#include "mpm/contact/clearance_bound.h"

namespace mpm {
namespace {

constexpr double kTrimResolution = 1e-6;  // mm
constexpr double kFinestCell = 1e-10;     // mm: smaller cells are all rounding

struct Task {
  std::uint32_t node;
  bool deep;  // below a leaf: `box` and `third` describe the cell
  bool trimmed;
  ParamBox box;
  double third;
};

class Search {
 public:
  Search(const CellTree& tree, const Tool& tool, const ToolPose& pose, const CertifyOptions& options)
      : tree_(tree), bound_(tool, pose), options_(options) {}

  Certificate run() {
    result_.lo = options_.enough;
    for (std::uint32_t root : tree_.roots()) push(root);
    while (!stack_.empty()) {
      if (result_.cells >= options_.budget) return give_up();
      const Task task = stack_.back();
      stack_.pop_back();
      if (!settle(task)) return result_;
    }
    result_.verdict = result_.hi < -options_.tolerance    ? Verdict::gouge
                      : result_.lo >= -options_.tolerance ? Verdict::free
                                                          : Verdict::undecided;
    return result_;
  }

 private:
  void push(std::uint32_t node) {
    const CellTree::Node& n = tree_.nodes()[node];
    stack_.push_back({node, false, n.trimmed, n.box, 0});
  }

  // False ends the search: a violation was found and nothing more is asked.
  bool settle(const Task& task) {
    const CellTree::Node& node = tree_.nodes()[task.node];
    ++result_.cells;
    const QuadraticCell deep = task.deep ? taylor_cell(*node.patch, task.box, task.third) : QuadraticCell{};
    const QuadraticCell& cell = task.deep ? deep : node.cell;
    const ClearanceBound::Answer answer = bound_(cell, options_.enough);
    const double wanted = result_.cells <= options_.sharp_budget ? options_.sharpness : options_.tolerance;
    if (answer.lower >= -wanted) {
      result_.lo = std::min(result_.lo, answer.lower);
      return true;
    }
    if (!look_at_center(task, cell, answer.center)) return false;
    if (cell.radius < kFinestCell) {
      result_.lo = std::min(result_.lo, answer.lower);
      return true;
    }
    split(task, node);
    return true;
  }

  bool look_at_center(const Task& task, const QuadraticCell& cell, double distance) {
    const double u = task.box.u_mid(), v = task.box.v_mid();
    const std::uint32_t face = tree_.nodes()[task.node].face;
    if (distance >= result_.hi) return true;
    if (task.trimmed && cell.radius > kTrimResolution && !tree_.model().faces()[face].trim.contains(u, v))
      return true;
    result_.hi = distance;
    result_.witness = {face, u, v, cell.c, distance};
    if (distance >= -options_.sharpness || !options_.stop_at_violation) return true;
    result_.verdict = distance < -options_.tolerance ? Verdict::gouge : Verdict::undecided;
    result_.lo = -kInfinity;
    return false;
  }

  void split(const Task& task, const CellTree::Node& node) {
    if (!task.deep && node.children > 0) {
      for (std::uint32_t i = 0; i < node.children; ++i) push(node.first_child + i);
      return;
    }
    const double third = (task.deep ? task.third : node.third) / 8;
    const double um = task.box.u_mid(), vm = task.box.v_mid();
    for (const ParamBox& box : {ParamBox{task.box.u0, um, task.box.v0, vm},
                                ParamBox{um, task.box.u1, task.box.v0, vm},
                                ParamBox{task.box.u0, um, vm, task.box.v1},
                                ParamBox{um, task.box.u1, vm, task.box.v1}}) {
      bool trimmed = task.trimmed;
      if (trimmed) {
        const TrimRegion::Cover cover = tree_.model().faces()[node.face].trim.cover(box);
        if (cover == TrimRegion::Cover::outside) continue;
        trimmed = cover == TrimRegion::Cover::crossing;
      }
      stack_.push_back({task.node, true, trimmed, box, third});
    }
  }

  Certificate give_up() {
    result_.verdict = result_.hi < -options_.tolerance ? Verdict::gouge : Verdict::undecided;
    result_.lo = -kInfinity;
    return result_;
  }

  const CellTree& tree_;
  ClearanceBound bound_;
  const CertifyOptions& options_;
  Certificate result_;
  std::vector<Task> stack_;
};

}  // namespace

Certificate certify_pose(const CellTree& tree,
                         const Tool& tool,
                         const ToolPose& pose,
                         const CertifyOptions& options) {
  return Search(tree, tool, pose, options).run();
}

}  // namespace mpm
