#include "mpm/surface/trim_region.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"

namespace mpm {
namespace {

constexpr std::size_t kMaxRows = 1024;

bool segment_meets_box(const Vec2& a, const Vec2& b, const ParamBox& box) {
  if (std::max(a.x(), b.x()) < box.u0 || std::min(a.x(), b.x()) > box.u1) return false;
  if (std::max(a.y(), b.y()) < box.v0 || std::min(a.y(), b.y()) > box.v1) return false;
  // Separated by the segment's own line when all corners lie strictly on one side.
  const Vec2 d = b - a;
  int positive = 0, negative = 0;
  for (double u : {box.u0, box.u1})
    for (double v : {box.v0, box.v1}) {
      const double side = d.x() * (v - a.y()) - d.y() * (u - a.x());
      positive += side > 0;
      negative += side < 0;
    }
  return positive < 4 && negative < 4;
}

}  // namespace

TrimRegion::TrimRegion(std::vector<std::vector<Vec2>> loops) : loops_(std::move(loops)) {
  if (loops_.empty()) return;
  std::size_t count = 0;
  v_lo_ = kInfinity, v_hi_ = -kInfinity;
  for (const auto& loop : loops_) {
    require(loop.size() >= 3, "trim loop: needs at least 3 points");
    count += loop.size();
    for (const Vec2& p : loop) {
      require(p.allFinite(), "trim loop: points must be finite");
      v_lo_ = std::min(v_lo_, p.y());
      v_hi_ = std::max(v_hi_, p.y());
    }
  }
  require(v_lo_ < v_hi_, "trim loop: encloses nothing");
  rows_.resize(std::clamp<std::size_t>(count / 4, 1, kMaxRows));
  for (const auto& loop : loops_)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Edge edge{loop[i], loop[(i + 1) % loop.size()]};
      const std::size_t last = row(std::max(edge.a.y(), edge.b.y()));
      for (std::size_t r = row(std::min(edge.a.y(), edge.b.y())); r <= last; ++r) rows_[r].push_back(edge);
    }
}

std::size_t TrimRegion::row(double v) const {
  const double at = (v - v_lo_) / (v_hi_ - v_lo_) * double(rows_.size());
  return std::size_t(std::clamp(at, 0.0, double(rows_.size() - 1)));
}

bool TrimRegion::contains(double u, double v) const {
  if (everything()) return true;
  if (v < v_lo_ || v > v_hi_) return false;
  bool inside = false;
  for (const Edge& e : rows_[row(v)]) {
    if (e.a.y() == v && e.b.y() == v) {  // a level side never crosses the ray, but points on it are inside
      if (std::min(e.a.x(), e.b.x()) <= u && u <= std::max(e.a.x(), e.b.x())) return true;
      continue;
    }
    if ((e.a.y() > v) == (e.b.y() > v)) {  // half-open: a vertex counts once
      if ((e.a.y() == v && e.a.x() == u) || (e.b.y() == v && e.b.x() == u)) return true;
      continue;
    }
    const double crossing = e.a.x() + (v - e.a.y()) / (e.b.y() - e.a.y()) * (e.b.x() - e.a.x());
    if (u == crossing) return true;
    if (u < crossing) inside = !inside;
  }
  return inside;
}

// Liang and Barsky: the range of the side's parameter that each of the four half-planes leaves.
std::optional<TrimRegion::Edge> TrimRegion::clipped(const Edge& edge, const ParamBox& box) {
  const Vec2 d = edge.b - edge.a;
  double enter = 0.0, leave = 1.0;
  const auto keep = [&](double start, double slope, double lo, double hi) {
    if (slope == 0.0) return lo <= start && start <= hi;
    const double at_lo = (lo - start) / slope, at_hi = (hi - start) / slope;
    enter = std::max(enter, std::min(at_lo, at_hi));
    leave = std::min(leave, std::max(at_lo, at_hi));
    return enter <= leave;
  };
  if (!keep(edge.a.x(), d.x(), box.u0, box.u1) || !keep(edge.a.y(), d.y(), box.v0, box.v1))
    return std::nullopt;
  return Edge{edge.a + enter * d, leave < 1.0 ? Vec2(edge.a + leave * d) : edge.b};
}

TrimRegion::Cover TrimRegion::cover(const ParamBox& box) const {
  if (everything()) return Cover::inside;
  if (box.v1 < v_lo_ || box.v0 > v_hi_) return Cover::outside;
  const std::size_t last = row(box.v1);
  for (std::size_t r = row(box.v0); r <= last; ++r)
    for (const Edge& e : rows_[r])
      if (segment_meets_box(e.a, e.b, box)) return Cover::crossing;
  return contains(box.u_mid(), box.v_mid()) ? Cover::inside : Cover::outside;
}

}  // namespace mpm
