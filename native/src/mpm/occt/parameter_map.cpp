#include "mpm/occt/parameter_map.h"

#include <algorithm>
#include <cmath>

namespace mpm::occt {

double ParameterMap::operator()(double t) const {
  if (knots_.empty()) return t;
  const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, t);
  const double a = *(after - 1), b = *after;
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  if (t == a || t == b) return t;
  return middle + half * std::tan((t - middle) / 2) / std::tan(half / 2);
}

}  // namespace mpm::occt
