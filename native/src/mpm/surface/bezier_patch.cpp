#include "mpm/surface/bezier_patch.h"

#include <algorithm>

#include "mpm/base/error.h"
#include "mpm/base/instruction_set.h"
#include "mpm/surface/bernstein.h"
#include "mpm/surface/net_kernel.h"

namespace mpm {
namespace {

// Local parameter of u in [u0, u1], exact at both ends.
double local(double u, double u0, double u1) { return (u - u0) / (u1 - u0); }

Vec3 cartesian(const Vec4& h) { return h.head<3>() / h.w(); }

// Control points of the Bézier curve `c` (degree+1 points, `stride` apart) restricted to [a, b], by de
// Casteljau twice.
void restrict_curve(Vec4* c, int degree, int stride, double a, double b) {
  for (int k = 1; k <= degree; ++k)  // keep [a, 1]
    for (int i = 0; i <= degree - k; ++i) c[i * stride] = (1 - a) * c[i * stride] + a * c[(i + 1) * stride];
  const double t = a < 1.0 ? (b - a) / (1.0 - a) : 0.0;
  for (int k = 1; k <= degree; ++k)  // keep [0, t] of it
    for (int i = degree; i >= k; --i) c[i * stride] = (1 - t) * c[(i - 1) * stride] + t * c[i * stride];
}

}  // namespace

BezierPatch::BezierPatch(int degree_u, int degree_v, const ParamBox& box, std::vector<Vec4> control)
    : degree_u_(degree_u), degree_v_(degree_v), box_(box), control_(std::move(control)) {
  ensure(control_.size() == std::size_t(degree_u + 1) * std::size_t(degree_v + 1),
         "Bézier net has a wrong size");
  rational_ = std::any_of(control_.begin(), control_.end(), [](const Vec4& c) { return c.w() != 1.0; });
}

Vec3 BezierPatch::point(double u, double v) const {
  BernsteinRow bu, bv;
  bernstein(degree_u_, local(u, box_.u0, box_.u1), bu);
  bernstein(degree_v_, local(v, box_.v0, box_.v1), bv);
  Vec4 sum = Vec4::Zero();
  const Vec4* c = control_.data();
  for (int i = 0; i <= degree_u_; ++i) {
    Vec4 row = Vec4::Zero();
    for (int j = 0; j <= degree_v_; ++j) row += bv[j] * *c++;
    sum += bu[i] * row;
  }
  return rational_ ? cartesian(sum) : Vec3(sum.head<3>());
}

SurfacePoint BezierPatch::evaluate(double u, double v) const {
  BernsteinRow bu, du, ddu, bv, dv, ddv;
  bernstein_derivatives(degree_u_, local(u, box_.u0, box_.u1), bu, du, ddu);
  bernstein_derivatives(degree_v_, local(v, box_.v0, box_.v1), bv, dv, ddv);
  static const NetKernel kernel = widest(kNetKernels);
  double sums[6][4];
  kernel(control_.data()->data(),
         degree_u_,
         degree_v_,
         {bu.data(), du.data(), ddu.data()},
         {bv.data(), dv.data(), ddv.data()},
         sums);
  const auto sum = [&](int k) -> Vec4 { return {sums[k][0], sums[k][1], sums[k][2], sums[k][3]}; };
  Vec4 h = sum(0), hu = sum(1), hv = sum(2), huu = sum(3), huv = sum(4), hvv = sum(5);
  const double ku = 1.0 / (box_.u1 - box_.u0), kv = 1.0 / (box_.v1 - box_.v0);
  hu *= ku, huu *= ku * ku, hv *= kv, hvv *= kv * kv, huv *= ku * kv;
  SurfacePoint p;
  if (!rational_) {
    p.s = h.head<3>(), p.su = hu.head<3>(), p.sv = hv.head<3>();
    p.suu = huu.head<3>(), p.suv = huv.head<3>(), p.svv = hvv.head<3>();
    return p;
  }
  // Quotient rule on S = H / w.
  const double w = h.w();
  p.s = h.head<3>() / w;
  p.su = (hu.head<3>() - hu.w() * p.s) / w;
  p.sv = (hv.head<3>() - hv.w() * p.s) / w;
  p.suu = (huu.head<3>() - 2 * hu.w() * p.su - huu.w() * p.s) / w;
  p.suv = (huv.head<3>() - hu.w() * p.sv - hv.w() * p.su - huv.w() * p.s) / w;
  p.svv = (hvv.head<3>() - 2 * hv.w() * p.sv - hvv.w() * p.s) / w;
  return p;
}

Box3 BezierPatch::bounds() const {
  Box3 box;
  for (const Vec4& c : control_) box.extend(cartesian(c));
  return box;
}

BezierPatch BezierPatch::restricted(const ParamBox& part) const {
  std::vector<Vec4> c = control_;
  const int rows = degree_u_ + 1, columns = degree_v_ + 1;
  const double a = local(part.u0, box_.u0, box_.u1), b = local(part.u1, box_.u0, box_.u1);
  for (int j = 0; j < columns; ++j) restrict_curve(&c[j], degree_u_, columns, a, b);
  const double d = local(part.v0, box_.v0, box_.v1), e = local(part.v1, box_.v0, box_.v1);
  for (int i = 0; i < rows; ++i) restrict_curve(&c[i * columns], degree_v_, 1, d, e);
  return BezierPatch(degree_u_, degree_v_, part, std::move(c));
}

}  // namespace mpm
