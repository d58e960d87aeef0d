#include "mpm/removal/ray_order.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace mpm {
namespace {

constexpr int kDigitBits = 11;                     // of a Morton number, which has three such digits
constexpr std::size_t kDigits = 1u << kDigitBits;  // cells along each side of the rays' box, too

// Every bit of the lowest 11 followed by two zeros.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0xff0000ff;
  x = (x | x << 8) & 0x0f00f00f;
  x = (x | x << 4) & 0xc30c30c3;
  return (x | x << 2) & 0x249249249;
}

// A ray and the Morton number of its cell.
struct Key {
  std::uint64_t cell;
  std::uint32_t ray;
};

// Stable, by one digit of the cell.
void sort_by_digit(const std::vector<Key>& keys, int shift, std::vector<Key>& sorted) {
  const auto digit = [&](const Key& key) { return key.cell >> shift & (kDigits - 1); };
  std::array<std::size_t, kDigits + 1> place{};
  for (const Key& key : keys) ++place[digit(key) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  for (const Key& key : keys) sorted[place[digit(key)]++] = key;
}

}  // namespace

std::vector<std::uint32_t> near_together(const std::vector<Ray>& rays) {
  Box3 box;
  for (const Ray& ray : rays) box.extend(ray.origin);
  const double size = rays.empty() ? 0 : (box.hi - box.lo).maxCoeff();
  const double scale = size > 0 ? double(kDigits - 1) / size : 0;
  std::vector<Key> keys(rays.size()), sorted(rays.size());
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const Vec3 p = scale * (rays[i].origin - box.lo);
    keys[i] = {
        spread(std::uint64_t(p.x())) | spread(std::uint64_t(p.y())) << 1 | spread(std::uint64_t(p.z())) << 2,
        i};
  }
  for (int digit = 0; digit < 3; ++digit, keys.swap(sorted)) sort_by_digit(keys, digit * kDigitBits, sorted);
  std::vector<std::uint32_t> order(rays.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const Key& k) { return k.ray; });
  return order;
}

}  // namespace mpm
