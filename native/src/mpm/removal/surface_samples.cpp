#include "mpm/removal/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"

namespace mpm {
namespace {

constexpr int kProbes = 17;           // iso-lines and points on them by which a face is measured
constexpr double kDegenerate = 1e-9;  // mm^2: |Su x Sv| of a point without a normal
constexpr double kNudge = 1e-3;       // of the domain, towards its middle, to where there is one
constexpr std::size_t kSamplesATask = 1024;
// Along each side of a face, of which each is looked at whether it is in the region.
constexpr std::size_t kBlocks = 64;
constexpr std::uint32_t kNone = ~std::uint32_t(0);

// Nodes u0 <= i <= u1, v0 <= j <= v1 of a regular grid over a face's parameters with nu x nv steps.
struct FaceGrid {
  const Face* face;
  std::uint32_t index;
  std::size_t nu, nv;
  std::size_t u0, u1, v0, v1;

  double u(std::size_t i) const { return along(face->surface.domain().u0, face->surface.domain().u1, i, nu); }
  double v(std::size_t j) const { return along(face->surface.domain().v0, face->surface.domain().v1, j, nv); }
  std::size_t width() const { return u1 - u0 + 1; }
  double nodes() const { return double(width()) * double(v1 - v0 + 1); }
  static double along(double a, double b, std::size_t i, std::size_t n) {
    return a + (b - a) * double(i) / double(n);
  }
};

// Length (mm) of the longest of some iso-lines, along u or along v.
double longest_line(const BSplineSurface& surface, bool along_u) {
  const ParamBox& d = surface.domain();
  double longest = 0;
  for (int line = 0; line < kProbes; ++line) {
    const double fixed = double(line) / (kProbes - 1);
    double length = 0;
    Vec3 last = Vec3::Zero();
    for (int i = 0; i < kProbes; ++i) {
      const double moving = double(i) / (kProbes - 1);
      const double s = along_u ? moving : fixed, t = along_u ? fixed : moving;
      const Vec3 p = surface.point(d.u0 + s * (d.u1 - d.u0), d.v0 + t * (d.v1 - d.v0));
      if (i > 0) length += (p - last).norm();
      last = p;
    }
    longest = std::max(longest, length);
  }
  return longest;
}

Vec3 normal_at(const BSplineSurface& surface, double u, double v) {
  const ParamBox& d = surface.domain();
  SurfacePoint p = surface.evaluate(u, v);
  if (p.su.cross(p.sv).norm() < kDegenerate)
    p = surface.evaluate(u + kNudge * (d.u_mid() - u), v + kNudge * (d.v_mid() - v));
  const Vec3 n = p.su.cross(p.sv).normalized();
  return n.z() < 0 ? Vec3(-n) : n;
}

// The (u, v) of a face's samples: its grid's nodes within the trim, then points along the trimming loops.
struct FaceSamples {
  std::vector<Vec2> at;
  std::vector<std::uint32_t> number;  // of each node in `at`, kNone: trimmed away
};

void add_loops(const FaceGrid& grid, double spacing, std::vector<Vec2>& at) {
  for (const std::vector<Vec2>& loop : grid.face->trim.loops())
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      const BSplineSurface& surface = grid.face->surface;
      const double length = (surface.point(a.x(), a.y()) - surface.point(b.x(), b.y())).norm();
      const int steps = std::max(1, int(std::ceil(length / spacing)));
      for (int k = 0; k < steps; ++k) at.emplace_back(a + (b - a) * (double(k) / steps));
    }
}

FaceSamples face_samples(const FaceGrid& grid, double spacing) {
  FaceSamples samples;
  samples.at.reserve(std::size_t(grid.nodes()));
  samples.number.reserve(std::size_t(grid.nodes()));
  for (std::size_t j = grid.v0; j <= grid.v1; ++j)
    for (std::size_t i = grid.u0; i <= grid.u1; ++i) {
      const Vec2 at(grid.u(i), grid.v(j));
      const bool kept = grid.face->trim.contains(at.x(), at.y());
      samples.number.push_back(kept ? std::uint32_t(samples.at.size()) : kNone);
      if (kept) samples.at.push_back(at);
    }
  add_loops(grid, spacing, samples.at);
  return samples;
}

void add_triangles(const FaceGrid& grid,
                   const FaceSamples& samples,
                   std::uint32_t first,
                   SurfaceSamples& result) {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != kNone && b != kNone && c != kNone) result.triangles.push_back({first + a, first + b, first + c});
  };
  result.triangles.reserve(result.triangles.size() + 2 * std::size_t(grid.nodes()));
  for (std::size_t j = 0; j < grid.v1 - grid.v0; ++j)
    for (std::size_t i = 0; i + 1 < grid.width(); ++i) {
      const std::uint32_t* row = &samples.number[j * grid.width() + i];
      const std::uint32_t* next = row + grid.width();
      add(row[0], row[1], next[1]);
      add(row[0], next[1], next[0]);
    }
}

// A box round the surface over a rectangle of parameters, judged by nine points of it.
Box3 rough_bounds(const BSplineSurface& surface, double u0, double u1, double v0, double v1) {
  Box3 box;
  for (const double u : {u0, 0.5 * (u0 + u1), u1})
    for (const double v : {v0, 0.5 * (v0 + v1), v1}) box.extend(surface.point(u, v));
  const double margin = 0.5 * box.diagonal();
  return {box.lo - Vec3::Constant(margin), box.hi + Vec3::Constant(margin)};
}

// Narrows the grid's range of nodes to where the face may lie in the region; false when nothing of it does.
bool narrow(FaceGrid& grid, const Box3& region) {
  FaceGrid found = grid;
  found.u0 = grid.nu, found.v0 = grid.nv, found.u1 = found.v1 = 0;
  const std::size_t step_u = (grid.nu + kBlocks - 1) / kBlocks, step_v = (grid.nv + kBlocks - 1) / kBlocks;
  for (std::size_t i = 0; i < grid.nu; i += step_u)
    for (std::size_t j = 0; j < grid.nv; j += step_v) {
      const std::size_t i1 = std::min(i + step_u, grid.nu), j1 = std::min(j + step_v, grid.nv);
      if (!rough_bounds(grid.face->surface, grid.u(i), grid.u(i1), grid.v(j), grid.v(j1)).meets(region))
        continue;
      found.u0 = std::min(found.u0, i), found.u1 = std::max(found.u1, i1);
      found.v0 = std::min(found.v0, j), found.v1 = std::max(found.v1, j1);
    }
  if (found.u1 == 0) return false;
  grid = found;
  return true;
}

std::vector<FaceGrid> make_grids(const SurfaceModel& model, double spacing, const Box3& region) {
  std::vector<FaceGrid> grids;
  double total = 0;
  for (std::uint32_t f = 0; f < model.faces().size(); ++f) {
    const Face& face = model.faces()[f];
    if (face.check) continue;
    const auto steps = [&](bool along_u) {
      return std::size_t(std::max(1.0, std::ceil(longest_line(face.surface, along_u) / spacing)));
    };
    FaceGrid grid{&face, f, steps(true), steps(false), 0, 0, 0, 0};
    grid.u1 = grid.nu, grid.v1 = grid.nv;
    if (!narrow(grid, region)) continue;
    total += grid.nodes();
    require(total <= kMaxSamples,
            "spacing_mm: gives more than " + std::to_string(std::size_t(kMaxSamples)) +
                " samples; take a larger one or a smaller box");
    grids.push_back(grid);
  }
  return grids;
}

}  // namespace

SurfaceSamples sample_surfaces(const SurfaceModel& model,
                               double spacing,
                               const Box3& region,
                               Context& context) {
  require(std::isfinite(spacing) && spacing > 0, "spacing_mm must be a positive number");
  SurfaceSamples result;
  std::vector<Vec2>& at = result.at;
  for (const FaceGrid& grid : make_grids(model, spacing, region)) {
    const FaceSamples samples = face_samples(grid, spacing);
    add_triangles(grid, samples, std::uint32_t(at.size()), result);
    at.insert(at.end(), samples.at.begin(), samples.at.end());
    result.face.resize(at.size(), grid.index);
  }
  result.points.resize(at.size());
  result.normals.resize(at.size());
  context.start(at.size());
  for_each_range(at.size(), kSamplesATask, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Face& face = model.faces()[result.face[i]];
      result.points[i] = face.surface.point(at[i].x(), at[i].y());
      result.normals[i] = normal_at(face.surface, at[i].x(), at[i].y());
    }
  });
  return result;
}

}  // namespace mpm
