// Conversions that the binding files share: arguments from Python, with the shape or the word named when it
// is wrong. README.md beside this folder says how the two sides meet; columns.h has the way back.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <string>
#include <vector>

#include "mpm/base/error.h"
#include "mpm/base/types.h"

namespace mpm::bindings {

namespace py = pybind11;

template <class T>
using ArrayOf = py::array_t<T, py::array::c_style | py::array::forcecast>;
using DoubleArray = ArrayOf<double>;
using IntArray = ArrayOf<std::int32_t>;
using FlagArray = ArrayOf<bool>;

inline std::string shape_of(const py::array& a) {
  std::string s = "(";
  for (py::ssize_t i = 0; i < a.ndim(); ++i) {
    if (i > 0) s += ", ";
    s += std::to_string(a.shape(i));
  }
  return s + ")";
}

// (N,) -> numbers of a type that may be another one: flags are held as std::uint8_t.
template <class To = double, class From>
std::vector<To> to_scalars(const ArrayOf<From>& a, const char* name) {
  require(a.ndim() == 1, std::string(name) + " must have shape (N,), got " + shape_of(a));
  return {a.data(), a.data() + a.size()};
}

// How many vectors an array (..., Width) holds.
template <class Vector>
std::size_t vectors_in(const DoubleArray& a, const char* name) {
  constexpr py::ssize_t width = Vector::RowsAtCompileTime;
  require(a.ndim() >= 1 && a.shape(a.ndim() - 1) == width,
          std::string(name) + " must have shape (..., " + std::to_string(width) + "), got " + shape_of(a));
  return std::size_t(a.size() / width);
}

template <class Vector>
Eigen::Map<const Vector> vector_at(const DoubleArray& a, std::size_t i) {
  return Eigen::Map<const Vector>(a.data() + i * std::size_t(Vector::RowsAtCompileTime));
}

// (..., Width) -> that many fixed-size vectors.
template <class Vector>
std::vector<Vector> to_vectors(const DoubleArray& a, const char* name) {
  std::vector<Vector> result(vectors_in<Vector>(a, name));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = vector_at<Vector>(a, i);
  return result;
}

inline Vec3 to_direction(const Vec3& v, const std::string& name) {
  const double length = v.norm();
  require(std::isfinite(length) && length > 0, name + " must be finite and not zero");
  return v / length;
}

inline void require_same_length(std::size_t a, std::size_t b, const char* names) {
  require(a == b,
          std::string(names) + " must have the same length, got " + std::to_string(a) + " and " +
              std::to_string(b));
}

// The words for an enum's values, which stand beside it in its header.
template <std::size_t N>
using Names = std::array<const char*, N>;

template <std::size_t N>
py::tuple to_tuple(const Names<N>& names) {
  return py::tuple(py::cast(names));
}

// The value that a word stands for.
template <class Enum, std::size_t N>
Enum from_name(const Names<N>& names, const char* argument, const std::string& name) {
  std::string known;
  for (std::size_t i = 0; i < N; ++i) {
    if (name == names[i]) return Enum(i);
    known += (i == 0 ? "'" : i + 1 < N ? "', '" : "' or '") + std::string(names[i]);
  }
  throw std::invalid_argument(std::string(argument) + " must be " + known + "', got '" + name + "'");
}

// Lets Python's other threads run while `work` runs, which must not touch anything of Python's.
template <class Work>
auto without_gil(const Work& work) {
  const py::gil_scoped_release released;
  return work();
}

// One per binding file, called by module.cpp in the order of the layers.
void bind_base(py::module_& m);
void bind_surface(py::module_& m);
void bind_tool(py::module_& m);
void bind_footprint(py::module_& m);
void bind_gouge(py::module_& m);
void bind_positioning(py::module_& m);
void bind_machine(py::module_& m);
void bind_path(py::module_& m);
void bind_removal(py::module_& m);

}  // namespace mpm::bindings
