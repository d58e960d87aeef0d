#include "mpm/surface/box_tree.h"

#include <algorithm>
#include <numeric>

namespace mpm {
namespace {
constexpr std::uint32_t kLeafSize = 4;
}

BoxTree::BoxTree(const std::vector<Box3>& boxes) {
  if (boxes.empty()) return;
  items_.resize(boxes.size());
  std::iota(items_.begin(), items_.end(), 0u);
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  build(0, boxes, 0, std::uint32_t(boxes.size()));
  item_boxes_.reserve(boxes.size());
  for (std::uint32_t i : items_) item_boxes_.push_back(boxes[i]);
  bounds_ = nodes_[0].box;
}

void BoxTree::build(std::uint32_t node,
                    const std::vector<Box3>& boxes,
                    std::uint32_t begin,
                    std::uint32_t end) {
  Box3 box, centers;
  for (std::uint32_t i = begin; i < end; ++i) {
    box.extend(boxes[items_[i]]);
    centers.extend(boxes[items_[i]].center());
  }
  nodes_[node].box = box;
  if (end - begin <= kLeafSize) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  int axis = 0;
  (centers.hi - centers.lo).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  // Ties are broken by index, so the tree does not depend on the library's nth_element.
  std::nth_element(
      items_.begin() + begin, items_.begin() + middle, items_.begin() + end, [&](auto a, auto b) {
        const double ca = boxes[a].center()[axis], cb = boxes[b].center()[axis];
        return ca != cb ? ca < cb : a < b;
      });
  const std::uint32_t child = std::uint32_t(nodes_.size());
  nodes_[node].first = child;
  nodes_.emplace_back();
  nodes_.emplace_back();
  build(child, boxes, begin, middle);
  build(child + 1, boxes, middle, end);
}

}  // namespace mpm
