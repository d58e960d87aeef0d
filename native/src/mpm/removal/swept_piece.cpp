#include "mpm/removal/swept_piece.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mpm {
namespace {

constexpr double kTimeEpsilon = 1e-9;  // mm by which the least distance over time may be too large
constexpr int kTimeSteps = 12, kRaySteps = 60, kRootSteps = 60;
constexpr double kParallel = 1e-9;  // 1 - cos^2 of the angle between ray and axis

struct Reading {
  double distance;  // mm
  double rate;      // per unit of time
  double slope;     // per mm of the ray
};

// Distance from a body of revolution at radius r and height z, and its gradient there.
ConeDistance distance_at(const RingShape& ring, double r, double z) {
  const double rho = r - ring.major, size = hypotenuse(rho, z);
  if (size == 0) return {-ring.minor, 1, 0};
  return {size - ring.minor, rho / size, z / size};
}
ConeDistance distance_at(const ConeShape& cone, double r, double z) {
  return cone_distance(r, z, cone.r0, cone.r1, cone.z0, cone.z1);
}

template <class Shape>
class Sweep {
 public:
  // convex: the distance is, along the ray as far as it will be asked for.
  Sweep(const Shape& shape, const Stroke& stroke, double minor_radius, const Ray& ray, bool convex)
      : shape_(shape), stroke_(stroke), minor_radius_(minor_radius), ray_(ray), convex_(convex) {}

  // The reading at the time of the stroke at which the distance of the point at t is least.
  Reading nearest(double t) const {
    const Vec3 point = ray_.at(t);
    Reading a = at(point, 0), b = at(point, 1);
    if (!(a.rate < 0 && b.rate > 0)) return a.distance <= b.distance ? a : b;
    return between(point, a, b);
  }

  // The swept span of lo <= t <= hi when it is one.
  std::optional<Span> span(double lo, double hi) const {
    const Reading top = nearest(hi);
    if (top.distance > 0 && top.slope <= 0 && convex_) return {};
    std::optional<double> to = hi;
    if (top.distance > 0) to = march(hi, top, lo, -1);
    if (!to) return {};
    double start = lo;
    // From within, a Newton step ends outside where the distance is convex.
    if (top.distance <= 0 && convex_ && top.slope < 0) start = std::max(lo, hi - top.distance / top.slope);
    const std::optional<double> from = march(start, nearest(start), *to, 1);
    if (from) return Span{*from, *to};
    return {};
  }

 private:
  Reading at(const Vec3& point, double time) const {
    const StrokePose pose = stroke_.at(minor_radius_, time);
    const Vec3 u = point - pose.center;
    const double z = u.dot(pose.axis);
    const Vec3 w = u - z * pose.axis;
    const double r = w.norm(), inverse = r > 0 ? 1 / r : 0;
    const ConeDistance d = distance_at(shape_, r, z);
    const Vec3 gradient = (d.slope_r * inverse) * w + d.slope_z * pose.axis;
    const double turn = (d.slope_z - d.slope_r * z * inverse) * u.dot(pose.axis_rate);
    return {d.distance, turn - gradient.dot(pose.center_rate), gradient.dot(ray_.direction)};
  }

  // The least distance between times 0 and 1, where its rate goes from negative to positive (Illinois).
  Reading between(const Vec3& point, Reading a, Reading b) const {
    double ta = 0, tb = 1, ra = a.rate, rb = b.rate;
    Reading best = a.distance <= b.distance ? a : b;
    for (int step = 0; step < kTimeSteps; ++step) {
      const double tm = (ta * rb - tb * ra) / (rb - ra);
      const Reading m = at(point, tm);
      if (m.distance < best.distance) best = m;
      if (m.rate * m.rate * (tb - ta) < 2 * kTimeEpsilon * (rb - ra)) return m;
      if (m.rate < 0) {
        ta = tm, ra = m.rate, rb *= 0.5;
      } else {
        tb = tm, rb = m.rate, ra *= 0.5;
      }
    }
    return best;
  }

  // First t from `t` towards `limit` at which the shape has swept; `sense` is the sign of that way.
  std::optional<double> march(double t, Reading now, double limit, double sense) const {
    for (int n = 0; n < kRaySteps; ++n) {
      if (now.distance <= 0) return t;
      const double closing = -now.slope * sense;
      if (closing <= 0 && (convex_ || receding(t, sense))) return {};
      const double step = std::max(closing > 0 ? now.distance / closing : now.distance, kRayEpsilon);
      const bool past = step >= (limit - t) * sense;
      if (past && convex_) return {};
      const double next = past ? limit : t + sense * step;
      const Reading then = nearest(next);
      if (then.distance < 0) return zero_between(t, now.distance, next, then.distance);
      if (!convex_ && closing > 0 && then.slope * sense > 0)
        if (const std::optional<double> in = inside_between(t, now, next, then))
          return zero_between(t, now.distance, *in, nearest(*in).distance);
      if (past) return {};
      if (step <= kRayEpsilon && convex_) return next;
      t = next, now = then;
    }
    return {};
  }

  // A point inside, between two outside from which the distance falls towards each other; none when there is
  // none.
  std::optional<double> inside_between(double ta, Reading a, double tb, Reading b) const {
    for (int n = 0; n < kRaySteps; ++n) {
      // The distance changes by no more than the way.
      if (a.distance + b.distance > std::abs(tb - ta)) return {};
      const double t = 0.5 * (ta + tb);
      const Reading m = nearest(t);
      if (m.distance < 0) return t;
      if ((m.slope < 0) == (a.slope < 0)) {
        ta = t, a = m;
      } else {
        tb = t, b = m;
      }
    }
    return {};
  }

  // Is the point at t below the tip plane for the whole stroke, and the way leads farther below?
  bool receding(double t, double sense) const {
    const Vec3 point = ray_.at(t);
    const double height =
        std::max((point - stroke_.tip).dot(stroke_.axis), (point - stroke_.end_tip).dot(stroke_.end_axis));
    const double rise = sense * ray_.direction.dot(stroke_.axis),
                 end_rise = sense * ray_.direction.dot(stroke_.end_axis);
    return rise <= 0 && end_rise <= 0 && height < -stroke_.sagitta((point - stroke_.tip).norm());
  }

  double zero_between(double outside, double f_outside, double inside, double f_inside) const {
    for (int n = 0; n < kRootSteps && std::abs(inside - outside) > kRayEpsilon; ++n) {
      const double t = (outside * f_inside - inside * f_outside) / (f_inside - f_outside);
      const double f = nearest(t).distance;
      if (f > 0) {
        outside = t, f_outside = f, f_inside *= 0.5;
        if (f < kTimeEpsilon) break;
      } else {
        inside = t, f_inside = f, f_outside *= 0.5;
        if (f > -kTimeEpsilon) break;
      }
    }
    return inside;
  }

  Shape shape_;
  const Stroke& stroke_;
  double minor_radius_;
  const Ray& ray_;
  bool convex_;
};

// Where the ray comes nearest to the axis, half way through the stroke; infinity when it runs along the axis.
double crossing(const Stroke& stroke, double minor_radius, const Ray& ray) {
  const StrokePose pose = stroke.at(minor_radius, 0.5);
  const Vec3 u = ray.origin - pose.center;
  const double along = ray.direction.dot(pose.axis), across = 1 - along * along;
  if (across < kParallel) return kInfinity;
  return (u.dot(pose.axis) * along - u.dot(ray.direction)) / across;
}

// Does lo <= t <= hi of the ray keep out of the ring's circle during the whole stroke?
bool outside_circle(const RingShape& ring,
                    const Stroke& stroke,
                    double minor_radius,
                    const Ray& ray,
                    const Span& part,
                    double middle) {
  const StrokePose pose = stroke.at(minor_radius, 0.5);
  const Vec3 nearest = ray.at(std::clamp(middle, part.from, part.to)) - pose.center;
  const double r = nearest.cross(pose.axis).norm();
  const double farthest =
      std::max((ray.at(part.from) - pose.center).norm(), (ray.at(part.to) - pose.center).norm());
  return r - 0.5 * (pose.center_rate.norm() + stroke.angle * farthest) > ring.major;
}

}  // namespace

Spans swept_spans(
    const RingShape& ring, const Stroke& stroke, double minor_radius, const Ray& ray, double lo, double hi) {
  const double middle = crossing(stroke, minor_radius, ray);
  const bool convex = ring.major == 0 || outside_circle(ring, stroke, minor_radius, ray, {lo, hi}, middle);
  const Sweep sweep(ring, stroke, minor_radius, ray, convex);
  Spans spans;
  const auto add = [&](double from, double to) {
    if (const std::optional<Span> s = sweep.span(from, to)) spans.add(s->from, s->to);
  };
  if (convex || middle <= lo || middle >= hi) {
    add(lo, hi);
  } else {
    add(lo, middle);
    add(middle, hi);
  }
  return spans;
}

Spans swept_spans(
    const ConeShape& cone, const Stroke& stroke, double minor_radius, const Ray& ray, double lo, double hi) {
  Spans spans;
  if (const auto s = Sweep(cone, stroke, minor_radius, ray, true).span(lo, hi)) spans.add(s->from, s->to);
  return spans;
}

double least_distance(const RingShape& ring, const Stroke& stroke, double minor_radius, const Vec3& point) {
  return Sweep(ring, stroke, minor_radius, Ray{point, Vec3::UnitZ()}, true).nearest(0).distance;
}
double least_distance(const ConeShape& cone, const Stroke& stroke, double minor_radius, const Vec3& point) {
  return Sweep(cone, stroke, minor_radius, Ray{point, Vec3::UnitZ()}, true).nearest(0).distance;
}

}  // namespace mpm
