// The part of a face's parameter plane that belongs to the face.
#pragma once

#include <optional>
#include <vector>

#include "mpm/base/types.h"

namespace mpm {

// Closed polygons in (u, v) under the even-odd rule; no polygon: the whole plane (an untrimmed face). The
// polygons approximate the exact trimming curves to the chord error with which they were sampled.
//
// Threads: any number may ask one.
class TrimRegion {
 public:
  TrimRegion() = default;
  // The last point of a loop is not repeated.
  //
  // Fails: std::invalid_argument for a loop of fewer than 3 points, a point that is not finite, and loops
  //   that all lie on one line v = const.
  explicit TrimRegion(std::vector<std::vector<Vec2>> loops);

  bool everything() const { return loops_.empty(); }
  const std::vector<std::vector<Vec2>>& loops() const { return loops_; }
  // Points on a polygon count as inside.
  bool contains(double u, double v) const;

  enum class Cover { outside, inside, crossing };
  // How the rectangle lies: wholly outside, wholly inside, or crossed by (or too near to tell from) a
  // boundary.
  Cover cover(const ParamBox& box) const;

  // Calls visit(a, b) with the part of every side that lies in the closed rectangle; some may come twice.
  template <class Visit>
  void visit_sides(const ParamBox& box, const Visit& visit) const;

 private:
  struct Edge {
    Vec2 a, b;
  };
  static std::optional<Edge> clipped(const Edge& edge, const ParamBox& box);
  std::size_t row(double v) const;

  std::vector<std::vector<Vec2>> loops_;
  double v_lo_ = 0, v_hi_ = 0;
  std::vector<std::vector<Edge>> rows_;  // the edges that meet each of equal strips in v
};

template <class Visit>
void TrimRegion::visit_sides(const ParamBox& box, const Visit& visit) const {
  if (everything() || box.v1 < v_lo_ || box.v0 > v_hi_) return;
  const std::size_t last = row(box.v1);
  for (std::size_t r = row(box.v0); r <= last; ++r)
    for (const Edge& e : rows_[r])
      if (const std::optional<Edge> part = clipped(e, box)) visit(part->a, part->b);
}

}  // namespace mpm
