// The three test surfaces and the tool of the thesis (Singh 2020, table 1 and section 5.1).
#pragma once

#include <vector>

#include "mpm/surface/surface_model.h"
#include "mpm/tool/tool.h"

namespace mpm::testing {

enum class Thesis { convex, concave, saddle };

inline constexpr double kThesisHeights[3][16] = {
    {80, 90, 90, 80, 90, 105, 105, 90, 90, 105, 105, 90, 80, 90, 90, 80},
    {80, 70, 70, 80, 70, 55, 55, 70, 70, 55, 55, 70, 80, 70, 70, 80},
    {80, 65, 90, 85, 80, 85, 90, 95, 100, 105, 95, 100, 90, 100, 100, 85}};

// Bicubic Bézier surface over [0, 150]^2 mm, heights row-major in x.
inline BSplineSurface bicubic(const double* heights) {
  const std::vector<double> knots{0, 0, 0, 0, 1, 1, 1, 1};
  std::vector<Vec3> poles;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) poles.emplace_back(50.0 * i, 50.0 * j, heights[4 * i + j]);
  return BSplineSurface(3, 3, knots, knots, poles);
}

inline SurfaceModel one_face(BSplineSurface surface, TrimRegion trim = {}) {
  std::vector<Face> faces;
  faces.push_back({"Face1", std::move(surface), std::move(trim), false});
  return SurfaceModel(std::move(faces));
}

inline SurfaceModel thesis_model(Thesis which) { return one_face(bicubic(kThesisHeights[int(which)])); }

// A flat rectangle [0, 100]^2 whose height rises by `slope` along x.
inline SurfaceModel inclined_plane(double slope) {
  const std::vector<double> knots{0, 0, 1, 1};
  return one_face(BSplineSurface(
      1,
      1,
      knots,
      knots,
      {Vec3(0, 0, 0), Vec3(0, 100, 0), Vec3(100, 0, 100 * slope), Vec3(100, 100, 100 * slope)}));
}

inline Tool thesis_tool() { return {6.7, 6.0, 6.0, 40.0, {}}; }

}  // namespace mpm::testing
