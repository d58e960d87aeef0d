// The vector kernel behind BezierPatch::evaluate.
#pragma once

namespace mpm {

// The Bernstein polynomials of one direction at one parameter: values, first and second derivatives.
struct BasisRows {
  const double *value, *first, *second;
};

// Sums of a net of homogeneous control points (four numbers each, row-major in u, (degree_u + 1)
// (degree_v + 1) of them) times products of basis rows: out[0..5] = H, Hu, Hv, Huu, Huv, Hvv. All instruction
// sets give the same bits.
using NetKernel = void (*)(const double* control,
                           int degree_u,
                           int degree_v,
                           const BasisRows& u,
                           const BasisRows& v,
                           double out[6][4]);

namespace baseline {
extern const NetKernel kNetKernel;
}
namespace avx2 {
extern const NetKernel kNetKernel;
}
// For widest() of base/instruction_set.h.
inline constexpr const NetKernel* kNetKernels[] = {&baseline::kNetKernel, &avx2::kNetKernel};

}  // namespace mpm
