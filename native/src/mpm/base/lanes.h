// Numbers side by side, for kernels only: kLanes of them, or as many times that as MPM_SIDE_BY_SIDE says.
#pragma once

#include "mpm/base/lane_count.h"

#ifndef MPM_SIDE_BY_SIDE
#define MPM_SIDE_BY_SIDE 1
#endif

// In the namespace of the kernel that is compiled (mpm_kernel, native/cmake/kernels.cmake), and local to it:
// the linker must not keep one copy for all instruction sets.
namespace mpm::MPM_ISA {
namespace {

typedef double Four __attribute__((vector_size(sizeof(double) * kLanes)));
typedef double Lanes __attribute__((vector_size(sizeof(double) * kLanes * MPM_SIDE_BY_SIDE)));
typedef long long Mask __attribute__((vector_size(sizeof(double) * kLanes * MPM_SIDE_BY_SIDE)));

inline Four load(const double* p) { return *reinterpret_cast<const Four*>(p); }
inline void store(double* p, Four x) { *reinterpret_cast<Four*>(p) = x; }
inline Four four(double x) { return Four{x, x, x, x}; }
#if MPM_SIDE_BY_SIDE == 1
inline Lanes all(double x) { return four(x); }
#else
inline Lanes all(double x) { return Lanes{x, x, x, x, x, x, x, x}; }
#endif

inline Lanes absolute(Lanes x) { return (Lanes)((Mask)x & 0x7fffffffffffffffLL); }
template <class L>
L least(L x, L y) {
  return x < y ? x : y;
}
template <class L>
L most(L x, L y) {
  return x > y ? x : y;
}
template <class L>
L root(L x) {
  L y;
  for (int i = 0; i < int(sizeof(L) / sizeof(double)); ++i) y[i] = __builtin_sqrt(x[i]);
  return y;
}
inline Lanes hypotenuse(Lanes x, Lanes y) { return root(x * x + y * y); }

inline int lane_bits(Mask m) {
  int bits = 0;
  for (int i = 0; i < kLanes * MPM_SIDE_BY_SIDE; ++i) bits |= int(m[i] & 1) << i;
  return bits;
}

template <class L>
struct Vectors {
  L x, y, z;
};
using Vector = Vectors<Lanes>;

inline Vector all_of(const double* v) { return {all(v[0]), all(v[1]), all(v[2])}; }
inline Vectors<Four> load(const double (*v)[kLanes]) { return {load(v[0]), load(v[1]), load(v[2])}; }
template <class L>
Vectors<L> operator+(const Vectors<L>& a, const Vectors<L>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class L>
Vectors<L> operator-(const Vectors<L>& a, const Vectors<L>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class L>
Vectors<L> operator*(L k, const Vectors<L>& a) {
  return {k * a.x, k * a.y, k * a.z};
}
template <class L>
L dot(const Vectors<L>& a, const Vectors<L>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class L>
L norm(const Vectors<L>& a) {
  return root(dot(a, a));
}
template <class L>
Vectors<L> cross(const Vectors<L>& a, const Vectors<L>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace
}  // namespace mpm::MPM_ISA
