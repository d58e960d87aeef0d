// A position that is claimed proven is so: judged again from nothing, and by points of the surface.
#include <gtest/gtest.h>

#include "mpm/contact/insert.h"
#include "mpm/gouge/certify_pose.h"
#include "mpm/gouge/judge_cells.h"
#include "mpm/positioning/place_all.h"
#include "mpm/positioning/registry.h"
#include "positioning/random_cases.h"

namespace mpm {
namespace {

using testing::CaseMaker;
using testing::kHalf;

constexpr int kRounds = 2;             // of all grounds with all cutters
constexpr int kStarts = 6;             // points, and as many given contacts, a ground and cutter
constexpr int kGrid = 96;              // intervals a side of a face, for the points
constexpr double kTolerance = 1e-3;    // mm: exact's default
constexpr double kArithmetic = 1e-9;   // mm
constexpr double kJudgeAgain = 1e-12;  // mm: the same sums in another order

// Signed distance of s from ring, flutes and core as the drawing of the tool has them; shank and holder left
// out, as is the hollow. Apart from tool.cpp on purpose.
double drawn_distance(const Tool& tool, const ToolPose& pose, const Vec3& s) {
  const Vec3 x = s - pose.torus_center;
  const double z = x.dot(pose.axis), r = x.cross(pose.axis).norm();
  const double ring = std::hypot(r - tool.major_radius, z) - tool.minor_radius;
  const double top = tool.flute_length - tool.minor_radius;
  const double flutes = std::max({r - tool.radius(), -z, z - top});
  const double core = tool.recess < tool.minor_radius
                          ? std::max({r - tool.major_radius, tool.recess - tool.minor_radius - z, z - top})
                          : kInfinity;
  return std::min({ring, flutes, core});
}

double deepest_point(const SurfaceModel& model, const Tool& tool, const ToolPose& pose) {
  double least = kInfinity;
  for (const Face& face : model.faces()) {
    const ParamBox& d = face.surface.domain();
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; j <= kGrid; ++j) {
        const double u = d.u0 + (d.u1 - d.u0) * i / kGrid, v = d.v0 + (d.v1 - d.v0) * j / kGrid;
        least = std::min(least, drawn_distance(tool, pose, face.surface.point(u, v)));
      }
  }
  return least;
}

bool is_claimed(const Placement& p) {
  return p.status != PositionStatus::not_computed && p.status != PositionStatus::off_part &&
         p.status != PositionStatus::undecided;
}

struct Tally {
  int placed = 0, claimed = 0, spun = 0, bridged = 0, twice = 0, fallen = 0;
};

// Judges `p` again; `cells` are not those that it was found with.
void judge(const CellTree& cells, const Tool& tool, const Placement& p, Tally& tally) {
  ++tally.placed;
  if (!p.pose.axis.allFinite()) return;
  const double depth = deepest_point(cells.model(), tool, p.pose);
  bool good = depth >= p.clearance_lo - kArithmetic;  // of undecided ones too: the bound is of this pose
  if (is_claimed(p)) {
    ++tally.claimed;
    tally.bridged += p.status == PositionStatus::bridged;
    tally.twice += p.status == PositionStatus::two_contacts;
    CertifyPoseOptions options;
    options.tolerance = options.sharpness = kTolerance;
    const PoseCertificate again = certify_pose(cells, tool, p.pose, options);
    good = good && p.clearance_lo >= -kTolerance && again.verdict == Verdict::free &&
           again.hi >= p.clearance_lo - kJudgeAgain;
  }
  tally.fallen += !good;
  EXPECT_TRUE(good) << kPositionStatusNames[int(p.status)] << " spin " << degrees(p.spin) << " tilt "
                    << degrees(p.tilt) << " claimed " << p.clearance_lo << " deepest point " << depth;
}

GivenContact random_contact(CaseMaker& maker, const SurfaceModel& model) {
  const double face = maker.uniform(0, double(model.faces().size())), turn = maker.uniform(-kPi, kPi);
  return {std::uint32_t(face),
          maker.uniform(0.1, 0.9),
          maker.uniform(0.1, 0.9),
          Vec3(std::cos(turn), std::sin(turn), 0)};
}

void run(testing::Ground ground, testing::Cutter cutter, CaseMaker& maker, Tally& tally) {
  const SurfaceModel model = maker.ground(ground);
  const Tool tool = maker.tool(cutter);
  const auto exact = make_method("exact", model, tool, {});
  const CellTree cells = judge_cells(model, tool);
  Counters work;
  for (int k = 0; k < kStarts; ++k) {
    const Vec2 at(maker.uniform(-0.7, 0.7) * kHalf, maker.uniform(-0.7, 0.7) * kHalf);
    const auto dropped = exact->drop(at, work);
    for (const double spin : {0.0, kPi, maker.uniform(-kPi, kPi)}) {
      judge(cells, tool, dropped->spun(spin, work), tally);
      tally.spun += spin != 0;
    }
    judge(cells, tool, exact->place(random_contact(maker, model), work), tally);
  }
}

TEST(Certificates, EveryProvenPositionIsProvenAgain) {
  CaseMaker maker(2024);
  Tally tally;
  for (int round = 0; round < kRounds; ++round)
    for (const testing::Ground ground : testing::kGrounds)
      for (const testing::Cutter cutter : testing::kCutters) run(ground, cutter, maker, tally);
  RecordProperty("placed", tally.placed), RecordProperty("claimed", tally.claimed);
  RecordProperty("fallen", tally.fallen);
  // That the cases are of use: most are claimed, and the kinds that matter are among them.
  EXPECT_GT(tally.claimed, tally.placed / 3);
  EXPECT_GT(tally.twice, 100);
}

// Steep walls all round: turned by half a turn, the tool would lie in the other wall. Its pose was called
// proven and lay a cutter's radius deep.
TEST(Certificates, ATroughWithTheToolTurnedRound) {
  const std::vector<double> knots_u{0, 0, 0, 1, 1, 1}, knots_v{0, 0, 1, 1};
  std::vector<Face> faces;
  faces.push_back({"Face1",
                   BSplineSurface(2,
                                  1,
                                  knots_u,
                                  knots_v,
                                  {Vec3(-30, 0, 45),
                                   Vec3(-30, 60, 45),
                                   Vec3(0, 0, -45),
                                   Vec3(0, 60, -45),
                                   Vec3(30, 0, 45),
                                   Vec3(30, 60, 45)}),
                   {},
                   false});
  const SurfaceModel model(std::move(faces));
  const Tool tool{6.7, 6, 6, 40, {}};
  const auto exact = make_method("exact", model, tool, {});
  const CellTree cells = judge_cells(model, tool);
  Counters work;
  Tally tally;
  for (const double x : {-6.0, 4.0, 9.0})
    for (const double spin : {0.0, 70.0, 120.0, 180.0, -90.0})
      judge(cells, tool, exact->drop(Vec2(x, 30), work)->spun(radians(spin), work), tally);
  // No tilt of the tool turned round is free: tried one by one.
  const Placement turned = exact->drop(Vec2(4, 30), work)->spun(kPi, work);
  EXPECT_EQ(turned.status, PositionStatus::undecided);
  EXPECT_LE(turned.clearance_lo, deepest_point(model, tool, turned.pose));
  const Vec3 o = turned.first_contact + tool.minor_radius * turned.first_normal;
  const Vec3 v1 = (turned.pose.torus_center - o) / tool.major_radius;
  const Insert insert{o, v1.cross(turned.pose.axis), v1, turned.pose.axis};
  for (int k = 0; k <= 200; ++k)
    EXPECT_LT(deepest_point(model, tool, tilted(tool, insert, (kPi / 4 - turned.tilt) * k / 200)),
              -kTolerance);
}

}  // namespace
}  // namespace mpm
