// Everything that a tool sweeps on its way, ready to be asked ray by ray.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/removal/ring_cut.h"
#include "mpm/removal/swept_piece.h"
#include "mpm/surface/box_tree.h"

namespace mpm {

// Threads: any number may ask one.
class ToolSweep {
 public:
  // Fails: std::invalid_argument as check_tool and check_swept_path do, and for a tool of more pieces than a
  //   mask has bits.
  ToolSweep(const Tool& tool, const SweptPath& path);

  const std::vector<Stroke>& strokes() const { return strokes_; }
  const Tool& tool() const { return tool_; }

  // Masks of pieces, a bit each: 1 for the ring; those that reach below the torus centre; all others.
  static constexpr std::uint32_t kRing = 1;
  std::uint32_t low_pieces() const { return low_pieces_; }
  std::uint32_t high_pieces() const { return ~low_pieces_; }

  // Numbers of the strokes of which some pieces meet `box`, in a fixed order: any, low ones, high ones.
  void strokes_near(const Box3& box, std::vector<std::uint32_t>& result) const;
  void low_strokes_near(const Box3& box, std::vector<std::uint32_t>& result) const;
  void high_strokes_near(const Box3& box, std::vector<std::uint32_t>& result) const;
  // Of the strokes whose low pieces meet `box` those that do not meet `known`.
  void low_strokes_near(const Box3& box, const Box3& known, std::vector<std::uint32_t>& result) const;
  // Those out of `pieces` that may meet `box` during the stroke: their boxes meet, and what they have in
  // common is not all below the piece.
  std::uint32_t pieces_near(std::uint32_t stroke, std::uint32_t pieces, const Box3& box) const;

  // The pieces that the span of the ray is not below of during the whole stroke, out of `pieces`.
  std::uint32_t pieces_not_above(
      std::uint32_t stroke, std::uint32_t pieces, const Ray& ray, double lo, double hi) const;

  // A measure of how deep a point lies in the tool half way through the stroke, the less the deeper: the
  // signed distance from its outline (mm) without shank and holder.
  double depth(std::uint32_t stroke, const Vec3& point) const;

  // ring_cut.h: the ring of the stroke.
  const RingStroke& ring_stroke(std::uint32_t stroke) const { return ring_strokes_[stroke]; }

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
  std::vector<Box3> common_boxes(std::uint32_t pieces) const;
  double highest(std::uint32_t stroke, const Box3& box) const;
  Spans piece_spans(std::uint32_t stroke, std::size_t piece, const Ray& ray, const Span& span) const;

  Tool tool_;
  RingShape ring_;
  std::vector<ConeShape> cones_;
  std::vector<double> bottoms_;  // of each piece, above the torus centre
  std::vector<Stroke> strokes_;
  std::vector<RingStroke> ring_strokes_;
  std::vector<double> sagitta_;  // of each stroke, over the whole tool
  std::vector<Box3> boxes_;      // one a piece of each stroke
  std::vector<Box3> low_boxes_;  // of each stroke's low pieces
  BoxTree low_tree_, high_tree_;
  std::uint32_t low_pieces_ = 0;
};

}  // namespace mpm
