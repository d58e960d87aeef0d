// The three kinds of trouble (docs/architecture.md): a caller's mistake is std::invalid_argument, an outcome
// of the mathematics is a status in the result, a bug of ours is std::logic_error.
#pragma once

#include <stdexcept>
#include <string>

namespace mpm {

// Throws std::invalid_argument unless `condition`; `message` names the argument and what would be right.
inline void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument(message);
}
inline void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

// Throws std::logic_error unless `condition`: an invariant of our own code is broken.
inline void ensure(bool condition, const char* message) {
  if (!condition) throw std::logic_error(message);
}

}  // namespace mpm
