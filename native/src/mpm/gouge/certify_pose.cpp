#include "mpm/gouge/certify_pose.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "mpm/contact/clearance_bound.h"
#include "mpm/contact/lowest_point.h"
#include "mpm/gouge/quarters.h"

namespace mpm {
namespace {

static_assert(kLanes == kQuarters);  // the quarters of a cell are one batch
// Of the cutter's radius: cells from this size down, with a centre this near, are searched for a contact.
constexpr double kContactCell = 1.0 / 8, kContactGap = 1.0 / 1000;
constexpr std::size_t kMaxContacts = 8;
constexpr double kApart = 12;    // cell radii from a known contact that another one may have
constexpr double kOwn = 2;       // cell radii from a known contact in which it is the cell's own
constexpr double kDeeper = 1.1;  // after a violation, points less than this much deeper are not looked for
// Below a leaf its quadratic serves as long as its error is this part of the gap; then Taylor's formula takes
// over.
constexpr double kModelPart = 1.0 / 256;

// Up to four cells that are to be looked at together.
struct Group {
  enum class Kind : std::uint8_t { roots, children, quarters };
  Kind kind;
  std::uint8_t cells;        // lanes in use, a bit each
  std::uint8_t trimmed = 0;  // quarters: lanes that a trim boundary crosses
  std::uint32_t node;        // roots: the first one's place in roots(); else the parent, quarters: the leaf
  std::uint32_t batch;       // of the tree's root batches, its batches, or the arena
  ParamBox box{};            // quarters: of the four together
  double third = 0;          // quarters: third derivative bound over each
};

std::uint8_t first_lanes(std::size_t count) { return std::uint8_t((1u << count) - 1); }

// One cell that its bound did not settle.
struct Cell {
  const CellTree::Node& node;  // itself, or the leaf that it is part of
  std::uint32_t index;         // of the node
  bool quarter, trimmed;
  ParamBox box;
  double third;
  const Group& group;
  int lane;
  double lower, center;  // mm, of the whole body
  double a, b;           // where the ring's bound has a minimum inside; else NaN
  double radius, error;  // mm
};

// Kept from call to call for its memory only.
struct Workspace {
  std::vector<Group> stack;
  std::vector<CellBatch> arena;
  std::vector<Vec3> contacts;
};

class Search {
 public:
  Search(const CellTree& tree,
         const Tool& tool,
         const ToolPose& pose,
         const CertifyPoseOptions& options,
         Workspace& workspace)
      : tree_(tree),
        tool_(tool),
        pose_(pose),
        bound_(tool, pose),
        options_(options),
        stack_(workspace.stack),
        arena_(workspace.arena),
        contacts_(workspace.contacts) {}

  PoseCertificate run() {
    result_.lo = options_.enough;
    stack_.clear(), contacts_.clear();
    for (std::uint32_t i = 0; i < tree_.roots().size(); i += kLanes)
      stack_.push_back({Group::Kind::roots,
                        first_lanes(std::min<std::size_t>(kLanes, tree_.roots().size() - i)),
                        0,
                        i,
                        i / kLanes});
    while (!stack_.empty()) {
      if (result_.cells >= options_.budget) return give_up();
      const Group group = pop();
      // Whatever lies above it in the arena belonged to groups that are done: the stack is last in, first
      // out.
      if (group.kind == Group::Kind::quarters) arena_used_ = group.batch + 1;
      const bool alone = stack_.empty();
      const Group other = alone ? group : pop();
      const BoundAsk ask = what_to_ask();
      RingAnswer ring, other_ring;
      bound_.ring(cells_of(group), cells_of(other), ask, ring, other_ring);
      if (!settle(group, ask.proven, ring)) return result_;
      if (!alone && !settle(other, ask.proven, other_ring)) return result_;
    }
    result_.verdict = result_.hi < -options_.tolerance    ? Verdict::gouge
                      : result_.lo >= -options_.tolerance ? Verdict::free
                                                          : Verdict::undecided;
    return result_;
  }

 private:
  const CellBatch& cells_of(const Group& group) const {
    return group.kind == Group::Kind::roots      ? tree_.root_batches()[group.batch]
           : group.kind == Group::Kind::children ? tree_.batches()[group.batch]
                                                 : arena_[group.batch];
  }

  Group pop() {
    const Group group = stack_.back();
    stack_.pop_back();
    return group;
  }

  BoundAsk what_to_ask() const {
    // What is deeper than the deepest point known may be left open: that point is the answer.
    const double proven = std::min(-options_.tolerance, deep_enough_);
    const double searched =
        result_.cells <= options_.sharp_budget ? std::min(-options_.sharpness, deep_enough_) : proven;
    return {options_.enough, proven, searched};
  }

  // Bounds the cells of a group and goes on with those that stay open. False ends the search: a violation was
  // found and nothing more is asked.
  bool settle(const Group& group, double proven, const RingAnswer& ring) {
    result_.cells += std::uint64_t(std::popcount(group.cells));
    const unsigned settled = group.cells & ring.clear_of_pieces & ~ring.open;
    for (int lane = 0; lane < kLanes; ++lane)
      result_.lo = settled >> lane & 1 ? std::min(result_.lo, ring.lower[lane]) : result_.lo;
    for (unsigned left = group.cells & ~settled; left; left &= left - 1) {
      const int lane = std::countr_zero(left);
      double lower = ring.lower[lane], center = ring.center[lane];
      bool is_open = ring.open >> lane & 1;
      // What the ring does not prove is split whatever the rest of the body says; what it proves may be done
      // with, be it open for a search, and then the rest has to be proven too.
      if (lower >= proven && !(ring.clear_of_pieces >> lane & 1)) {
        const ClearanceBound::Answer rest = bound_.pieces(get_lane(cells_of(group), lane), options_.enough);
        lower = std::min(lower, rest.lower), center = std::min(center, rest.center);
        is_open |= lower < proven;
      }
      if (!is_open)
        result_.lo = std::min(result_.lo, lower);
      else if (!open(cell_of(group, lane, lower, center, ring)))
        return false;
    }
    return true;
  }

  Cell cell_of(const Group& group, int lane, double lower, double center, const RingAnswer& ring) const {
    const CellBatch& cells = cells_of(group);
    const bool quarter = group.kind == Group::Kind::quarters;
    const std::uint32_t index = quarter ? group.node
                                : group.kind == Group::Kind::roots
                                    ? tree_.roots()[group.node + std::uint32_t(lane)]
                                    : tree_.nodes()[group.node].first_child + std::uint32_t(lane);
    const CellTree::Node& node = tree_.nodes()[index];
    return {node,
            index,
            quarter,
            quarter ? bool(group.trimmed >> lane & 1) : node.trimmed,
            quarter ? quarter_box(group.box, lane) : node.box,
            quarter ? group.third : node.third,
            group,
            lane,
            lower,
            center,
            ring.a[lane],
            ring.b[lane],
            cells.radius[lane],
            cells.error[lane]};
  }

  // A cell that its bound did not settle: looks at its centre, looks for a contact in it, splits it.
  bool open(const Cell& cell) {
    if (!look_at_center(cell)) return false;
    if (may_hold_contact(cell)) {
      const double apart = to_nearest_contact(cell);
      const bool is_new = apart > kApart * cell.radius && contacts_.size() < kMaxContacts;
      if (is_new && !look_for_contact(cell)) return false;
      // What minimum it may have was searched, wherever that led.
      if ((is_new || apart < kOwn * cell.radius) && is_proven(cell)) return note(cell);
    }
    if (cell.radius < kFinestCell) return note(cell);
    split(cell);
    return true;
  }

  bool is_proven(const Cell& cell) const { return cell.lower >= -options_.tolerance; }

  // A cell that is done with.
  bool note(const Cell& cell) {
    result_.lo = std::min(result_.lo, cell.lower);
    return true;
  }

  bool may_hold_contact(const Cell& cell) const {
    return !cell.trimmed && cell.node.patch && downhill_from(cell) &&
           cell.radius < kContactCell * tool_.radius() &&
           std::abs(cell.center) < kContactGap * tool_.radius();
  }

  bool look_at_center(const Cell& cell) {
    // The centre of a quarter is only near the surface.
    const double at_least = cell.quarter ? cell.center - cell.error : cell.center;
    if (at_least >= result_.hi) return true;
    const double u = cell.box.u_mid(), v = cell.box.v_mid();
    if (!cell.quarter)
      return look_at(cell.trimmed, cell.radius, {cell.node.face, u, v, cell.node.cell.c, cell.center});
    const Vec3 s = cell.node.patch->point(u, v);
    return look_at(cell.trimmed, cell.radius, {cell.node.face, u, v, s, signed_distance(tool_, pose_, s)});
  }

  // Notes a surface point; false when it is a violation and the search is to stop there.
  bool look_at(bool trimmed, double cell_radius, const Witness& point) {
    if (point.distance >= result_.hi) return true;
    const TrimRegion& trim = tree_.model().faces()[point.face].trim;
    if (!counts_as_surface(trim, trimmed, cell_radius, point.u, point.v)) return true;
    result_.hi = point.distance;
    result_.witness = point;
    if (point.distance < -options_.sharpness) deep_enough_ = kDeeper * point.distance;
    if (point.distance >= -options_.sharpness || !options_.stop_at_violation) return true;
    result_.verdict = point.distance < -options_.tolerance ? Verdict::gouge : Verdict::undecided;
    result_.lo = -kInfinity;
    return false;
  }

  // mm, from the cell's centre
  double to_nearest_contact(const Cell& cell) const {
    const auto& at = cells_of(cell.group).term[CellBatch::center];
    const Vec3 center(at[0][cell.lane], at[1][cell.lane], at[2][cell.lane]);
    double least = kInfinity;
    for (const Vec3& contact : contacts_) least = std::min(least, (contact - center).norm());
    return least;
  }

  // Where to start downhill: where the cell's quadratic is least, or on the border of its patch, against
  // which the surface may come nearest with a slope.
  static std::optional<Vec2> downhill_from(const Cell& cell) {
    const ParamBox& box = cell.box;
    const double u = box.u_mid(), v = box.v_mid();
    if (cell.a == cell.a)
      return Vec2(u + cell.a * 0.5 * (box.u1 - box.u0), v + cell.b * 0.5 * (box.v1 - box.v0));
    const ParamBox& patch = cell.node.patch->box();
    const bool on_u = box.u0 <= patch.u0 || box.u1 >= patch.u1,
               on_v = box.v0 <= patch.v0 || box.v1 >= patch.v1;
    if (!on_u && !on_v) return std::nullopt;
    return Vec2(box.u0 <= patch.u0   ? box.u0
                : box.u1 >= patch.u1 ? box.u1
                                     : u,
                box.v0 <= patch.v0   ? box.v0
                : box.v1 >= patch.v1 ? box.v1
                                     : v);
  }

  // Goes downhill from where the cell's quadratic is least; false when it meets a violation that ends the
  // search.
  bool look_for_contact(const Cell& cell) {
    const Vec2 from = *downhill_from(cell);
    const PatchMinimum lowest =
        lowest_point(tool_, pose_, *cell.node.patch, from.x(), from.y(), -options_.sharpness);
    contacts_.push_back(lowest.s);
    if (!tree_.model().faces()[cell.node.face].trim.contains(lowest.u, lowest.v)) return true;
    return look_at(false, 0, {cell.node.face, lowest.u, lowest.v, lowest.s, lowest.value});
  }

  void split(const Cell& cell) {
    if (!cell.quarter && cell.node.children > 0) {
      stack_.push_back(
          {Group::Kind::children, first_lanes(cell.node.children), 0, cell.index, cell.node.batch});
      return;
    }
    Group group{Group::Kind::quarters, kAllLanes, 0, cell.index, 0, cell.box, quarter_third(cell.third)};
    if (cell.trimmed && !keep_inside(group, cell.node.face)) return;
    make_quarters(cell, group);
    stack_.push_back(group);
  }

  // Drops quarters outside the trim and marks those that it crosses; false when none is left.
  bool keep_inside(Group& group, std::uint32_t face) const {
    const TrimRegion& trim = tree_.model().faces()[face].trim;
    for (int lane = 0; lane < kQuarters; ++lane) {
      const QuarterCover cover = quarter_cover(trim, true, quarter_box(group.box, lane));
      if (!cover.kept) group.cells &= std::uint8_t(~(1 << lane));
      if (cover.trimmed) group.trimmed |= std::uint8_t(1 << lane);
    }
    return group.cells != 0;
  }

  void make_quarters(const Cell& cell, Group& group) {
    group.batch = arena_used_++;
    if (arena_used_ > arena_.size()) arena_.resize(2 * arena_used_);
    CellBatch& quarters = arena_[group.batch];
    if (cell.error <= kModelPart * std::max(std::abs(cell.center), options_.sharpness))
      bound_.quarter(cells_of(cell.group), cell.lane, quarters);
    else
      for (int lane = 0; lane < kLanes; ++lane)
        put_lane(quarters, lane, taylor_cell(*cell.node.patch, quarter_box(cell.box, lane), group.third));
  }

  PoseCertificate give_up() {
    result_.verdict = result_.hi < -options_.tolerance ? Verdict::gouge : Verdict::undecided;
    result_.lo = -kInfinity;
    return result_;
  }

  const CellTree& tree_;
  const Tool& tool_;
  const ToolPose& pose_;
  ClearanceBound bound_;
  const CertifyPoseOptions& options_;
  PoseCertificate result_;
  std::vector<Group>& stack_;
  std::vector<CellBatch>& arena_;
  std::uint32_t arena_used_ = 0;
  double deep_enough_ = kInfinity;  // mm
  // Points where the surface comes nearest to the ring, inside the tool or not.
  std::vector<Vec3>& contacts_;
};

}  // namespace

PoseCertificate certify_pose(const CellTree& tree,
                             const Tool& tool,
                             const ToolPose& pose,
                             const CertifyPoseOptions& options) {
  static thread_local Workspace workspace;
  return Search(tree, tool, pose, options, workspace).run();
}

}  // namespace mpm
