// The only door to the thread pool.
#pragma once

#include <cstddef>
#include <functional>

#include "mpm/base/context.h"

namespace mpm {

// Calls body(begin, end) on disjoint ranges that cover [0, n), in parallel on context.threads() threads, but
// no more than there are processors (0: all), `grain` items or fewer at a time. Advances the context's
// progress by the items done and starts no further range once it is cancelled.
//
// Requires: grain >= 1; a body that writes only to its own items, so that the result does not depend on the
//   number of threads; context.start(), which the caller does.
// Fails: what a body throws is thrown here, and other ranges may be left out.
void for_each_range(std::size_t n,
                    std::size_t grain,
                    Context& context,
                    const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace mpm
