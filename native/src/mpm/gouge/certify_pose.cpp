#include "mpm/gouge/certify_pose.h"

#include <algorithm>
#include <vector>

#include "mpm/contact/contact_zone.h"

namespace mpm {
namespace {

constexpr double kTrimResolution = 1e-6;  // mm
constexpr double kFinestCell = 1e-10;     // mm: smaller cells are all rounding
constexpr double kZoneCell =
    1.0 / 6;  // of the cutter's radius: cells from this size down may be near a contact
constexpr double kZoneGap = 1.0 / 1000;  // of the cutter's radius: how near
constexpr std::size_t kMaxZones = 8;
constexpr std::size_t kUsualStack = 256;

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
      : tree_(tree), tool_(tool), pose_(pose), bound_(tool, pose), options_(options) {}

  Certificate run() {
    result_.lo = options_.enough;
    stack_.reserve(kUsualStack);
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
    const double u = task.box.u_mid(), v = task.box.v_mid();
    if (!look_at(task, cell.radius, {node.face, u, v, cell.c, answer.center})) return false;
    if (in_zone(node, task)) return true;
    if (!task.trimmed && node.patch && cell.radius < kZoneCell * tool_.radius() &&
        std::abs(answer.center) < kZoneGap * tool_.radius() && zones_tried_ < kMaxZones) {
      if (!add_zone(node, task, u, v)) return false;
      if (in_zone(node, task)) return true;
    }
    if (cell.radius < kFinestCell) {
      result_.lo = std::min(result_.lo, answer.lower);
      return true;
    }
    split(task, node);
    return true;
  }

  // Notes a surface point; false when it is a violation and the search is to stop there.
  bool look_at(const Task& task, double cell_radius, const Witness& point) {
    if (point.distance >= result_.hi) return true;
    const TrimRegion& trim = tree_.model().faces()[point.face].trim;
    if (task.trimmed && cell_radius > kTrimResolution && !trim.contains(point.u, point.v)) return true;
    result_.hi = point.distance;
    result_.witness = point;
    if (point.distance >= -options_.sharpness || !options_.stop_at_violation) return true;
    result_.verdict = point.distance < -options_.tolerance ? Verdict::gouge : Verdict::undecided;
    result_.lo = -kInfinity;
    return false;
  }

  bool in_zone(const CellTree::Node& node, const Task& task) {
    for (const ContactZone& zone : zones_)
      if (zone.contains(node.patch, task.box)) {
        result_.lo = std::min(result_.lo, zone.lower);
        return true;
      }
    return false;
  }

  // Looks for the contact near (u, v) and the zone it proves; false when it is a violation that ends the
  // search.
  bool add_zone(const CellTree::Node& node, const Task& task, double u, double v) {
    for (const ContactZone& zone : zones_)
      if (zone.contains(node.patch, {u, u, v, v})) return true;
    ++zones_tried_;
    const PatchMinimum lowest = lowest_point(tool_, pose_, *node.patch, u, v);
    if (!tree_.model().faces()[node.face].trim.contains(lowest.u, lowest.v)) return true;
    if (!look_at(task, 0, {node.face, lowest.u, lowest.v, lowest.s, lowest.value})) return false;
    if (lowest.value < -options_.sharpness) return true;
    const auto zone = contact_zone(tool_, pose_, bound_, *node.patch, node.patch_third, lowest);
    if (zone && zone->lower >= -options_.sharpness) zones_.push_back(*zone);
    return true;
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
  const Tool& tool_;
  const ToolPose& pose_;
  ClearanceBound bound_;
  const CertifyOptions& options_;
  Certificate result_;
  std::vector<Task> stack_;
  std::vector<ContactZone> zones_;
  std::size_t zones_tried_ = 0;
};

}  // namespace

Certificate certify_pose(const CellTree& tree,
                         const Tool& tool,
                         const ToolPose& pose,
                         const CertifyOptions& options) {
  return Search(tree, tool, pose, options).run();
}

}  // namespace mpm
