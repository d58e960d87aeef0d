// The three-valued answer of a judge.
#pragma once

#include <array>
#include <cstdint>

namespace mpm {

// `undecided` is an honest answer (the budget ran out); it is never treated as `free`.
enum class Verdict : std::uint8_t { free, gouge, undecided };
inline constexpr std::array kVerdictNames = {"free", "gouge", "undecided"};

}  // namespace mpm
