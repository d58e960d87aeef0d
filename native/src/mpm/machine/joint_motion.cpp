#include "mpm/machine/joint_motion.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/direction.h"
#include "mpm/base/frame.h"

namespace mpm {
namespace {

// A moving vector v(s), 0 <= s <= 1: its value and derivatives at s = 1/2, and bounds of the derivatives'
// norms over all s.
struct Moving {
  Vec3 at, first, second;
  double first_bound, second_bound, third_bound;
};

Moving resting(const Vec3& v) { return {v, Vec3::Zero(), Vec3::Zero(), 0, 0, 0}; }

Moving shifted(Moving v, const Vec3& middle, const Vec3& way) {
  v.at += middle;
  v.first += way;
  v.first_bound += way.norm();
  return v;
}

// c + R(s) (v(s) - c), with R the turn about an axis through c that stands at `middle` at s = 1/2 and turns
// by `turn` in all.
Moving turned(const Moving& v, const Vec3& axis, const Vec3& c, double middle, double turn) {
  const Vec3 arm = v.at - c, cross = axis.cross(arm);
  const auto rotate = rotation(axis, middle);
  const double w = std::abs(turn), distance = cross.norm() + v.first_bound / 2;  // from the axis, at any time
  return {c + rotate * arm,
          rotate * (v.first + turn * cross),
          rotate * (v.second + 2 * turn * axis.cross(v.first) + turn * turn * axis.cross(cross)),
          v.first_bound + w * distance,
          v.second_bound + 2 * w * v.first_bound + w * w * distance,
          v.third_bound + 3 * w * v.second_bound + 3 * w * w * v.first_bound + w * w * w * distance};
}

Moving turned_by(const Moving& v, const RotaryAxis& axis, const Vec3& c, double from, double to) {
  return turned(v, axis.rotation_vector, c, axis.angle((from + to) / 2), axis.sense * (to - from));
}

Moving turned_by(
    const Moving& v, const KinematicChain& chain, AxisRole role, const Vec2& from, const Vec2& to) {
  Moving result = v;
  for (int k = 1; k >= 0; --k)
    if (chain.rotary[k].role == role)
      result = turned_by(result, chain.rotary[k], chain.rotary[k].joint_origin, from[k], to[k]);
  return result;
}

Moving moving_tip(const KinematicChain& chain, const PartSetup& setup, const Joints& from, const Joints& to) {
  const Moving gauge = resting(-setup.tool_length * chain.spindle_axis);
  const Moving at_head = turned_by(gauge, chain, AxisRole::head_rotary, from.rotary, to.rotary);
  const Moving in_machine = shifted(at_head, (from.linear + to.linear) / 2, to.linear - from.linear);
  return turned_by(in_machine, chain, AxisRole::table_rotary, from.rotary, to.rotary);
}

Moving moving_axis(const KinematicChain& chain, const Vec2& from, const Vec2& to) {
  Moving axis = resting(chain.spindle_axis);
  for (int k = 1; k >= 0; --k) axis = turned_by(axis, chain.rotary[k], Vec3::Zero(), from[k], to[k]);
  return axis;
}

double off_chord(double second, double third_bound) { return second / 8 + third_bound / 48; }

double angle_of_chord(double chord) { return chord < 2 ? 2 * std::asin(chord / 2) : kPi; }

// The longer of the chords from where the tool stands to where it was meant to, at the two ends.
double end_chord(const KinematicChain& chain, const Vec2& from, const Vec2& to, const AxisWay& meant) {
  return std::max((tool_axis(chain, from) - meant.from).norm(), (tool_axis(chain, to) - meant.to).norm());
}

}  // namespace

double axis_end_error(const KinematicChain& chain, const Vec2& from, const Vec2& to, const AxisWay& meant) {
  return angle_of_chord(end_chord(chain, from, to, meant));
}

double axis_deviation_bound(const KinematicChain& chain,
                            const Vec2& from,
                            const Vec2& to,
                            const AxisWay& meant) {
  const double angle = angle_between(meant.from, meant.to);
  const Vec3 middle = great_circle(meant.from, meant.to, 0.5);  // a great circle g has g'' = -angle² g
  const Moving axis = moving_axis(chain, from, to);
  const double between =
      off_chord((axis.second + angle * angle * middle).norm(), axis.third_bound + angle * angle * angle);
  return angle_of_chord(end_chord(chain, from, to, meant) + between);
}

MotionDeviation deviation_bound(const KinematicChain& chain,
                                const PartSetup& setup,
                                const Joints& from,
                                const Joints& to,
                                const AxisWay& meant) {
  const Moving tip = moving_tip(chain, setup, from, to);
  return {off_chord(tip.second.norm(), tip.third_bound),
          axis_deviation_bound(chain, from.rotary, to.rotary, meant)};
}

}  // namespace mpm
