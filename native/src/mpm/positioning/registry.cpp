#include "mpm/positioning/registry.h"

#include <cmath>

#include "mpm/base/error.h"
#include "mpm/positioning/drd.h"
#include "mpm/positioning/dstm.h"
#include "mpm/positioning/exact.h"
#include "mpm/positioning/pam.h"
#include "mpm/positioning/vcrf.h"

namespace mpm {
namespace {

std::string names_of(const std::vector<MethodInfo>& all) {
  std::string names;
  for (const MethodInfo& m : all) names += (names.empty() ? "" : ", ") + std::string(m.name);
  return names;
}

}  // namespace

// Add yours here: name, guarantee, whether it can spin, its own numbers with the source's defaults, how it is
// made.
const std::vector<MethodInfo>& methods() {
  static const std::vector<MethodInfo> all{{"exact", "proven", true, exact_defaults(), make_exact},
                                           {"vcrf", "sampled", false, vcrf_defaults(), make_vcrf},
                                           {"drd", "sampled", false, drd_defaults(), make_drd},
                                           {"dtm", "sampled", false, dstm_defaults(), make_dtm},
                                           {"dstm", "sampled", true, dstm_defaults(), make_dstm},
                                           {"pam", "sampled", false, pam_defaults(), make_pam}};
  return all;
}

std::unique_ptr<Method> make_method(const std::string& name,
                                    const SurfaceModel& model,
                                    const Tool& tool,
                                    MethodOptions options) {
  require(std::isfinite(options.tilt_max) && options.tilt_max > 0 && options.tilt_max < kPi / 2,
          "tilt_max_deg must be more than 0 and less than 90");
  require(std::isfinite(options.spin), "spin_deg must be a finite angle");
  for (const MethodInfo& m : methods()) {
    if (name != m.name) continue;
    std::map<std::string, double> numbers = m.numbers;
    for (const auto& [key, value] : options.numbers) {
      require(numbers.contains(key), "method " + name + " has no option '" + key + "'");
      numbers[key] = value;
    }
    options.numbers = std::move(numbers);
    return m.make(model, tool, options);
  }
  throw std::invalid_argument("unknown method '" + name + "'; there are: " + names_of(methods()));
}

}  // namespace mpm
