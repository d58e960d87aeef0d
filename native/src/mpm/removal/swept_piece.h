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

// The part from <= t <= to of a ray (mm from its origin); none when from > to.
struct Span {
  double from, to;
};

// The part of a span of the ray that lies in the box.
Span clipped(const Ray& ray, const Span& span, const Box3& box);

// The ring: all points within `minor` of a circle of radius `major` about the axis, at height 0.
struct RingShape {
  double major, minor;
};
// The truncated cone from radius r0 at height z0 to r1 at z1.
struct ConeShape {
  double r0, r1, z0, z1;
};

// A few spans; they may overlap.
struct Spans {
  std::array<Span, 4> span;
  std::size_t count = 0;
  void add(const std::optional<Span>& one) {
    if (one) span[count++] = *one;
  }
};

// The spans of lo <= t <= hi that the shape sweeps during the stroke, ends exact to kRayEpsilon mm: at every
// t the least distance over the time of the stroke is found, and its zeros by Newton steps, which never pass
// one where the distance is convex along the ray; elsewhere (inside the ring's circle) steps no longer than
// the distance. A ring swept twice at a t in between them counts as swept throughout only on either side of
// its axis.
Spans swept_spans(const RingShape& ring, const Stroke& stroke, const Ray& ray, double lo, double hi);
Spans swept_spans(const ConeShape& cone, const Stroke& stroke, const Ray& ray, double lo, double hi);

// Least signed distance (mm) of a point from the shape over the time of the stroke; for tests.
double least_distance(const RingShape& ring, const Stroke& stroke, const Vec3& point);
double least_distance(const ConeShape& cone, const Stroke& stroke, const Vec3& point);

inline constexpr double kRayEpsilon = 1e-6;  // mm along a ray

}  // namespace mpm
