// A bounding-volume hierarchy over boxes: which of them meet a given one?
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/base/types.h"

namespace mpm {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box3>& boxes);

  const Box3& bounds() const { return bounds_; }

  // Calls visit(index) for every box that `accept` (a predicate on Box3, true for a box whenever it is true
  // for a part of it) admits, in a fixed order.
  template <class Accept, class Visit>
  void visit(const Accept& accept, const Visit& visit_item) const {
    if (!nodes_.empty()) visit_node(0, accept, visit_item);
  }
  template <class Visit>
  void visit(const Box3& query, const Visit& visit_item) const {
    visit([&](const Box3& box) { return box.meets(query); }, visit_item);
  }

 private:
  struct Node {
    Box3 box;
    std::uint32_t first = 0, count = 0;  // leaf: items_[first .. first+count); inner: children first, first+1
  };
  void build(std::uint32_t node, const std::vector<Box3>& boxes, std::uint32_t begin, std::uint32_t end);

  template <class Accept, class Visit>
  void visit_node(std::uint32_t index, const Accept& accept, const Visit& visit_item) const {
    const Node& node = nodes_[index];
    if (!accept(node.box)) return;
    if (node.count == 0) {
      visit_node(node.first, accept, visit_item);
      visit_node(node.first + 1, accept, visit_item);
      return;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (accept(item_boxes_[i])) visit_item(items_[i]);
  }

  Box3 bounds_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
  std::vector<Box3> item_boxes_;
};

}  // namespace mpm
