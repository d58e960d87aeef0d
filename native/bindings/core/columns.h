// Structures of vectors, and vectors of structures, as dictionaries of named numpy arrays.
#pragma once

#include <algorithm>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <type_traits>
#include <utility>

#include "common.h"

namespace mpm::bindings {

using Shape = std::vector<py::ssize_t>;

// What one row of an array is made of: the scalar, and the shape that stands behind the number of rows.
template <class Row>
struct RowLayout {
  using Scalar = Row;
  static Shape shape() { return {}; }
};
template <class Row>
requires std::is_enum_v<Row>
struct RowLayout<Row> : RowLayout<std::underlying_type_t<Row>> {
};
template <int N>
struct RowLayout<Eigen::Matrix<double, N, 1>> {
  using Scalar = double;
  static Shape shape() { return {N}; }
};
template <class Entry, std::size_t N>
struct RowLayout<std::array<Entry, N>> {
  using Scalar = typename RowLayout<Entry>::Scalar;
  static Shape shape() {
    Shape inner = RowLayout<Entry>::shape();
    inner.insert(inner.begin(), py::ssize_t(N));
    return inner;
  }
};

// A copy with one row an entry: numbers and codes of enums (N,), vectors (N, 2) or (N, 3), pairs of them
// (N, 2, 3), triangles (N, 3).
template <class Row>
py::array_t<typename RowLayout<Row>::Scalar> to_array(const std::vector<Row>& rows) {
  Shape shape = RowLayout<Row>::shape();
  shape.insert(shape.begin(), py::ssize_t(rows.size()));
  py::array_t<typename RowLayout<Row>::Scalar> result(shape);
  ensure(std::size_t(result.nbytes()) == rows.size() * sizeof(Row), "rows must have no gaps");
  if (!rows.empty()) std::memcpy(result.mutable_data(), rows.data(), rows.size() * sizeof(Row));
  return result;
}

// Zeros and ones as an array of bool (N,).
template <class Flags>
py::array_t<bool> to_flags(const Flags& flags) {
  py::array_t<bool> result(py::ssize_t(flags.size()));
  std::copy(flags.begin(), flags.end(), result.mutable_data());
  return result;
}
inline py::array_t<bool> to_array(const std::vector<bool>& flags) { return to_flags(flags); }

// One column of a vector of structures: a member of each, or what a function makes of each.
template <class Record, class Get>
auto column(const std::vector<Record>& records, Get get) {
  std::vector<std::decay_t<std::invoke_result_t<Get, const Record&>>> rows;
  rows.reserve(records.size());
  for (const Record& record : records) rows.push_back(std::invoke(get, record));
  return to_array(rows);
}

inline py::dict table(std::initializer_list<std::pair<const char*, py::object>> columns) {
  py::dict result;
  for (const auto& [name, values] : columns) result[name] = values;
  return result;
}

}  // namespace mpm::bindings
