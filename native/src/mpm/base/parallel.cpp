#include "mpm/base/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace mpm {

void for_each_range(std::size_t n,
                    std::size_t grain,
                    Context& context,
                    const std::function<void(std::size_t, std::size_t)>& body) {
  using Range = tbb::blocked_range<std::size_t>;
  const auto run = [&](const Range& range) {
    if (context.cancelled()) return;
    body(range.begin(), range.end());
    context.advance(range.size());
  };
  // More than there are processors for this process gain nothing, and with one of them TBB warns on stderr.
  const int most = tbb::info::default_concurrency();
  const int threads = context.threads() > 0 ? std::min(context.threads(), most) : most;
  tbb::task_arena(threads).execute(
      [&] { tbb::parallel_for(Range(0, n, grain), run, tbb::simple_partitioner()); });
}

}  // namespace mpm
