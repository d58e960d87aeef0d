// A kernel: compiled once for each instruction set (native/cmake/kernels.cmake).
#include "mpm/surface/net_kernel.h"

#include <cstring>

namespace mpm::MPM_ISA {
namespace {

typedef double Point __attribute__((vector_size(32)));

// Degrees known to the compiler where they are the usual ones: its loops then have no counters.
template <int kDegreeU, int kDegreeV>
void sum(const double* control,
         int any_degree_u,
         int any_degree_v,
         const BasisRows& u,
         const BasisRows& v,
         double out[6][4]) {
  const int degree_u = kDegreeU ? kDegreeU : any_degree_u, degree_v = kDegreeV ? kDegreeV : any_degree_v;
  Point h{}, hu{}, hv{}, huu{}, huv{}, hvv{};
  for (int i = 0; i <= degree_u; ++i) {
    Point row{}, row_v{}, row_vv{};
    for (int j = 0; j <= degree_v; ++j, control += 4) {
      Point c;
      std::memcpy(&c, control, sizeof c);
      row += v.value[j] * c;
      row_v += v.first[j] * c;
      row_vv += v.second[j] * c;
    }
    h += u.value[i] * row;
    hu += u.first[i] * row;
    huu += u.second[i] * row;
    hv += u.value[i] * row_v;
    huv += u.first[i] * row_v;
    hvv += u.value[i] * row_vv;
  }
  const Point all[6] = {h, hu, hv, huu, huv, hvv};
  std::memcpy(out, all, sizeof all);
}

void sum_net(const double* control,
             int degree_u,
             int degree_v,
             const BasisRows& u,
             const BasisRows& v,
             double out[6][4]) {
  if (degree_u == 3 && degree_v == 3)
    sum<3, 3>(control, 3, 3, u, v, out);
  else
    sum<0, 0>(control, degree_u, degree_v, u, v, out);
}

}  // namespace

const NetKernel kNetKernel{sum_net};

}  // namespace mpm::MPM_ISA
