// The first touch of an approach, found with the judge. Note: docs/methods/exact.md.
#pragma once

#include <vector>

#include "mpm/contact/first_arrival.h"
#include "mpm/gouge/certify_pose.h"
#include "mpm/positioning/method.h"

namespace mpm {

// A pose and the certificate of that very pose, made together; there is no other way to get one. Requires
// what certify_pose() does.
class JudgedPose {
 public:
  JudgedPose(const CellTree& tree, const Tool& tool, const ToolPose& at, const CertifyPoseOptions& options)
      : pose_(at), certificate_(certify_pose(tree, tool, at, options)) {}

  const ToolPose& pose() const { return pose_; }
  const PoseCertificate& certificate() const { return certificate_; }
  bool is_free() const { return certificate_.verdict == Verdict::free; }

 private:
  ToolPose pose_;
  PoseCertificate certificate_;
};

// Where a search for the first arrival starts: a surface point.
struct Start {
  std::uint32_t face;
  double u, v;
  Vec3 s;
};

struct Touch {
  std::uint32_t face = 0;
  PatchMinimum at;    // its value: the approach's parameter
  bool body = false;  // with the flat bottom, the flutes, the shank or the holder, not with the ring
  bool found() const { return at.value < kInfinity; }
};

// Where an approach ends.
struct Stop {
  double x;    // the approach's parameter
  Touch last;  // what stopped it; not found: nothing did
  JudgedPose judged;
};

// Where the approach is asked to stop.
struct Descent {
  double most;                  // the approach's parameter: the end of the motion's range
  double least;                 // where the motion begins: nothing below it is a pose
  double from;                  // where the search starts: at `most`, or at a touch that is known before it
  Touch last;                   // that touch, if there is one
  const Touch* kept = nullptr;  // the contact that the motion keeps, if it keeps one: never what stops it
};

// Requires: the tree is that of the tool's judge_cells(); tree and tool outlive it.
//
// Threads: any number may share one.
class FirstTouch {
 public:
  // gouge_tolerance: mm, of the certificates; cell_budget: cells of one descent.
  FirstTouch(const CellTree& tree, const Tool& tool, double gouge_tolerance, std::uint32_t cell_budget);

  // Centres of the cells of about a quarter of the cutter's radius that may lie under the upright tool over
  // `at`, and of those within `reach` mm of a point.
  void starts_under(const Vec2& at, std::vector<Start>& starts) const;
  void starts_round(const Vec3& center, double reach, std::vector<Start>& starts) const;

  // The arrival of the start that arrives first, refined; not found when none arrives before `limit`.
  template <Approach A>
  Touch best_start(const A& approach,
                   const std::vector<Start>& starts,
                   double limit,
                   Counters& counters) const;

  // The first arrival on a face near (u, v), by first_arrival(). Adds to the counters, as all that follow.
  template <Approach A>
  Touch refine(const A& approach, std::uint32_t face, double u, double v, Counters& counters) const;

  // Comes down to the first touch: the judge looks at the pose at x; where it finds surface inside the tool,
  // the first arrival near that point is the next x, until it finds none. Where faces meet, their borders
  // differ by what their polygons may, and the nearest arrival may be on the wrong one: then the point's own
  // arrival is taken, a few times; what is left is good to half the tolerance. So is what touches the rest of
  // the body, at its deepest point each time. Where even the beginning of the motion is blocked, the greatest
  // x at which the tool is free is looked for.
  //
  // Guarantees: x is within [descent.least, descent.most]; the judged pose is that at x.
  //
  // Fails: the judged pose is not free when the budget ran out, or where no free one was found; then it is
  // that at descent.least or where the search gave up.
  template <Approach A>
  Stop operator()(const A& approach, const Descent& descent, Counters& counters) const;

  // mm: contacts nearer to each other than this are one. P's own arrival is 0/0 and, next to P, all rounding.
  double merged() const;
  bool same_contact(const Touch& a, const Touch& b) const { return (a.at.s - b.at.s).norm() < merged(); }
  // mm above the highest surface: the beginning of a drop.
  double highest_drop() const;

 private:
  template <class Near>
  void gather_starts(const Near& near, std::vector<Start>& starts) const;
  template <Approach A>
  double body_arrival(const A& approach, double x, double least, const Vec3& s) const;
  template <Approach A>
  Stop judged(
      const A& approach, double x, const Touch& last, CertifyPoseOptions& options, Counters& counters) const;
  template <Approach A>
  Touch earlier(const A& approach, double x, const Witness& w, const Touch& ring, bool by_point) const;
  template <Approach A>
  Stop come_down(const A& approach,
                 const Descent& descent,
                 CertifyPoseOptions& options,
                 Counters& counters) const;
  template <Approach A>
  Stop highest_free(const A& approach,
                    const Descent& descent,
                    const Stop& blocked,
                    CertifyPoseOptions& options,
                    Counters& counters) const;

  const CellTree& tree_;
  const Tool& tool_;
  double noise_;  // mm: depths down to this are rounding
  CertifyPoseOptions judge_;
};

extern template Touch FirstTouch::best_start(const Drop&, const std::vector<Start>&, double, Counters&) const;
extern template Touch FirstTouch::best_start(const Tilt&, const std::vector<Start>&, double, Counters&) const;
extern template Touch FirstTouch::refine(const Drop&, std::uint32_t, double, double, Counters&) const;
extern template Touch FirstTouch::refine(const Tilt&, std::uint32_t, double, double, Counters&) const;
extern template Stop FirstTouch::operator()(const Drop&, const Descent&, Counters&) const;
extern template Stop FirstTouch::operator()(const Tilt&, const Descent&, Counters&) const;

}  // namespace mpm
