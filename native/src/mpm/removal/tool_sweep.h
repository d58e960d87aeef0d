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
  // Bit k: piece k of the tool (0: ring) may meet `box` during the stroke.
  std::uint32_t pieces_near(std::uint32_t stroke, const Box3& box) const;

  // Is the span of the ray below the tip plane during the whole stroke? Then nothing of the tool meets it.
  bool below(std::uint32_t stroke, const Ray& ray, double lo, double hi) const;

  // Calls visit(from, to) for the parts of lo <= t <= hi that the stroke sweeps, piece by piece: they may
  // overlap.
  template <class Visit>
  void visit_spans(std::uint32_t stroke,
                   std::uint32_t pieces,
                   const Ray& ray,
                   double lo,
                   double hi,
                   const Visit& visit) const {
    const Stroke& s = strokes_[stroke];
    const auto pass = [&](const Spans& spans) {
      for (int i = 0; i < spans.count; ++i)
        visit(spans.span[std::size_t(i)].from, spans.span[std::size_t(i)].to);
    };
    if (pieces & 1) pass(swept_spans(ring_, s, tool_.minor_radius, ray, lo, hi));
    for (std::size_t k = 0; k < cones_.size(); ++k)
      if (pieces >> (k + 1) & 1) pass(swept_spans(cones_[k], s, tool_.minor_radius, ray, lo, hi));
  }

 private:
  void add_boxes(const Stroke& stroke);

  Tool tool_;
  RingShape ring_;
  std::vector<ConeShape> cones_;
  std::vector<Stroke> strokes_;
  std::vector<double> sagitta_;  // of each stroke, over the whole tool
  std::vector<Box3> boxes_;      // pieces() a stroke
  BoxTree tree_;
};

}  // namespace mpm
