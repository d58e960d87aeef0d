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

void copy(const Vec3& from, double (&to)[3]) { std::copy_n(from.data(), 3, to); }

RingStroke ring_stroke_of(const RingShape& ring, const Stroke& stroke) {
  RingStroke result{};
  for (std::size_t k = 0; k < 2; ++k) {
    copy(stroke.ends[k].center, result.ends[k].center);
    copy(stroke.ends[k].axis, result.ends[k].axis);
    copy(stroke.ends[k].center_rate, result.ends[k].center_rate);
    copy(stroke.ends[k].axis_rate, result.ends[k].axis_rate);
  }
  copy(stroke.tip, result.tip), copy(stroke.travel, result.travel);
  copy(stroke.axis, result.axis), copy(stroke.side, result.side);
  result.angle = stroke.angle, result.length = stroke.length;
  result.major = ring.major, result.minor = ring.minor;
  return result;
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
  for (std::size_t k = 0; k < bottoms_.size(); ++k)
    if (bottoms_[k] < 0) low_pieces_ |= std::uint32_t(1) << k;
  const double reach = tool.length() + tool.reach();
  for (const Stroke& s : strokes_) {
    ring_strokes_.push_back(ring_stroke_of(ring_, s));
    sagitta_.push_back(s.sagitta(reach));
    add_boxes(s);
  }
  low_boxes_ = common_boxes(low_pieces());
  low_tree_ = BoxTree(low_boxes_), high_tree_ = BoxTree(common_boxes(high_pieces()));
}

// One box a stroke round some pieces.
std::vector<Box3> ToolSweep::common_boxes(std::uint32_t pieces) const {
  std::vector<Box3> result(strokes_.size());
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    if (pieces >> i % bottoms_.size() & 1) result[i / bottoms_.size()].extend(boxes_[i]);
  return result;
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
  std::vector<std::uint32_t> high;
  low_strokes_near(box, result);
  high_strokes_near(box, high);
  result.insert(result.end(), high.begin(), high.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
}

void ToolSweep::low_strokes_near(const Box3& box, std::vector<std::uint32_t>& result) const {
  result.clear();
  low_tree_.visit(box, [&](std::uint32_t i) { result.push_back(i); });
}

void ToolSweep::high_strokes_near(const Box3& box, std::vector<std::uint32_t>& result) const {
  result.clear();
  high_tree_.visit(box, [&](std::uint32_t i) { result.push_back(i); });
}

void ToolSweep::low_strokes_near(const Box3& box,
                                 const Box3& known,
                                 std::vector<std::uint32_t>& result) const {
  result.clear();
  low_tree_.visit(box, [&](std::uint32_t i) {
    if (!low_boxes_[i].meets(known)) result.push_back(i);
  });
}

std::uint32_t ToolSweep::pieces_near(std::uint32_t stroke, std::uint32_t pieces, const Box3& box) const {
  std::uint32_t mask = 0;
  const Box3* const boxes = &boxes_[stroke * bottoms_.size()];
  for (std::size_t k = 0; k < bottoms_.size(); ++k) {
    if (!(pieces >> k & 1)) continue;
    const Box3 common{boxes[k].lo.cwiseMax(box.lo), boxes[k].hi.cwiseMin(box.hi)};
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

double ToolSweep::depth(std::uint32_t stroke, const Vec3& point) const {
  const StrokePose& pose = strokes_[stroke].middle;
  const Vec3 u = point - pose.center;
  const double z = u.dot(pose.axis), r = std::sqrt(std::max(u.squaredNorm() - z * z, 0.0));
  const bool hollow = tool_.recess >= tool_.minor_radius;
  const double aside = hollow ? r - ring_.major : std::max(r - ring_.major, 0.0);
  return (z > 0 ? aside : hypotenuse(aside, z)) - ring_.minor;
}

Spans ToolSweep::piece_spans(std::uint32_t stroke,
                             std::size_t piece,
                             const Ray& ray,
                             const Span& span) const {
  const Span part = clipped(ray, span, boxes_[stroke * bottoms_.size() + piece]);
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
