// Finds what lies under a point of the plan (the set-up's xy plane).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mpm/surface/surface_model.h"

namespace mpm {

// A surface sample: where to start a search from.
struct Seed {
  std::uint32_t face;
  double u, v;
  Vec3 s;
};

// Samples of all faces, at most about `spacing` (mm) apart in space, sorted into a plan grid. Samples outside
// the trim are left out. The spacing is widened so that there are at most a few million samples.
//
// Requires: the model outlives it.
// Fails: std::invalid_argument for a spacing that is not positive.
// Threads: any number may ask one.
class FootprintLocator {
 public:
  FootprintLocator(const SurfaceModel& model, double spacing);

  double spacing() const { return spacing_; }  // as widened

  // Calls visit(seed) for the samples within `radius` of `at` in plan, in a fixed order.
  template <class Visit>
  void visit_near(const Vec2& at, double radius, const Visit& visit) const;

  // Plan distance (mm) from `at` to the faces to machine: 0 to rounding where `at` is over one of them;
  // infinity beyond `radius`. Outside a trimmed border it is the distance to the nearest sample.
  double distance(const Vec2& at, double radius) const;

 private:
  std::size_t cell(double x, double y) const;
  double refine(const Seed& seed, const Vec2& at) const;

  const SurfaceModel& model_;
  double spacing_;
  Vec2 lo_;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<Seed> seeds_;            // by cell
  std::vector<std::uint32_t> starts_;  // of each cell in seeds_, and the end
};

// Which points lie over the faces to machine, or within `margin` mm of them in plan.
std::vector<bool> over_faces(const FootprintLocator& locator, const std::vector<Vec2>& points, double margin);

template <class Visit>
void FootprintLocator::visit_near(const Vec2& at, double radius, const Visit& visit) const {
  const auto column = [&](double x) {
    return std::ptrdiff_t(std::clamp(std::floor((x - lo_.x()) / spacing_), -1.0, double(columns_)));
  };
  const auto row = [&](double y) {
    return std::ptrdiff_t(std::clamp(std::floor((y - lo_.y()) / spacing_), -1.0, double(rows_)));
  };
  const std::ptrdiff_t c0 = std::max<std::ptrdiff_t>(column(at.x() - radius), 0);
  const std::ptrdiff_t c1 = std::min<std::ptrdiff_t>(column(at.x() + radius), std::ptrdiff_t(columns_) - 1);
  const std::ptrdiff_t r0 = std::max<std::ptrdiff_t>(row(at.y() - radius), 0);
  const std::ptrdiff_t r1 = std::min<std::ptrdiff_t>(row(at.y() + radius), std::ptrdiff_t(rows_) - 1);
  for (std::ptrdiff_t r = r0; r <= r1; ++r)
    for (std::ptrdiff_t c = c0; c <= c1; ++c) {
      const std::size_t index = std::size_t(r) * columns_ + std::size_t(c);
      for (std::uint32_t i = starts_[index]; i < starts_[index + 1]; ++i)
        if ((seeds_[i].s.head<2>() - at).squaredNorm() <= radius * radius) visit(seeds_[i]);
    }
}

}  // namespace mpm
