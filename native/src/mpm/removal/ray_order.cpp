#include "mpm/removal/ray_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mpm {
namespace {

constexpr std::uint64_t kMortonCells = (1u << 21) - 1;

// Every bit of the lowest 21 followed by two zeros.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

}  // namespace

std::vector<std::uint32_t> near_together(const std::vector<Ray>& rays) {
  Box3 box;
  for (const Ray& ray : rays) box.extend(ray.origin);
  const double size = rays.empty() ? 0 : (box.hi - box.lo).maxCoeff();
  const double scale = size > 0 ? double(kMortonCells) / size : 0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(rays.size());
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const Vec3 p = scale * (rays[i].origin - box.lo);
    keys[i] = {
        spread(std::uint64_t(p.x())) | spread(std::uint64_t(p.y())) << 1 | spread(std::uint64_t(p.z())) << 2,
        i};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(rays.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& k) { return k.second; });
  return order;
}

}  // namespace mpm
