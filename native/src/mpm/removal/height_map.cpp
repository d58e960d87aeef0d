#include "mpm/removal/height_map.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/removal/ray_entry.h"

namespace mpm {
namespace {

constexpr double kUnitTolerance = 1e-6;  // of the length of an axis that comes from a file
constexpr std::size_t kBandRows = 8;

// One simulated pose, with the part of the tool that reaches into the stock there.
struct Stamp {
  ToolPose pose;
  const Tool* tool;
  Box3 box;
};

std::size_t nodes(double width, double cell) { return std::size_t(std::ceil(width / cell)) + 1; }

// The tool with its first 0, 1, ... all segments.
std::vector<Tool> shortened_tools(const Tool& tool) {
  std::vector<Tool> result;
  for (std::size_t k = 0; k <= tool.segments.size(); ++k) {
    result.push_back(tool);
    result.back().segments.resize(k);
  }
  return result;
}

double lowest_of_segment(const ToolSegment& s, double z0, const ToolPose& pose) {
  const double slope = pose.axis.head<2>().norm();
  const double bottom = z0 * pose.axis.z() - s.bottom_radius * slope;
  const double top = (z0 + s.length) * pose.axis.z() - s.top_radius * slope;
  return pose.torus_center.z() + std::min(bottom, top);
}

// The segments from below up to the last one that comes below `top`.
std::size_t segments_below(const Tool& tool, const ToolPose& pose, double top) {
  std::size_t count = 0;
  double z = tool.flute_length - tool.minor_radius;
  for (std::size_t k = 0; k < tool.segments.size(); ++k) {
    if (lowest_of_segment(tool.segments[k], z, pose) < top) count = k + 1;
    z += tool.segments[k].length;
  }
  return count;
}

void check_path(const SweptPath& path) {
  require(path.removes.size() == path.poses.size(), "tip, axis and removes must have the same length");
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const TipPose& p = path.poses[i];
    require(p.tip.allFinite(), "tip: pose " + std::to_string(i) + " is not finite");
    require(std::abs(p.axis.norm() - 1) < kUnitTolerance && p.axis.z() > 0,
            "axis: pose " + std::to_string(i) + " needs a unit vector with z > 0 (tool from above)");
  }
}

// No point of the tool moves farther than this.
double motion(const TipPose& a, const TipPose& b, double lever) {
  return (b.tip - a.tip).norm() + angle_between(a.axis, b.axis) * lever;
}

std::vector<TipPose> simulated_poses(const Tool& tool, const SweptPath& path, double step) {
  const double lever = std::hypot(tool.length(), tool.reach());
  std::vector<TipPose> result;
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    if (!path.removes[i]) continue;
    const TipPose &a = path.poses[i - 1], &b = path.poses[i];
    if (i == 1 || !path.removes[i - 1]) result.push_back(a);
    const int steps = std::max(1, int(std::ceil(motion(a, b, lever) / step)));
    for (int k = 1; k <= steps; ++k) result.push_back(pose_between(a, b, double(k) / steps));
  }
  return result;
}

std::vector<Stamp> make_stamps(const std::vector<Tool>& tools,
                               const std::vector<TipPose>& poses,
                               double top) {
  std::vector<Stamp> stamps;
  for (const TipPose& p : poses) {
    const ToolPose pose = ToolPose::from_tip(tools.front(), p.tip, p.axis);
    const Tool& tool = tools[segments_below(tools.back(), pose, top)];
    const Box3 box = tool_bounds(tool, pose, 0.0);
    if (box.lo.z() < top) stamps.push_back({pose, &tool, box});
  }
  return stamps;
}

// Nodes [begin, end) out of `count` that lie in [lo, hi].
struct IndexRange {
  IndexRange(double lo, double hi, double origin, double cell, std::size_t count)
      : begin(index((lo - origin) / cell, count)),
        end(std::min(index((hi - origin) / cell, count) + 1, count)) {}
  static std::size_t index(double at, std::size_t count) {
    return std::size_t(std::clamp(std::floor(at), 0.0, double(count)));
  }
  std::size_t begin, end;
};

void stamp_row(HeightMap& stock, std::size_t row, const Stamp& stamp, double tolerance) {
  const IndexRange columns(stamp.box.lo.x(), stamp.box.hi.x(), stock.lo.x(), stock.cell, stock.columns);
  // Nothing of the tool lies below its tip plane: where the stock does already, there is nothing to do.
  const Vec3 tip = stamp.pose.tip(*stamp.tool);
  const double slope_x = stamp.pose.axis.x() / stamp.pose.axis.z(),
               slope_y = stamp.pose.axis.y() / stamp.pose.axis.z();
  const double plane = tip.z() - slope_y * (stock.y(row) - tip.y());
  double* height = &stock.height[row * stock.columns];
  for (std::size_t i = columns.begin; i < columns.end; ++i) {
    if (plane - slope_x * (stock.x(i) - tip.x()) >= height[i]) continue;
    height[i] = std::min(
        height[i], lowest_point(*stamp.tool, stamp.pose, stock.x(i), stock.y(row), tolerance, height[i]));
  }
}

}  // namespace

HeightMap make_stock(const Vec2& lo, const Vec2& hi, double cell, double top) {
  require(std::isfinite(cell) && cell > 0, "cell_mm must be a positive number");
  require(std::isfinite(top), "top_mm must be a finite height");
  require(lo.allFinite() && hi.allFinite() && lo.x() < hi.x() && lo.y() < hi.y(), "lo, hi: empty rectangle");
  const Vec2 counts = (hi - lo) / cell;
  require((counts.x() + 2) * (counts.y() + 2) <= double(kMaxNodes),
          "cell_mm: gives more than " + std::to_string(kMaxNodes) + " nodes");
  HeightMap map{lo, cell, nodes(hi.x() - lo.x(), cell), nodes(hi.y() - lo.y(), cell), {}};
  map.height.assign(map.columns * map.rows, top);
  return map;
}

void remove_material(HeightMap& stock,
                     const Tool& tool,
                     const SweptPath& path,
                     const RemovalOptions& options,
                     Context& context) {
  check_tool(tool);
  check_path(path);
  require(std::isfinite(options.step) && options.step > 0, "step_mm must be a positive number");
  require(std::isfinite(options.tolerance) && options.tolerance > 0,
          "tolerance_mm must be a positive number");
  const std::vector<Tool> tools = shortened_tools(tool);
  const double top = *std::max_element(stock.height.begin(), stock.height.end());
  const std::vector<Stamp> stamps = make_stamps(tools, simulated_poses(tool, path, options.step), top);
  context.start(stock.rows);
  for_each_range(stock.rows, kBandRows, context, [&](std::size_t begin, std::size_t end) {
    for (const Stamp& stamp : stamps) {
      if (context.cancelled()) return;
      const IndexRange rows(stamp.box.lo.y(), stamp.box.hi.y(), stock.lo.y(), stock.cell, stock.rows);
      for (std::size_t row = std::max(begin, rows.begin); row < std::min(end, rows.end); ++row)
        stamp_row(stock, row, stamp, options.tolerance);
    }
  });
}

}  // namespace mpm
