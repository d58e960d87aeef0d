#include "mpm/footprint/raster.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/error.h"

namespace mpm {
namespace {

// A step that misses the far border by less than this part of itself is taken to reach it.
constexpr double kStepSlack = 1e-9;

std::size_t stations(double width, double step) {
  const double steps = std::ceil(width / step - kStepSlack);
  require(steps < double(kMaxPositions), "steps: more than " + std::to_string(kMaxPositions) + " positions");
  return std::size_t(std::max(steps, 0.0)) + 1;
}

// What pi's rounding leaves of cos and sin where they should be zero stays below this.
constexpr double kDust = 1e-15;

// cos and sin of multiples of 90 degrees come out exactly.
double without_dust(double x) { return std::abs(x) < kDust ? 0.0 : x; }

double station(std::size_t i, double width, double step) { return std::min(double(i) * step, width); }

void check_step(double step, const char* name) {
  require(std::isfinite(step) && step > 0, std::string(name) + " must be a positive number of mm");
}

}  // namespace

Footprint raster(const Vec2& lo, const Vec2& hi, const RasterOptions& options) {
  check_step(options.side_step, "side_step_mm");
  check_step(options.forward_step, "forward_step_mm");
  require(std::isfinite(options.direction), "direction_deg must be a finite angle");
  require(std::isfinite(options.margin), "margin_mm must be a finite length");
  require(lo.allFinite() && hi.allFinite() && lo.x() <= hi.x() && lo.y() <= hi.y(),
          "footprint: empty region");

  const Vec2 feed(without_dust(std::cos(options.direction)), without_dust(std::sin(options.direction)));
  const Vec2 side(feed.y(), -feed.x());  // to the right of the feed
  // The smallest rectangle turned with the feed direction that holds the region.
  double side_lo = kInfinity, side_hi = -kInfinity, feed_lo = kInfinity, feed_hi = -kInfinity;
  for (double x : {lo.x(), hi.x()})
    for (double y : {lo.y(), hi.y()}) {
      const double a = side.dot(Vec2(x, y)), b = feed.dot(Vec2(x, y));
      side_lo = std::min(side_lo, a), side_hi = std::max(side_hi, a);
      feed_lo = std::min(feed_lo, b), feed_hi = std::max(feed_hi, b);
    }
  side_lo -= options.margin, side_hi += options.margin, feed_lo -= options.margin, feed_hi += options.margin;
  require(side_lo <= side_hi && feed_lo <= feed_hi, "margin_mm: takes off the whole region");

  const double width = side_hi - side_lo, depth = feed_hi - feed_lo;
  const std::size_t passes = stations(width, options.side_step),
                    per_pass = stations(depth, options.forward_step);
  require(double(passes) * double(per_pass) <= double(kMaxPositions),
          "steps: give " + std::to_string(passes) + " passes of " + std::to_string(per_pass) +
              " points, more than " + std::to_string(kMaxPositions) + " positions");
  Footprint footprint;
  footprint.points.reserve(passes * per_pass);
  footprint.pass.reserve(passes * per_pass);
  for (std::size_t i = 0; i < passes; ++i)
    for (std::size_t j = 0; j < per_pass; ++j) {
      const std::size_t k = options.zigzag && i % 2 == 1 ? per_pass - 1 - j : j;
      footprint.points.push_back((side_lo + station(i, width, options.side_step)) * side +
                                 (feed_lo + station(k, depth, options.forward_step)) * feed);
      footprint.pass.push_back(std::uint32_t(i));
    }
  return footprint;
}

}  // namespace mpm
