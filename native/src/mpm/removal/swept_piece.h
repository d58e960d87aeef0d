// One piece of the tool's body during one stroke, met by a ray: which part of the ray it sweeps.
#pragma once

#include <array>
#include <optional>

#include "mpm/removal/stroke.h"

namespace mpm {

struct Ray {
  Vec3 origin, direction;  // direction: unit
  Vec3 at(double t) const { return origin + t * direction; }
};

// The part from <= t <= to of a ray (mm from its origin).
struct Span {
  double from, to;
};

// The ring: all points within `minor` of a circle of radius `major` about the axis, at height 0.
struct RingShape {
  double major, minor;
};
// The truncated cone from radius r0 at height z0 to r1 at z1.
struct ConeShape {
  double r0, r1, z0, z1;
};

// Up to two spans, ascending.
struct Spans {
  std::array<Span, 2> span;
  int count = 0;
  void add(double from, double to) { span[std::size_t(count++)] = {from, to}; }
};

// The spans of lo <= t <= hi that the shape sweeps during the stroke, ends exact to kRayEpsilon mm: at every
// t the least distance over the time of the stroke is found, and its zeros by Newton steps, which never pass
// one where the distance is convex along the ray; elsewhere (inside the ring's circle) steps no longer than
// the distance. A ring swept twice at a t in between them counts as swept throughout only on either side of
// its axis.
Spans swept_spans(
    const RingShape& ring, const Stroke& stroke, double minor_radius, const Ray& ray, double lo, double hi);
Spans swept_spans(
    const ConeShape& cone, const Stroke& stroke, double minor_radius, const Ray& ray, double lo, double hi);

// Least signed distance (mm) of a point from the shape over the time of the stroke; for tests.
double least_distance(const RingShape& ring, const Stroke& stroke, double minor_radius, const Vec3& point);
double least_distance(const ConeShape& cone, const Stroke& stroke, double minor_radius, const Vec3& point);

inline constexpr double kRayEpsilon = 1e-6;  // mm along a ray

}  // namespace mpm
