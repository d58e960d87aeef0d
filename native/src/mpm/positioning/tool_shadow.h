// Where the sampled methods start their searches: what lies under the tool in plan (thesis fig. 4.8).
#pragma once

#include <vector>

#include "mpm/footprint/footprint_locator.h"
#include "mpm/tool/tool.h"

namespace mpm {

// For every face under the tool the sample nearest to `at` in plan, by face; samples far below the highest
// belong to another sheet and are left out.
std::vector<Seed> seeds_under_tool(const FootprintLocator& locator, const Tool& tool, const Vec2& at);

}  // namespace mpm
