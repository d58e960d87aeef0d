#include "mpm/positioning/method.h"

#include <stdexcept>

namespace mpm {

Placement Method::place(const GivenContact&, Counters&) const {
  throw std::invalid_argument("this method cannot start from given contacts; exact can");
}

std::unique_ptr<DroppedTool> Method::drop(const Vec2&, Counters&) const {
  throw std::invalid_argument("spin_deg: this method cannot spin; exact and dstm can");
}

}  // namespace mpm
