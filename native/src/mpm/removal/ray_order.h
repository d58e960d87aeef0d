// Parallel work on rays in tiles of neighbours, and the order in which strokes are tried on a tile.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mpm/removal/tool_sweep.h"

namespace mpm {

inline constexpr std::size_t kTileRays = 64;

// Numbers of the rays, those whose origins are near each other next to each other (Morton order).
std::vector<std::uint32_t> near_together(const std::vector<Ray>& rays);

// Puts strokes in ascending order of key(stroke), a number: what the first ones take away need not be looked
// at for the others.
template <class Key>
void order_strokes(const Key& key, std::vector<std::uint32_t>& strokes) {
  std::vector<std::pair<double, std::uint32_t>> keys;
  keys.reserve(strokes.size());
  for (const std::uint32_t i : strokes) keys.emplace_back(key(i), i);
  std::sort(keys.begin(), keys.end());
  std::transform(keys.begin(), keys.end(), strokes.begin(), [](const auto& k) { return k.second; });
}

}  // namespace mpm
