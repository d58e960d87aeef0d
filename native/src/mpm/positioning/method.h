// The one interface of all positioning methods. registry.h has them by name, place_all.h runs them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "mpm/surface/cell_tree.h"
#include "mpm/surface/surface_model.h"
#include "mpm/tool/tool.h"

namespace mpm {

// How a position ended (docs/methods/README.md explains each).
enum class PositionStatus : std::uint8_t {
  not_computed,       // cancelled before its turn
  two_contacts,       // touches at P and at Q
  curvature_matched,  // P and Q coincide in second-order contact
  tilt_limited,       // the tilt limit came first; touches at P
  one_contact,        // nothing to touch beside P
  edge_contact,       // P lies on a border of its face
  bridged,            // two contacts at tilt 0, or the tool does not fit
  off_part,           // no face to machine under the tool
  undecided,          // the method gave up; never to be taken for free
};
inline constexpr std::array kPositionStatusNames = {"not_computed",
                                                    "two_contacts",
                                                    "curvature_matched",
                                                    "tilt_limited",
                                                    "one_contact",
                                                    "edge_contact",
                                                    "bridged",
                                                    "off_part",
                                                    "undecided"};

struct Placement {
  PositionStatus status = PositionStatus::not_computed;
  ToolPose pose{Vec3::Constant(kNaN), Vec3::Constant(kNaN)};
  Vec3 first_contact = Vec3::Constant(kNaN), first_normal = first_contact;  // normals point to the tool
  Vec3 second_contact = Vec3::Constant(kNaN), second_normal = second_contact;
  double tilt = kNaN, spin = kNaN;                             // radians
  double clearance_lo = -kInfinity, clearance_hi = kInfinity;  // mm; -inf: nobody proved a lower bound
};

// Work done, in numbers that do not depend on the machine.
struct Counters {
  std::uint64_t evaluations = 0;  // surface points, with or without derivatives
  std::uint64_t newton_steps = 0;
  std::uint64_t cells = 0;  // sub-patches bounded
  std::uint64_t seeds = 0;  // starts of a Newton search
  void add(const Counters& c) {
    evaluations += c.evaluations, newton_steps += c.newton_steps, cells += c.cells, seeds += c.seeds;
  }
};

struct MethodOptions {
  double tilt_max = kPi / 4;              // radians
  double spin = 0;                        // radians; methods that cannot spin refuse any other value
  std::map<std::string, double> numbers;  // the method's own, by name; unknown names are refused
  // judge_cells() of the model and the tool, to be shared; null: a method that needs them makes its own.
  std::shared_ptr<const CellTree> cells = nullptr;
};

// A first contact that is given instead of dropped to: the tool is to touch at (u, v) of a face with the
// tangent of its ring there along `ring_direction` (set-up frame, any length; its part along the surface
// counts).
struct GivenContact {
  std::uint32_t face;
  double u, v;
  Vec3 ring_direction;
};

// The tool dropped over one plan point, to be spun and tilted as often as wanted; the drop is done once.
//
// Requires: not to live longer than its method.
//
// Threads: used by one at a time.
class DroppedTool {
 public:
  virtual ~DroppedTool() = default;
  // The position with `spin` (radians) about the normal at P: to the bit what a method made with that spin
  // places. What other spins were asked for does not matter.
  virtual Placement spun(double spin, Counters& counters) const = 0;
};

// Positions one tool on one model. Set-up frame: the tool comes from +z.
//
// Guarantees: a position depends on its own point alone. A lower bound of the clearance, where there is one,
// is proven for the very pose that it comes with.
//
// Fails: what the mathematics brings is a status, never thrown.
//
// Threads: place() and drop() may be called from several, each with counters of its own, which are added to.
class Method {
 public:
  virtual ~Method() = default;
  // The tool over plan point `at`.
  virtual Placement place(const Vec2& at, Counters& counters) const = 0;
  // The tool at a given contact, come down from the open side. `tilt` of the result is the contact angle: 0
  // on the ring's equator, 90 degrees on its bottom.
  //
  // Fails: std::invalid_argument where the method has no such entry. What is given is not checked: that is up
  //   to place_all().
  virtual Placement place(const GivenContact& at, Counters& counters) const;
  // The tool dropped over plan point `at`, ready for any spin; never null.
  //
  // Fails: std::invalid_argument where the method cannot spin.
  virtual std::unique_ptr<DroppedTool> drop(const Vec2& at, Counters& counters) const;
};

}  // namespace mpm
