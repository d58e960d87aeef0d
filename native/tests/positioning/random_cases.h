// Random surfaces, tools and starts for the tests of positions: the same for the same seed everywhere.
#pragma once

#include <utility>
#include <vector>

#include "mpm/positioning/seed_source.h"
#include "mpm/surface/surface_model.h"
#include "mpm/tool/tool.h"

namespace mpm::testing {

enum class Ground { trough, saddle, dome, bowl, ridge, valley };
inline constexpr Ground kGrounds[] = {
    Ground::trough, Ground::saddle, Ground::dome, Ground::bowl, Ground::ridge, Ground::valley};
inline constexpr double kHalf = 30;  // mm: the ground reaches from -30 to 30 in x and in y

enum class Cutter { hollow, flat, ball_like, held };
inline constexpr Cutter kCutters[] = {Cutter::hollow, Cutter::flat, Cutter::ball_like, Cutter::held};

class CaseMaker {
 public:
  explicit CaseMaker(unsigned seed) : random_(Vec2(seed, 1)) {}

  double uniform(double lo, double hi) { return random_(lo, hi); }

  // Steep ones among them, so that tools of the size below do not fit everywhere.
  SurfaceModel ground(Ground which) {
    const double p = uniform(0.1, 3) / kHalf, q = uniform(0.1, 3) / kHalf;  // 1/mm: slope at the rim
    switch (which) {
      case Ground::trough:
        return quadratic(p, 0);
      case Ground::saddle:
        return quadratic(p, -q);
      case Ground::dome:
        return quadratic(-p, -q);
      case Ground::bowl:
        return quadratic(p, q);
      case Ground::ridge:
        return two_faces(-kHalf * p, -kHalf * q);
      case Ground::valley:
        return two_faces(kHalf * p, kHalf * q);
    }
    return quadratic(0, 0);
  }

  Tool tool(Cutter which) {
    const double radius = uniform(1, 14), part = uniform(0.1, 0.8);
    Tool t{radius * (1 - part), radius * part, 0, 3 * radius, {}};
    if (which == Cutter::hollow) t.recess = t.minor_radius;
    if (which == Cutter::ball_like) t = {0.05 * radius, 0.95 * radius, 0.95 * radius, 3 * radius, {}};
    if (which == Cutter::held)
      t.recess = t.minor_radius, t.segments = {{radius, radius, radius}, {2 * radius, 2 * radius, 20}};
    return t;
  }

 private:
  // z = x^2 a / 2 + y^2 b / 2 + c x + d y with small random c and d.
  SurfaceModel quadratic(double a, double b) {
    const double c = uniform(-0.2, 0.2), d = uniform(-0.2, 0.2);
    const std::vector<double> knots{0, 0, 0, 1, 1, 1};
    // The blossom of x^2 at the poles of a quadratic over [-h, h]: h^2, -h^2, h^2.
    const double at[] = {-kHalf, 0, kHalf}, squared[] = {kHalf * kHalf, -kHalf * kHalf, kHalf * kHalf};
    std::vector<Vec3> poles;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        poles.emplace_back(at[i], at[j], a / 2 * squared[i] + b / 2 * squared[j] + c * at[i] + d * at[j]);
    std::vector<Face> faces;
    faces.push_back({"Face1", BSplineSurface(2, 2, knots, knots, poles), {}, false});
    return SurfaceModel(std::move(faces));
  }

  // Two planes that rise from their common edge x = 0 with these slopes.
  SurfaceModel two_faces(double left, double right) {
    std::vector<Face> faces;
    faces.push_back({"Face1", strip(-kHalf, 0, kHalf * left, 0), {}, false});
    faces.push_back({"Face2", strip(0, kHalf, 0, kHalf * right), {}, false});
    return SurfaceModel(std::move(faces));
  }

  static BSplineSurface strip(double x0, double x1, double z0, double z1) {
    const std::vector<double> knots{0, 0, 1, 1};
    return {1,
            1,
            knots,
            knots,
            {Vec3(x0, -kHalf, z0), Vec3(x0, kHalf, z0), Vec3(x1, -kHalf, z1), Vec3(x1, kHalf, z1)}};
  }

  SeedSource random_;
};

}  // namespace mpm::testing
