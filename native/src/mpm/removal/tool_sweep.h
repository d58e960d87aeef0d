// Everything that a tool sweeps on its way, ready to be asked ray by ray.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/removal/swept_piece.h"
#include "mpm/surface/box_tree.h"

namespace mpm {

class ToolSweep {
 public:
  // Throws std::invalid_argument as check_tool and check_swept_path do.
  ToolSweep(const Tool& tool, const SweptPath& path);

  const std::vector<Stroke>& strokes() const { return strokes_; }
  const Tool& tool() const { return tool_; }

  // Numbers of the strokes whose box meets `box`, in a fixed order.
  void strokes_near(const Box3& box, std::vector<std::uint32_t>& result) const;
  // Bit k: piece k of the tool (0: ring) may meet `box` during the stroke: their boxes meet, and what they
  // have in common is not all below the piece.
  std::uint32_t pieces_near(std::uint32_t stroke, const Box3& box) const;

  // The pieces that the span of the ray is not below of during the whole stroke, out of `pieces`.
  std::uint32_t pieces_not_above(
      std::uint32_t stroke, std::uint32_t pieces, const Ray& ray, double lo, double hi) const;

  // Signed distance of a point from the tool half way through the stroke.
  double distance(std::uint32_t stroke, const Vec3& point) const;

  // swept_piece.h: clear_below of the ring.
  bool ring_clear_below(std::uint32_t stroke, const Ray& ray, double hi, const Neighbourhood& near) const {
    return clear_below(ring_, strokes_[stroke], ray, hi, near);
  }

  // Calls visit(from, to) for the parts of lo <= t <= hi that the stroke sweeps, piece by piece: they may
  // overlap. `pieces`: a bit each, as pieces_near gives them. The pieces that follow are left out when one
  // sweeps the whole.
  template <class Visit>
  void visit_spans(std::uint32_t stroke,
                   std::uint32_t pieces,
                   const Ray& ray,
                   double lo,
                   double hi,
                   const Visit& visit) const {
    for (std::size_t k = 0; k <= cones_.size(); ++k)
      if (pieces >> k & 1) {
        const Spans spans = piece_spans(stroke, k, ray, {lo, hi});
        for (std::size_t i = 0; i < spans.count; ++i) {
          visit(spans.span[i].from, spans.span[i].to);
          if (spans.span[i].from <= lo && spans.span[i].to >= hi) return;
        }
      }
  }

 private:
  void add_boxes(const Stroke& stroke);
  double highest(std::uint32_t stroke, const Box3& box) const;
  Spans piece_spans(std::uint32_t stroke, std::size_t piece, const Ray& ray, const Span& span) const;

  Tool tool_;
  RingShape ring_;
  std::vector<ConeShape> cones_;
  std::vector<double> bottoms_;  // of each piece, above the torus centre
  std::vector<Stroke> strokes_;
  std::vector<double> sagitta_;  // of each stroke, over the whole tool
  std::vector<Box3> boxes_;      // pieces() a stroke
  BoxTree tree_;
};

}  // namespace mpm
