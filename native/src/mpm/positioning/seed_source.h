// Random starts for Newton that depend on the footprint point alone: not on the order or the threads.
#pragma once

#include <bit>
#include <cstdint>

#include "mpm/base/types.h"

namespace mpm {

// splitmix64 (Steele, Lea, Flood 2014): small, and its first numbers are already good.
class SeedSource {
 public:
  explicit SeedSource(const Vec2& at)
      : state_(std::bit_cast<std::uint64_t>(at.x()) ^ std::rotl(std::bit_cast<std::uint64_t>(at.y()), 32)) {}

  // Even in [lo, hi).
  double operator()(double lo, double hi) {
    constexpr double kUnit = 0x1p-53;
    return lo + (hi - lo) * kUnit * double(next() >> 11);
  }

 private:
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace mpm
