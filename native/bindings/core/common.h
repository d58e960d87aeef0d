// Conversions that the binding files share: numpy arrays in and out, with the shape named when it is wrong.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "mpm/base/error.h"
#include "mpm/base/types.h"

namespace mpm::bindings {

namespace py = pybind11;

using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

inline std::string shape_of(const py::array& a) {
  std::string s = "(";
  for (py::ssize_t i = 0; i < a.ndim(); ++i) {
    if (i > 0) s += ", ";
    s += std::to_string(a.shape(i));
  }
  return s + ")";
}

inline std::vector<double> to_doubles(const DoubleArray& a, const char* name) {
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

template <class Vector>
py::array_t<double> from_vectors(const std::vector<Vector>& v) {
  constexpr py::ssize_t width = Vector::RowsAtCompileTime;
  py::array_t<double> result({py::ssize_t(v.size()), width});
  for (std::size_t i = 0; i < v.size(); ++i)
    Eigen::Map<Vector>(result.mutable_data() + i * std::size_t(width)) = v[i];
  return result;
}

template <class T>
py::array_t<T> from_scalars(const std::vector<T>& v) {
  return py::array_t<T>(py::ssize_t(v.size()), v.data());
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
