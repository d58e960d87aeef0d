#include "mpm/positioning/spacing_rules.h"

namespace mpm {

double contact_spacing(const Placement& placement, const SpacingRules& rules) {
  if (placement.status == PositionStatus::curvature_matched) return 0;
  const Vec3 apart = placement.second_contact - placement.first_contact;
  return rules.measure == SpacingMeasure::direct ? apart.norm()
                                                 : (apart - apart.dot(rules.feed) * rules.feed).norm();
}

}  // namespace mpm
