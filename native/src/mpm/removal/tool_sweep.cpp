#include "mpm/removal/tool_sweep.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"

namespace mpm {
namespace {

constexpr std::size_t kMostPieces = 32;  // bits of a mask

void add_disc(Box3& box, const StrokePose& pose, double z, double radius, double margin) {
  const Vec3 spread =
      radius * (Vec3::Ones() - pose.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt() + Vec3::Constant(margin);
  const Vec3 c = pose.center + z * pose.axis;
  box.extend(Vec3(c - spread));
  box.extend(Vec3(c + spread));
}

}  // namespace

ToolSweep::ToolSweep(const Tool& tool, const SweptPath& path)
    : tool_(tool), ring_{tool.major_radius, tool.minor_radius} {
  check_tool(tool);
  check_swept_path(path);
  visit_pieces(tool, [&](double r0, double r1, double z0, double z1) { cones_.push_back({r0, r1, z0, z1}); });
  require(cones_.size() < kMostPieces, "tool: too many segments");
  bottoms_ = {-tool.minor_radius};
  for (const ConeShape& cone : cones_) bottoms_.push_back(cone.z0);
  strokes_ = make_strokes(tool, path);
  std::vector<Box3> whole;
  const double reach = tool.length() + tool.reach();
  for (const Stroke& s : strokes_) {
    sagitta_.push_back(s.sagitta(reach));
    add_boxes(s);
    whole.emplace_back();
    for (std::size_t k = 0; k <= cones_.size(); ++k) whole.back().extend(boxes_[boxes_.size() - 1 - k]);
  }
  tree_ = BoxTree(whole);
}

// Every point of a piece moves on an arc that leaves its chord by at most lever angle^2 / 8.
void ToolSweep::add_boxes(const Stroke& stroke) {
  const double bow = stroke.angle * stroke.angle / 8;
  Box3 ring;
  for (const StrokePose& pose : stroke.ends)
    add_disc(ring, pose, 0, ring_.major, ring_.minor + bow * (ring_.major + 2 * ring_.minor));
  boxes_.push_back(ring);
  for (const ConeShape& cone : cones_) {
    Box3 box;
    for (const StrokePose& pose : stroke.ends) {
      add_disc(box, pose, cone.z0, cone.r0, bow * (std::abs(cone.z0) + ring_.minor + cone.r0));
      add_disc(box, pose, cone.z1, cone.r1, bow * (std::abs(cone.z1) + ring_.minor + cone.r1));
    }
    boxes_.push_back(box);
  }
}

void ToolSweep::strokes_near(const Box3& box, std::vector<std::uint32_t>& result) const {
  result.clear();
  tree_.visit(box, [&](std::uint32_t i) { result.push_back(i); });
  std::sort(result.begin(), result.end());
}

std::uint32_t ToolSweep::pieces_near(std::uint32_t stroke, const Box3& box) const {
  std::uint32_t mask = 0;
  const std::size_t pieces = cones_.size() + 1;
  for (std::size_t k = 0; k < pieces; ++k) {
    const Box3& piece = boxes_[stroke * pieces + k];
    const Box3 common{piece.lo.cwiseMax(box.lo), piece.hi.cwiseMin(box.hi)};
    if (!common.empty() && highest(stroke, common) >= bottoms_[k]) mask |= std::uint32_t(1) << k;
  }
  return mask;
}

// No point of the box is higher above the torus centre, along the axis, at any time of the stroke.
double ToolSweep::highest(std::uint32_t stroke, const Box3& box) const {
  const Vec3 center = box.center(), half = 0.5 * (box.hi - box.lo);
  double height = -kInfinity;
  for (const StrokePose& pose : strokes_[stroke].ends)
    height = std::max(height, (center - pose.center).dot(pose.axis) + half.dot(pose.axis.cwiseAbs()));
  return height + sagitta_[stroke];
}

double ToolSweep::distance(std::uint32_t stroke, const Vec3& point) const {
  const StrokePose& pose = strokes_[stroke].middle;
  return signed_distance(tool_, ToolPose{pose.center, pose.axis}, point);
}

Spans ToolSweep::piece_spans(std::uint32_t stroke,
                             std::size_t piece,
                             const Ray& ray,
                             const Span& span) const {
  const Span part = clipped(ray, span, boxes_[stroke * (cones_.size() + 1) + piece]);
  if (part.from > part.to) return {};
  const Stroke& s = strokes_[stroke];
  return piece == 0 ? swept_spans(ring_, s, ray, part.from, part.to)
                    : swept_spans(cones_[piece - 1], s, ray, part.from, part.to);
}

std::uint32_t ToolSweep::pieces_not_above(
    std::uint32_t stroke, std::uint32_t pieces, const Ray& ray, double lo, double hi) const {
  double height = -kInfinity;
  for (const StrokePose& pose : strokes_[stroke].ends) {
    const double start = (ray.origin - pose.center).dot(pose.axis), rise = ray.direction.dot(pose.axis);
    height = std::max(height, start + std::max(lo * rise, hi * rise));
  }
  height += sagitta_[stroke];
  for (std::size_t k = 0; k < bottoms_.size(); ++k)
    if (height < bottoms_[k]) pieces &= ~(std::uint32_t(1) << k);
  return pieces;
}

}  // namespace mpm
