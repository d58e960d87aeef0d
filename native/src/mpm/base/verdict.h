// The three-valued answer of a judge.
#pragma once

namespace mpm {

// `undecided` is an honest answer (the budget ran out); it is never treated as `free`.
enum class Verdict { free, gouge, undecided };

}  // namespace mpm
