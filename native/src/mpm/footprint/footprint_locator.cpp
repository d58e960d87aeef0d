#include "mpm/footprint/footprint_locator.h"

#include "mpm/base/error.h"

namespace mpm {
namespace {

constexpr double kMaxSeeds = 4e6;
constexpr int kMaxPerSide = 512;  // samples along one side of a patch
constexpr int kNewtonSteps = 20;
constexpr double kOverFace = 1e-7;  // mm in plan: nearer than this is over the face
constexpr std::size_t kBestSeeds = 4;

// Longest control polygon of the patch along u and along v: an upper bound of its iso-lines' lengths.
Vec2 side_lengths(const BezierPatch& patch) {
  const auto point = [&](int i, int j) -> Vec3 {
    return patch.control(i, j).head<3>() / patch.control(i, j).w();
  };
  Vec2 longest = Vec2::Zero();
  for (int j = 0; j <= patch.degree_v(); ++j) {
    double length = 0;
    for (int i = 0; i < patch.degree_u(); ++i) length += (point(i + 1, j) - point(i, j)).norm();
    longest.x() = std::max(longest.x(), length);
  }
  for (int i = 0; i <= patch.degree_u(); ++i) {
    double length = 0;
    for (int j = 0; j < patch.degree_v(); ++j) length += (point(i, j + 1) - point(i, j)).norm();
    longest.y() = std::max(longest.y(), length);
  }
  return longest;
}

int intervals(double length, double spacing) {
  return std::clamp(int(std::ceil(std::min(length / spacing, double(kMaxPerSide)))), 1, kMaxPerSide);
}

double widened(const SurfaceModel& model, double spacing) {
  double area = 0;
  for (const PatchRef& p : model.patches()) area += side_lengths(*p.patch).prod();
  return std::max(spacing, std::sqrt(area / kMaxSeeds));
}

}  // namespace

FootprintLocator::FootprintLocator(const SurfaceModel& model, double spacing)
    : model_(model), spacing_(widened(model, spacing)), lo_(model.bounds().lo.head<2>()) {
  require(spacing > 0, "spacing must be positive");
  const Vec2 size = model.bounds().hi.head<2>() - lo_;
  spacing_ = std::max(spacing_, std::sqrt(size.prod() / kMaxSeeds));
  columns_ = std::size_t(std::floor(size.x() / spacing_)) + 1;
  rows_ = std::size_t(std::floor(size.y() / spacing_)) + 1;

  std::vector<Seed> all;
  for (const PatchRef& ref : model.patches()) {
    const ParamBox& box = ref.patch->box();
    const Vec2 sides = side_lengths(*ref.patch);
    const int nu = intervals(sides.x(), spacing_), nv = intervals(sides.y(), spacing_);
    for (int i = 0; i <= nu; ++i)
      for (int j = 0; j <= nv; ++j) {
        const double u = i == nu ? box.u1 : box.u0 + (box.u1 - box.u0) * i / nu;
        const double v = j == nv ? box.v1 : box.v0 + (box.v1 - box.v0) * j / nv;
        if (model.faces()[ref.face].trim.contains(u, v))
          all.push_back({ref.face, u, v, ref.patch->point(u, v)});
      }
  }
  // Counting sort by cell keeps the order of the patches within a cell.
  starts_.assign(columns_ * rows_ + 1, 0);
  for (const Seed& s : all) ++starts_[cell(s.s.x(), s.s.y()) + 1];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  seeds_.resize(all.size());
  for (const Seed& s : all) seeds_[next[cell(s.s.x(), s.s.y())]++] = s;
}

std::size_t FootprintLocator::cell(double x, double y) const {
  const double c = std::clamp(std::floor((x - lo_.x()) / spacing_), 0.0, double(columns_ - 1));
  const double r = std::clamp(std::floor((y - lo_.y()) / spacing_), 0.0, double(rows_ - 1));
  return std::size_t(r) * columns_ + std::size_t(c);
}

// Plan distance after Newton's iteration on S_xy(u, v) = at from the seed, kept inside the face's domain.
double FootprintLocator::refine(const Seed& seed, const Vec2& at) const {
  const Face& face = model_.faces()[seed.face];
  const ParamBox& d = face.surface.domain();
  double u = seed.u, v = seed.v, best = (seed.s.head<2>() - at).norm();
  for (int k = 0; k < kNewtonSteps; ++k) {
    const SurfacePoint p = face.surface.evaluate(u, v);
    const Vec2 miss = p.s.head<2>() - at;
    if (face.trim.contains(u, v)) best = std::min(best, miss.norm());
    Eigen::Matrix2d j;
    j << p.su.x(), p.sv.x(), p.su.y(), p.sv.y();
    const Vec2 step = j.completeOrthogonalDecomposition().solve(miss);
    const double u_next = std::clamp(u - step.x(), d.u0, d.u1), v_next = std::clamp(v - step.y(), d.v0, d.v1);
    if (u_next == u && v_next == v) break;
    u = u_next, v = v_next;
  }
  return best;
}

double FootprintLocator::distance(const Vec2& at, double radius) const {
  std::vector<std::pair<double, const Seed*>> near;
  visit_near(at, radius + spacing_, [&](const Seed& seed) {
    if (!model_.faces()[seed.face].check) near.emplace_back((seed.s.head<2>() - at).squaredNorm(), &seed);
  });
  const std::size_t keep = std::min(near.size(), kBestSeeds);
  std::partial_sort(
      near.begin(), near.begin() + std::ptrdiff_t(keep), near.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;
      });
  double best = kInfinity;
  for (std::size_t i = 0; i < keep && best > kOverFace; ++i)
    best = std::min(best, refine(*near[i].second, at));
  return best <= radius ? best : kInfinity;
}

std::vector<bool> over_faces(const FootprintLocator& locator,
                             const std::vector<Vec2>& points,
                             double margin) {
  const double radius = std::max(margin, 0.0) + kOverFace;
  std::vector<bool> result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result[i] = locator.distance(points[i], radius) <= radius;
  return result;
}

}  // namespace mpm
