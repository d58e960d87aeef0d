// The spins of one dropped tool that give a wanted distance of its contacts.
#pragma once

#include <vector>

#include "mpm/base/context.h"
#include "mpm/positioning/spacing_rules.h"

namespace mpm {

struct SpinCandidate {
  Placement placement;
  double spacing = kNaN;  // mm
  // |spacing - wanted| / wanted; infinite where there is no spacing.
  double miss = kInfinity;
  bool reached() const { return miss <= kSpacingTolerance; }
};

// All that reach the wanted spacing, by rising spin; where none does, the spins of the local bests instead;
// where no spin gives a second contact, the position without spin. Never empty. Between two of the rules'
// samples one change of sign is found; a pair of solutions between two samples is found where the best of
// three neighbours leads to it. Once the context is cancelled the search ends at once, with what it has.
//
// Method: samples round the circle, then false position (Illinois) between those of opposite excess.
// Requires: rules with wanted > 0 and samples >= 4, which place_spaced() checks.
std::vector<SpinCandidate> spin_candidates(const DroppedTool& dropped,
                                           const SpacingRules& rules,
                                           Counters& counters,
                                           const Context& context);

}  // namespace mpm
