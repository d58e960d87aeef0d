#include "mpm/positioning/tool_shadow.h"

#include <algorithm>

namespace mpm {
namespace {

constexpr double kSheetGap = 2.0;  // tool radii: seeds this much below the highest lie on another sheet

}  // namespace

std::vector<Seed> seeds_under_tool(const FootprintLocator& locator, const Tool& tool, const Vec2& at) {
  const double reach = tool.radius() + locator.spacing();
  double highest = -kInfinity;
  locator.visit_near(at, reach, [&](const Seed& s) { highest = std::max(highest, s.s.z()); });
  std::vector<Seed> nearest;
  const auto plan_distance = [&](const Seed& s) { return (s.s.head<2>() - at).squaredNorm(); };
  locator.visit_near(at, reach, [&](const Seed& s) {
    if (s.s.z() < highest - kSheetGap * tool.radius()) return;
    const auto same =
        std::find_if(nearest.begin(), nearest.end(), [&](const Seed& n) { return n.face == s.face; });
    if (same == nearest.end())
      nearest.push_back(s);
    else if (plan_distance(s) < plan_distance(*same))
      *same = s;
  });
  std::sort(nearest.begin(), nearest.end(), [](const Seed& a, const Seed& b) { return a.face < b.face; });
  return nearest;
}

}  // namespace mpm
