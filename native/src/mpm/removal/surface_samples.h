// Points of the faces to machine, with normals: where the machined surface is measured.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/base/context.h"
#include "mpm/surface/surface_model.h"

namespace mpm {

struct SurfaceSamples {
  std::vector<Vec3> points, normals;                    // normals: z >= 0, towards the tool
  std::vector<Vec2> at;                                 // (u, v) of each point
  std::vector<std::uint32_t> face;                      // of each point, index into model.faces()
  std::vector<std::array<std::uint32_t, 3>> triangles;  // between points of one face; none over its border
};

// Samples at most about `spacing` mm apart on a grid of the parameters of each face to machine, and along its
// trimming loops (points without triangles). Of the grid only the range of u and v is taken whose surface may
// lie in `region`: points beside it come along.
//
// Fails: std::invalid_argument for a spacing that is not positive or gives more than kMaxSamples points. A
//   cancelled call leaves points and normals without values.
SurfaceSamples sample_surfaces(const SurfaceModel& model,
                               double spacing,
                               const Box3& region,
                               Context& context);

inline constexpr double kMaxSamples = 5e7;

}  // namespace mpm
