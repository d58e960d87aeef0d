// The vector kernel behind BezierPatch::evaluate.
#pragma once

namespace mpm {

// The Bernstein polynomials of one direction at one parameter: values, first and second derivatives.
struct BasisRows {
  const double *value, *first, *second;
};

// Sums of a net of homogeneous control points (four numbers each, row-major in u, (degree_u + 1)
// (degree_v + 1) of them) times products of basis rows: out[0..5] = H, Hu, Hv, Huu, Huv, Hvv.
using NetKernel = void (*)(const double* control,
                           int degree_u,
                           int degree_v,
                           const BasisRows& u,
                           const BasisRows& v,
                           double out[6][4]);

// The widest that this processor has; all give the same bits.
NetKernel net_kernel();

void net_baseline(const double*, int, int, const BasisRows&, const BasisRows&, double[6][4]);
#ifdef MPM_AVX2
void net_avx2(const double*, int, int, const BasisRows&, const BasisRows&, double[6][4]);
#endif

}  // namespace mpm
