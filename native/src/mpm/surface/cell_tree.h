// A quadtree of quadratic cells over every face: bounds at every scale, from the whole face to a fraction of
// the tool.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/surface/quadratic_cell.h"
#include "mpm/surface/surface_model.h"

namespace mpm {

// Threads: any number may share one.
class CellTree {
 public:
  struct Node {
    ParamBox box;
    std::uint32_t first_child = 0;  // children are consecutive
    std::uint32_t batch = 0;        // of batches(): the children's cells, in their order
    std::uint8_t children = 0;      // 0: a leaf
    bool trimmed = false;           // a trim boundary crosses it: part of it may not belong to the face
    std::uint32_t face = 0;
    // Of a leaf only.
    const BezierPatch* patch = nullptr;
    double third = 0;  // third_derivative_bound over the leaf
    QuadraticCell cell;
  };

  // Leaves are about `leaf_size` mm or less, or as small as `max_leaves` allows (at least one a Bézier
  // patch).
  //
  // Requires: the model outlives the tree; leaf_size > 0.
  CellTree(const SurfaceModel& model, double leaf_size, std::size_t max_leaves = 200'000);

  const SurfaceModel& model() const { return model_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  // One a face that is not wholly trimmed away.
  const std::vector<std::uint32_t>& roots() const { return roots_; }

  // Cells in fours; lanes that no cell fills repeat one that does.
  const std::vector<CellBatch>& batches() const { return batches_; }
  const std::vector<CellBatch>& root_batches() const { return root_batches_; }  // roots() in fours

 private:
  void add_face(std::uint32_t face, double leaf_size);

  const SurfaceModel& model_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> roots_;
  std::vector<CellBatch> batches_, root_batches_;
};

}  // namespace mpm
