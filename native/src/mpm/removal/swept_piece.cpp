#include "mpm/removal/swept_piece.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace mpm {
namespace {

constexpr double kTimeEpsilon = 1e-9;  // mm by which the least distance over time may be too large
constexpr int kTimeSteps = 12, kHintSteps = 3, kRaySteps = 60, kRootSteps = 60;
constexpr double kLookBeyond = 0.25;  // of a Newton step: how much farther to look for a point outside
constexpr double kBowTie = 1e-4;      // mm: how far turning may carry a point aside before it is heeded
constexpr double kParallel = 1e-9;    // 1 - cos^2 of the angle between ray and axis

// Distance from a body of revolution at radius r and height z, and its gradient there.
ConeDistance distance_at(const RingShape& ring, double r, double z) {
  const double rho = r - ring.major, size = hypotenuse(rho, z);
  if (size == 0) return {-ring.minor, 1, 0};
  return {size - ring.minor, rho / size, z / size};
}
ConeDistance distance_at(const ConeShape& cone, double r, double z) {
  return cone_distance(r, z, cone.r0, cone.r1, cone.z0, cone.z1);
}

struct Reading {
  double distance;  // mm
  double rate;      // per unit of time
  double slope;     // per mm of the ray
  double radius;    // mm from the axis
};

// How strongly the distance may curve downwards over the stroke's time (per unit of time squared) at points
// at least `radius` from the axis and outside the shape: it is convex but inside the ring's circle, and but
// for the turning.
double concavity(const RingShape& ring, double motion, double radius) {
  if (radius >= ring.major) return 0;
  const double size = std::max(ring.minor, ring.major - radius);
  return radius > 0 ? motion * motion * (ring.major - radius) / (radius * size) : kInfinity;
}
double concavity(const ConeShape&, double, double) { return 0; }

// A lower bound of the distance at all times from the readings at both ends: where their tangents meet, less
// what the distance may curve down in between; and it changes by no more than the motion.
template <class Shape>
double time_bound(
    const Shape& shape, const Stroke& stroke, const Vec3& point, const Reading& a, const Reading& b) {
  const double lever = (point - stroke.middle.center).norm() + stroke.length;
  const double motion = stroke.motion(lever);
  const double by_motion = 0.5 * (a.distance + b.distance - motion);
  const double curve = concavity(shape, motion, std::min(a.radius, b.radius) - 0.5 * motion) +
                       stroke.angle * stroke.angle * lever;
  double meeting = std::min(a.distance, b.distance);
  if (a.rate < 0 && b.rate > 0)
    meeting = a.distance + a.rate * (b.distance - b.rate - a.distance) / (a.rate - b.rate);
  return std::max(by_motion, meeting - curve / 8);
}

template <class Shape>
Reading read_shape(const Shape& shape, const Vec3& point, const Vec3& direction, const StrokePose& pose) {
  const Vec3 u = point - pose.center;
  const double z = u.dot(pose.axis);
  const Vec3 w = u - z * pose.axis;
  const double r = w.norm(), inverse = r > 0 ? 1 / r : 0;
  const ConeDistance d = distance_at(shape, r, z);
  const Vec3 gradient = (d.slope_r * inverse) * w + d.slope_z * pose.axis;
  const double turn = (d.slope_z - d.slope_r * z * inverse) * u.dot(pose.axis_rate);
  return {d.distance, turn - gradient.dot(pose.center_rate), gradient.dot(direction), r};
}

// Is every point of the ray from `point` along `way`, away from the tool's tip, farther from the ring's
// circle than `point` at all times of the stroke? With |z| growing by c at least and |r - Ro| falling by s at
// most for each mm the sum of their squares stays above that at the start when c |z| >= s |r - Ro| there.
bool recedes(const RingShape& ring, const Stroke& stroke, const Vec3& point, const Vec3& way) {
  for (const StrokePose& pose : stroke.ends) {
    const Vec3 u = point - pose.center;
    const double z = u.dot(pose.axis), c = -way.dot(pose.axis) - stroke.angle;
    if (z >= 0 || c <= 0) return false;
    const double s = std::sqrt(1 - c * c), margin = 0.5 * stroke.motion(u.norm());
    const double rho = std::abs((u - z * pose.axis).norm() - ring.major);
    if (c * (-z - margin) < s * (rho + margin)) return false;
  }
  return true;
}

template <class Shape>
class Sweep {
 public:
  // convex: the distance is, along the ray as far as it will be asked for.
  Sweep(const Shape& shape, const Stroke& stroke, const Ray& ray, bool convex)
      : shape_(shape), stroke_(stroke), ray_(ray), convex_(convex) {}

  // The swept span of lo <= t <= hi when it is one.
  std::optional<Span> span(double lo, double hi) {
    const Vec3 point = ray_.at(hi);
    const Reading a = read(point, stroke_.ends[0]), b = read(point, stroke_.ends[1]);
    if (time_bound(shape_, stroke_, point, a, b) > 0 &&
        (convex_ ? std::max(a.slope, b.slope) <= 0 : receding(hi, -1)))
      return {};
    const Reading top = least(point, a, b);
    if (top.distance <= 0) return Span{entry_below(lo, hi, top), hi};
    if (convex_ ? top.slope <= 0 : receding(hi, -1)) return {};
    const std::optional<double> to = march(hi, top, lo, -1);
    if (!to) return {};
    const std::optional<double> from = march(lo, nearest(lo), *to, 1);
    if (from) return Span{*from, *to};
    return {};
  }

  // The reading at the time of the stroke at which the distance of the point at t is least.
  Reading nearest(double t) {
    const Vec3 point = ray_.at(t);
    if (hint_.known)
      if (const std::optional<Reading> found = near_hint(point)) return *found;
    return least(point, read(point, stroke_.ends[0]), read(point, stroke_.ends[1]));
  }

 private:
  // The time of the last least distance, and how strongly the distance curves there over time (0: not known).
  struct Hint {
    bool known = false;
    double time = 0, curvature = 0;
  };

  Reading read(const Vec3& point, const StrokePose& pose) const {
    return read_shape(shape_, point, ray_.direction, pose);
  }

  // The least distance over time, from the readings at both ends; remembers where it was.
  Reading least(const Vec3& point, const Reading& a, const Reading& b) {
    if (a.rate < 0 && b.rate > 0) return between(point, a, b);
    const bool first = a.distance <= b.distance;
    hint_ = {!(a.rate > 0 && b.rate < 0), first ? 0.0 : 1.0, 0};
    return first ? a : b;
  }

  // Where its rate goes from negative to positive (Illinois).
  Reading between(const Vec3& point, const Reading& a, const Reading& b) {
    double ta = 0, tb = 1, ra = a.rate, rb = b.rate;
    Reading best = a.distance <= b.distance ? a : b;
    for (int step = 0; step < kTimeSteps; ++step) {
      const double tm = (ta * rb - tb * ra) / (rb - ra);
      const Reading m = read(point, stroke_.at(tm));
      if (m.distance < best.distance) best = m;
      const double curvature = (rb - ra) / (tb - ta);
      hint_ = {true, tm, curvature};
      if (m.rate * m.rate < 2 * kTimeEpsilon * curvature) return m;
      if (m.rate < 0) {
        ta = tm, ra = m.rate, rb *= 0.5;
      } else {
        tb = tm, rb = m.rate, ra *= 0.5;
      }
    }
    hint_.known = false;
    return best;
  }

  // The least distance, followed from the last one by Newton steps over time; none when that does not lead
  // there soon.
  std::optional<Reading> near_hint(const Vec3& point) {
    double time = hint_.time;
    Reading now = read_at(point, time);
    for (int step = 0; step < kHintSteps; ++step) {
      if ((time == 0 && now.rate >= 0) || (time == 1 && now.rate <= 0) ||
          now.rate * now.rate < 2 * kTimeEpsilon * hint_.curvature) {
        hint_.time = time;
        return now;
      }
      if (hint_.curvature <= 0) return {};
      const double next = std::clamp(time - now.rate / hint_.curvature, 0.0, 1.0);
      if (next == time) return {};
      const Reading then = read_at(point, next);
      const double curvature = (then.rate - now.rate) / (next - time);
      if (curvature <= 0) return {};
      hint_.curvature = curvature, time = next, now = then;
    }
    return {};
  }

  Reading read_at(const Vec3& point, double time) const {
    if (time == 0 || time == 1) return read(point, stroke_.ends[time == 1]);
    return read(point, stroke_.at(time));
  }

  // Where the span that contains hi begins.
  double entry_below(double lo, double hi, const Reading& top) {
    if (top.slope < 0) {
      // Where the distance is convex a Newton step from within ends outside; else it is the place to look
      // first.
      const double t = hi - top.distance / top.slope;
      if (convex_) {
        if (t > lo) return march(t, nearest(t), hi, 1).value_or(hi);
      } else if (const double guess = t - kLookBeyond * (hi - t); guess > lo) {
        const Reading there = nearest(guess);
        if (there.distance > 0 && there.slope < 0) return zero_between(guess, there, hi, top);
      }
    }
    return march(lo, nearest(lo), hi, 1).value_or(hi);
  }

  // First t from `t` towards `limit` at which the shape has swept; `sense` is the sign of that way.
  std::optional<double> march(double t, Reading now, double limit, double sense) {
    for (int n = 0; n < kRaySteps; ++n) {
      if (now.distance <= 0) return t;
      const double closing = -now.slope * sense;
      if (closing <= 0 && (convex_ || receding(t, sense))) return {};
      const double step = std::max(closing > 0 ? now.distance / closing : now.distance, kRayEpsilon);
      const bool past = step >= (limit - t) * sense;
      if (past && convex_) return {};
      const double next = past ? limit : t + sense * step;
      const Reading then = nearest(next);
      if (then.distance < 0) return zero_between(t, now, next, then);
      if (!convex_ && closing > 0 && then.slope * sense > 0)
        if (const std::optional<double> in = inside_between(t, now, next, then))
          return zero_between(t, now, *in, nearest(*in));
      if (past) return {};
      if (step <= kRayEpsilon && convex_) return next;
      t = next, now = then;
    }
    return {};
  }

  // A point inside, between two outside from which the distance falls towards each other; none when there is
  // none.
  std::optional<double> inside_between(double ta, Reading a, double tb, Reading b) {
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

  // Is the point at t outside, and every point farther that way?
  bool receding(double t, double sense) const {
    if constexpr (std::is_same_v<Shape, RingShape>)
      return recedes(shape_, stroke_, ray_.at(t), sense * ray_.direction);
    else
      return false;
  }

  // The zero between a point outside and one inside: Newton steps from the outer one, halving where they
  // leave the bracket; the outer end of what is left of it.
  double zero_between(double outside, Reading out, double inside, const Reading& in) {
    double t = outside - (inside - outside) * out.distance / (in.distance - out.distance);
    for (int n = 0; n < kRootSteps; ++n) {
      const Reading now = nearest(t);
      (now.distance > 0 ? outside : inside) = t;
      const double lo = std::min(inside, outside), hi = std::max(inside, outside);
      const double step = now.slope != 0 ? -now.distance / now.slope : kInfinity;
      const double newton = t + step;
      if (std::abs(step) < kRayEpsilon || hi - lo < kRayEpsilon) return std::clamp(newton, lo, hi);
      t = newton > lo && newton < hi ? newton : 0.5 * (lo + hi);
    }
    return outside;
  }

  Shape shape_;
  const Stroke& stroke_;
  const Ray& ray_;
  bool convex_;
  Hint hint_;
};

// Where the ray comes nearest to the axis, half way through the stroke; infinity when it runs along the axis.
double crossing(const Stroke& stroke, const Ray& ray) {
  const StrokePose& pose = stroke.middle;
  const Vec3 u = ray.origin - pose.center;
  const double along = ray.direction.dot(pose.axis), across = 1 - along * along;
  if (across < kParallel) return kInfinity;
  return (u.dot(pose.axis) * along - u.dot(ray.direction)) / across;
}

// Does lo <= t <= hi of the ray keep out of the ring's circle during the whole stroke?
bool outside_circle(
    const RingShape& ring, const Stroke& stroke, const Ray& ray, const Span& part, double middle) {
  const StrokePose& pose = stroke.middle;
  const Vec3 nearest = ray.at(std::clamp(middle, part.from, part.to)) - pose.center;
  const double r = nearest.cross(pose.axis).norm();
  const double farthest =
      std::max((ray.at(part.from) - pose.center).norm(), (ray.at(part.to) - pose.center).norm());
  return r - 0.5 * (pose.center_rate.norm() + stroke.angle * farthest) > ring.major;
}

// A stroke that stays in one pose.
Stroke standing(const Stroke& stroke, const StrokePose& pose) {
  const StrokePose still{pose.center, pose.axis, Vec3::Zero(), Vec3::Zero()};
  const Vec3 tip = pose.center - stroke.minor_radius * pose.axis;
  return {tip,
          Vec3::Zero(),
          pose.axis,
          Vec3::Zero(),
          0,
          stroke.move,
          stroke.minor_radius,
          0,
          {still, still},
          still};
}

// Does the ring keep clear of the ray's point at `hi` during the whole stroke, and do all lower points lie
// farther from it?
bool clear_below(const RingShape& ring, const Stroke& stroke, const Ray& ray, double hi) {
  const Vec3 u = ray.at(hi) - stroke.middle.center;
  const double z = u.dot(stroke.middle.axis), rise = ray.direction.dot(stroke.middle.axis);
  const double lever = u.norm() + stroke.length, margin = 0.5 * stroke.motion(lever);
  const double c = rise - 0.5 * stroke.angle;
  if (z >= -margin || c <= 0) return false;
  const double r = std::sqrt(std::max(u.squaredNorm() - z * z, 0.0)), rho = std::abs(r - ring.major);
  // See recedes: the same for all times at once.
  const double fall = -z - margin, aside = rho + margin;
  if (c * c * fall * fall < (1 - c * c) * aside * aside) return false;
  const double distance = hypotenuse(rho, z) - ring.minor;
  if (distance > margin) return true;
  // Of a function that is convex in place and time the tangent is a lower bound.
  const Reading middle = read_shape(ring, ray.at(hi), ray.direction, stroke.middle);
  const double tangent = distance - 0.5 * std::abs(middle.rate);
  return tangent - 0.5 * concavity(ring, margin, r - margin) - stroke.angle * stroke.angle * lever / 8 > 0;
}

}  // namespace

Span clipped(const Ray& ray, const Span& span, const Box3& box) {
  Span part = span;
  for (int k = 0; k < 3; ++k) {
    const double d = ray.direction[k], lo = box.lo[k] - ray.origin[k], hi = box.hi[k] - ray.origin[k];
    if (d == 0) {
      if (lo > 0 || hi < 0) return {1, 0};
      continue;
    }
    part.from = std::max(part.from, (d > 0 ? lo : hi) / d);
    part.to = std::min(part.to, (d > 0 ? hi : lo) / d);
  }
  return part;
}

Spans swept_spans(const RingShape& ring, const Stroke& stroke, const Ray& ray, double lo, double hi) {
  if (clear_below(ring, stroke, ray, hi)) return {};
  const double middle = crossing(stroke, ray);
  const bool convex = ring.major == 0 || outside_circle(ring, stroke, ray, {lo, hi}, middle);
  Sweep sweep(ring, stroke, ray, convex && stroke.angle * ring.major < kBowTie);
  Spans spans;
  if (convex || middle <= lo || middle >= hi) {
    spans.add(sweep.span(lo, hi));
  } else {
    spans.add(sweep.span(lo, middle));
    spans.add(sweep.span(middle, hi));
  }
  return spans;
}

Spans swept_spans(const ConeShape& cone, const Stroke& stroke, const Ray& ray, double lo, double hi) {
  Spans spans;
  const std::optional<Span> swept = Sweep(cone, stroke, ray, true).span(lo, hi);
  spans.add(swept);
  const double lever = std::max(std::abs(cone.z0), std::abs(cone.z1));
  const bool whole = swept && swept->from <= lo && swept->to >= hi;
  // What a turning cone sweeps is waisted, and a ray along it may lose its way: the cone at both ends is
  // convex.
  if (!whole && stroke.angle * lever > kBowTie)
    for (const StrokePose& pose : stroke.ends)
      spans.add(Sweep(cone, standing(stroke, pose), ray, true).span(lo, hi));
  return spans;
}

double least_distance(const RingShape& ring, const Stroke& stroke, const Vec3& point) {
  return Sweep(ring, stroke, Ray{point, Vec3::UnitZ()}, true).nearest(0).distance;
}
double least_distance(const ConeShape& cone, const Stroke& stroke, const Vec3& point) {
  return Sweep(cone, stroke, Ray{point, Vec3::UnitZ()}, true).nearest(0).distance;
}

}  // namespace mpm
