// A kernel: compiled once for each instruction set (native/cmake/kernels.cmake). With AVX-512 the vectors are
// as wide as AVX2's: there are twice as many registers, and masks of their own.
#include "mpm/removal/ring_cut.h"

#include "mpm/base/lanes.h"

namespace mpm::MPM_ISA {
namespace {

constexpr double kRayStep = 5e-7;      // mm: a Newton step along the ray shorter than this was the last
constexpr double kTimeEpsilon = 1e-9;  // mm: ends of the stroke whose distances differ by less are as good
constexpr double kTimeStep = 1e-7;     // mm of distance: what a last step over time may have gained
constexpr double kGained = 4;          // so many times twice what a Newton step promises is never gained
constexpr double kNoBound = 1e9;       // 1/mm: a bend of which nothing is known
// mm of distance: a cut that another stroke makes again is clear. On rays steeper than kSteep it is less than
// kRayEpsilon along the ray.
constexpr double kClear = -1e-7;
constexpr double kSteep = 0.15;        // mm of distance a mm of ray: flatter entries are left to others
constexpr double kCurved = 1e-6;       // 1/mm: less bend over time is none
constexpr double kLeastSize = 1e-100;  // mm: instead of 0, so that there is an inverse
constexpr int kSteps = 7;

struct Pose {
  Vector center, axis, center_rate, axis_rate;
};

Pose end_pose(const RingStroke::Pose& p) {
  return {all_of(p.center), all_of(p.axis), all_of(p.center_rate), all_of(p.axis_rate)};
}

// As Stroke::at.
Pose pose_at(const RingStroke& ring, Lanes time) {
  const Lanes angle = all(ring.angle), x = time * angle, q = x * x;
  const Lanes s = x * (1 - q / 6 * (1 - q / 20 * (1 - q / 42)));
  const Lanes c = 1 - q / 2 * (1 - q / 12 * (1 - q / 30));
  const Vector axis = all_of(ring.axis), side = all_of(ring.side), travel = all_of(ring.travel);
  const Vector now = c * axis + s * side, rate = angle * (c * side - s * axis);
  const Lanes minor = all(ring.minor);
  return {all_of(ring.tip) + time * travel + minor * now, now, travel + minor * rate, rate};
}

// The distance of points from the ring and how it changes.
struct Reading {
  Lanes distance;        // mm
  Lanes rate;            // per unit of time
  Lanes slope;           // per mm of the ray
  Lanes radius, height;  // of the point in the tool's frame, mm
  Lanes lever;           // mm, not less than from the torus centre
  Lanes climb;           // mm that the torus centre goes along the axis in a unit of time
};

// The parts of a reading that its second derivatives need.
struct Parts {
  Vector velocity;       // of the tool at the point
  Lanes nr, nz;          // the distance's gradient
  Lanes vr, vz, dr, dz;  // velocity and ray in the half-plane of the point
  Lanes inverse_radius, inverse_size;
};

// Inlined: most callers do not want the parts.
[[gnu::always_inline]] inline Reading read(
    const RingStroke& ring, const Vector& point, const Vector& direction, const Pose& pose, Parts& k) {
  const Vector u = point - pose.center;
  const Lanes z = dot(u, pose.axis), turn = dot(u, pose.axis_rate), least_size = all(kLeastSize);
  const Vector w = u - z * pose.axis;
  const Lanes r = most(norm(w), least_size), rho = r - ring.major;
  const Lanes size = most(hypotenuse(rho, z), least_size);
  const Lanes inverse = 1 / (r * size);
  k.inverse_radius = inverse * size, k.inverse_size = inverse * r;
  k.nr = rho * k.inverse_size, k.nz = z * k.inverse_size;
  k.dz = dot(direction, pose.axis), k.dr = dot(direction, w) * k.inverse_radius;
  k.velocity = pose.center_rate + z * pose.axis_rate - turn * pose.axis;
  const Lanes climb = dot(pose.center_rate, pose.axis);
  k.vz = climb - turn, k.vr = dot(k.velocity, w) * k.inverse_radius;
  const Lanes rate = -(k.nr * k.vr + k.nz * k.vz), slope = k.nr * k.dr + k.nz * k.dz;
  return {size - ring.minor, rate, slope, r, z, r + absolute(z), absolute(climb)};
}

// Second derivatives: over time, and over time and ray. Those of a tool that does not turn.
struct Bend {
  Lanes time, mixed;
};

Bend bend(const Vector& direction, const Parts& k) {
  const Lanes vt = k.nr * k.vz - k.nz * k.vr, dt = k.nr * k.dz - k.nz * k.dr;
  const Lanes around = k.nr * k.inverse_radius;
  const Lanes vp_vp = most(dot(k.velocity, k.velocity) - k.vr * k.vr - k.vz * k.vz, all(0));
  const Lanes dp_vp = dot(direction, k.velocity) - k.dr * k.vr - k.dz * k.vz;
  return {vt * vt * k.inverse_size + around * vp_vp, -(dt * vt * k.inverse_size + around * dp_vp)};
}

// A point at both ends of the stroke.
struct Ends {
  Reading a, b;
};

Ends read_ends(const RingStroke& ring, const Vector& point, const Vector& direction, const Pose (&ends)[2]) {
  Parts unused;
  return {read(ring, point, direction, ends[0], unused), read(ring, point, direction, ends[1], unused)};
}

Mask brackets(const Ends& at) { return (at.a.rate < 0) & (at.b.rate > 0); }

// No point at this distance from the torus centre moves farther against the tool during the stroke, mm.
Lanes motion(const RingStroke& ring, Lanes lever) { return ring.length + ring.angle * (ring.minor + lever); }

// Rays near one ray: see BundleBatch.
struct Near {
  Lanes radius, along, spread;
};

// Are all points farther down the rays also farther from the ring, all through the half of the stroke that
// begins or ends here? See recedes of swept_piece.cpp.
Mask recedes(const RingStroke& ring, const Reading& at, Lanes rise, const Near& near) {
  const Lanes c = rise - near.spread - ring.angle;
  const Lanes lever = at.lever + near.radius;
  const Lanes climb = at.climb + ring.angle * (ring.length + lever);
  const Lanes fall = -at.height - near.radius - 0.5 * climb;
  const Lanes aside = absolute(at.radius - ring.major) + near.radius + 0.5 * motion(ring, lever);
  return (c > 0) & (fall > 0) & (c * c * fall * fall >= (1 - c * c) * aside * aside);
}

Mask recedes(const RingStroke& ring,
             const Ends& at,
             const Vector& direction,
             const Pose (&ends)[2],
             const Near& near) {
  return recedes(ring, at.a, dot(direction, ends[0].axis), near) &
         recedes(ring, at.b, dot(direction, ends[1].axis), near);
}

// By how much less than at the middle ray's end the distance may be at the others', by its gradient there.
Lanes nearby(const Reading& at, const Near& near) {
  return root(most(1 - at.slope * at.slope, all(0))) * near.radius + absolute(at.slope) * near.along;
}

Lanes most_lever(const Ends& at) { return most(at.a.lever, at.b.lever); }

// How strongly the distance may curve downwards within `reach` mm of the point, at both ends, 1/mm.
Lanes concavity(const RingStroke& ring, const Ends& at, Lanes reach) {
  const Lanes radius = least(at.a.radius, at.b.radius) - reach, inside = ring.major - radius;
  const Lanes concave = inside / (radius * most(all(ring.minor), inside));
  return inside <= 0 ? all(0) : radius > 0 ? concave : all(kNoBound);
}

// Where the tangents at both ends meet.
Lanes meeting(const Ends& at, Lanes a, Lanes b) {
  return a + at.a.rate * (b - at.b.rate - a) / (at.a.rate - at.b.rate);
}

// How strongly the distance may curve downwards over time by the turning of points at this lever.
Lanes turning(const RingStroke& ring, Lanes lever) { return ring.angle * ring.angle * lever; }

// Lower bounds of the distance during the whole stroke, of a point and of the upper ends of all rays of a
// bundle: docs/removal.md, "Four rays at once".
Lanes time_bound(const RingStroke& ring, const Ends& at) {
  const Lanes a = at.a.distance, b = at.b.distance, lever = most_lever(at), way = motion(ring, lever);
  const Mask between = brackets(at);
  if (lane_bits(between) == 0) return least(a, b);
  const Lanes bound = meeting(at, a, b) - 0.5 * (concavity(ring, at, way) * way * way + turning(ring, lever));
  return between ? most(bound, 0.5 * (a + b - way)) : least(a, b);
}

Lanes time_bound(const RingStroke& ring, const Ends& at, const Near& near) {
  const Lanes a = at.a.distance - nearby(at.a, near), b = at.b.distance - nearby(at.b, near);
  const Lanes lever = most_lever(at) + near.radius, way = motion(ring, lever), reach = near.radius + way;
  const Lanes by_motion = 0.5 * (at.a.distance + at.b.distance - way) - near.radius;
  const Lanes curve = concavity(ring, at, reach);
  // How much the rates of the others may differ from those of the middle one: the distance's gradient turns,
  // and a turning tool is not equally fast everywhere.
  const Lanes bend =
      least(least(at.a.distance, at.b.distance) + ring.minor, least(at.a.radius, at.b.radius)) - near.radius;
  const Lanes other = bend > 0 ? way * near.radius / bend + ring.angle * near.radius : all(kNoBound);
  const Mask ends_only = (at.a.rate >= other) | (at.b.rate <= -other);
  const Lanes convex = at.a.rate >= 0 ? a : at.b.rate <= 0 ? b : meeting(at, a, b);
  const Lanes between = convex - 0.5 * (curve * reach * reach + turning(ring, lever));
  const Lanes at_ends = least(a, b) - 0.5 * curve * near.radius * near.radius;
  return most(by_motion, ends_only ? at_ends : between);
}

// Where on each ray, and when, the distance and its rate are zero.
struct Entry {
  Lanes t, time;
  Lanes slope, radius;
  Mask found;
  Mask clear;  // the ring keeps clear of the point looked at first
};

Lanes first_time(const Ends& at) {
  const Lanes zero = all(0), one = all(1);
  return brackets(at) ? at.a.rate / (at.a.rate - at.b.rate) : at.a.distance <= at.b.distance ? zero : one;
}

// Newton steps in both unknowns from the point at t; where the ring keeps clear of that a lane of
// `ends_there` is done with. Where the distance does not curve upwards over time its least is at an end.
Entry enter(const RingStroke& ring,
            const Vector& origin,
            const Vector& direction,
            Lanes t,
            const Ends& first,
            Mask wanted,
            Mask ends_there) {
  const Lanes zero = all(0), one = all(1);
  const Mask none = wanted & 0;
  Entry e{t, first_time(first), zero, zero, none, none};
  for (int n = 0; n < kSteps; ++n) {
    Parts k;
    const Reading now = read(ring, origin + e.t * direction, direction, pose_at(ring, e.time), k);
    const Bend curve = bend(direction, k);
    const Mask curved = curve.time > kCurved;
    const Lanes inverse = 1 / (curved ? curve.time : one);
    if (n == 0) {
      e.clear =
          ends_there & brackets(first) & curved & (now.distance > kGained * now.rate * now.rate * inverse);
      wanted &= ~e.clear;
    }
    const Lanes straight = -now.distance / now.slope;
    const Lanes newton = e.time - (now.rate + curve.mixed * straight) * inverse;
    const Lanes next = curved ? newton : now.rate < 0 ? one : now.rate > 0 ? zero : e.time;
    const Lanes time_step = most(zero, least(one, next)) - e.time;
    const Lanes gained = time_step * (now.rate + 0.5 * curve.time * time_step);
    const Lanes step = -(now.distance + gained) / (now.slope + curve.mixed * time_step);
    e.t += step, e.time += time_step;
    e.slope = now.slope, e.radius = now.radius;
    e.found = wanted & (absolute(step) < kRayStep) &
              (absolute(now.rate * time_step) + absolute(curve.time) * time_step * time_step < kTimeStep);
    if (lane_bits(wanted & ~e.found) == 0) break;
  }
  return e;
}

// Is the entry's time that of the least distance? As Sweep::least has it.
Mask least_in_time(const Ends& at, Lanes time) {
  const Lanes least_end = least(at.a.distance, at.b.distance) + kTimeEpsilon;
  return brackets(at) | ((time == 0) & (at.a.distance <= least_end)) |
         ((time == 1) & (at.b.distance <= least_end));
}

int clear(const RingStroke& ring, const BundleBatch& bundles) {
  const Vector direction = load(bundles.direction);
  const Near near{load(bundles.radius), load(bundles.along), load(bundles.spread)};
  const Pose ends[2] = {end_pose(ring.ends[0]), end_pose(ring.ends[1])};
  const Ends top = read_ends(ring, load(bundles.top), direction, ends);
  return lane_bits(recedes(ring, top, direction, ends, near) & (time_bound(ring, top, near) > kClear));
}

RingCut cut(const RingStroke& ring, RayBatch& rays, double below) {
  const Vector origin = load(rays.origin), direction = load(rays.direction);
  const Lanes height = load(rays.height), zero = all(0);
  const Pose ends[2] = {end_pose(ring.ends[0]), end_pose(ring.ends[1])};
  const Ends top = read_ends(ring, origin + height * direction, direction, ends);
  const Near alone{zero, zero, zero};
  const Mask receding = recedes(ring, top, direction, ends, alone);
  Mask clear = (height <= -below) | (receding & (time_bound(ring, top) > kClear));
  if (lane_bits(~clear) == 0) return {0, 0};
  // From the upper end, if the way down leads out of the ring, else from the true surface.
  const Mask inward =
      (top.a.height < 0) & (top.b.height < 0) & (top.a.slope < -kSteep) & (top.b.slope < -kSteep);
  const bool all_inward = lane_bits(~clear & ~inward) == 0;
  const Lanes start = inward ? height : least(height, zero);
  const Ends first = all_inward ? top : read_ends(ring, origin + start * direction, direction, ends);
  const Entry e = enter(ring, origin, direction, start, first, ~clear, receding & (start == height));
  clear |= e.clear;
  if (lane_bits(~clear) == 0) return {0, 0};
  const Ends at = read_ends(ring, origin + e.t * direction, direction, ends);
  // From a point that far above the entry the tool is not left again.
  const Lanes stays = -e.slope * ring.minor * e.radius / (e.radius + ring.minor);
  const Mask sure = e.found & (e.slope < -kSteep) & least_in_time(at, e.time) &
                    recedes(ring, at, direction, ends, alone) & (e.t > -below);
  const Mask lower = e.t < height;
  const Mask lowered = sure & lower & (least(height, zero) - e.t < stays);
  const Mask undecided = ~clear & ~lowered & ~(sure & ~lower);
  store(rays.height, lowered ? e.t : height);
  return {lane_bits(lowered), lane_bits(undecided)};
}

}  // namespace

const RingCutter kRingCutter{clear, cut};

}  // namespace mpm::MPM_ISA
