// The tool path: every move in the order in which it is machined, cuts and links alike.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpm/base/types.h"

namespace mpm {

// What a move is for. `link` is a feed move between cuts near the part; link_passes() makes none, other
// people's files do.
enum class MoveKind : std::uint8_t { cut, link, rapid, plunge, retract };
inline constexpr std::array kMoveKindNames = {"cut", "link", "rapid", "plunge", "retract"};

// Structure of arrays, set-up frame, mm: move i takes the tip in a straight line and the axis along a great
// circle from pose i - 1 to pose i. Move 0 has no start: it only says where the tool comes from.
struct ToolPath {
  std::vector<MoveKind> kind;
  std::vector<Vec3> tip;
  std::vector<Vec3> axis;              // unit, tip to spindle
  std::vector<std::int64_t> position;  // index of the position that the move ends in, -1: none
  std::vector<std::int32_t> pass;      // of the position it leaves (retract) or makes for (all others)
  std::vector<double> clearance;       // least clearance found along the move, or, of a proven move that is
                                       // no rapid, its proven lower bound, mm; large ones are cut off
  std::vector<std::uint8_t> blocked;   // 1: no free way was found, the move runs into the part
  std::vector<std::uint8_t> proven;    // 1: it was proven that the move cuts no deeper than it may

  std::size_t size() const { return kind.size(); }
};

}  // namespace mpm
