// Newton on the tangency equations of drop, spin and tilt: paper eq. 2 (drop), 6 and 7 (tilt).
#pragma once

#include <cstdint>
#include <optional>

#include "mpm/contact/insert.h"
#include "mpm/positioning/method.h"

namespace mpm {

// How the derivatives of surface and normal are taken, and when Newton stops.
struct NewtonRules {
  bool analytic = false;            // false: Richardson extrapolation (fig. 11)
  bool printed_equation_7 = false;  // true: with the derivatives of eq. 7 as printed
  double step = 1e-3;               // first difference, in parts of the face's parameter range
  double step_tolerance = 1e-5;     // progress at which the extrapolation stops
  double tolerance = 1e-6;          // mm, of the equations
  int iterations = 50;
};

// A tangent point of a face: its normal points upwards.
struct TangentPoint {
  std::uint32_t face = 0;
  double u = 0, v = 0;
  Vec3 s = Vec3::Zero(), n = Vec3::UnitZ();
};

struct DropSolution {
  TangentPoint contact;
  double height = 0;  // of the torus centre, mm
};

struct TiltSolution {
  TangentPoint contact;
  double beta = 0, phi = 0;  // radians; phi = -90 degrees is the first contact's place on the major circle
};

// From a start; nothing where Newton does not converge to a point inside the face.
std::optional<DropSolution> solve_drop(const SurfaceModel& model,
                                       const Tool& tool,
                                       const Vec2& at,
                                       const NewtonRules& rules,
                                       DropSolution start,
                                       Counters& counters);

// `insert`: of the dropped (and spun) tool.
std::optional<TiltSolution> solve_tilt(const SurfaceModel& model,
                                       const Tool& tool,
                                       const Insert& insert,
                                       const NewtonRules& rules,
                                       TiltSolution start,
                                       Counters& counters);

}  // namespace mpm
