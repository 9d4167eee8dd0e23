#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quadloop/quadloop.hpp"

/// Arrays of numpy from and to the types of the library.
namespace quadloop::python {

namespace py = pybind11;

using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
using IntArray = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;

/// A read-only array without a copy; `owner` keeps the data alive.
template <class Number>
py::array view(const void* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array array(py::dtype::of<Number>(), std::move(shape), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

template <class Rows>
py::array rows_view(const Rows& rows, py::ssize_t width, const py::object& owner) {
  return view<std::int32_t>(rows.data(), {static_cast<py::ssize_t>(rows.size()), width}, owner);
}

/// Nodal and cell variables, each with a row of values for each owned node or each cell.
struct PythonField {
  std::vector<std::string> names;
  DoubleArray values;
  std::vector<std::string> cell_names;
  DoubleArray cell_values;
};

inline std::vector<double> rows_of(const DoubleArray& values, std::size_t rows, std::size_t width,
                                   const char* what) {
  const auto count = static_cast<std::size_t>(values.size());
  if (count != rows * width)
    throw InputError(std::string(what) + ": " + std::to_string(count) + " values for " +
                     std::to_string(width) + " variables in " + std::to_string(rows) + " rows");
  return {values.data(), values.data() + count};
}

/// Not collective: an error is one of this rank.
inline Field field_of(const Mesh& mesh, const PythonField& given) {
  Field field;
  field.names = given.names;
  field.values = rows_of(given.values, static_cast<std::size_t>(mesh.owned_nodes), given.names.size(),
                         "values at the owned nodes");
  field.cells.names = given.cell_names;
  field.cells.values =
      rows_of(given.cell_values, mesh.cell_count(), given.cell_names.size(), "values in the cells");
  return field;
}

inline DoubleArray table_of(const std::vector<double>& values, std::size_t width) {
  const std::size_t rows = width == 0 ? 0 : values.size() / width;
  DoubleArray table({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(width)});
  std::copy(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rows * width), table.mutable_data());
  return table;
}

inline py::tuple python_field(const Field& field) {
  return py::make_tuple(field.names, table_of(field.values, field.width()), field.cells.names,
                        table_of(field.cells.values, field.cells.width()));
}

inline PythonField python_field_from(const py::tuple& given) {
  return {given[0].cast<std::vector<std::string>>(), given[1].cast<DoubleArray>(),
          given[2].cast<std::vector<std::string>>(), given[3].cast<DoubleArray>()};
}

/// Points as a list, from an array of shape (n, 2).
inline std::vector<Point> points_from(const DoubleArray& array) {
  const auto count = static_cast<std::size_t>(array.size()) / 2;
  std::vector<Point> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i] = {array.data()[2 * i], array.data()[2 * i + 1]};
  return points;
}

inline DoubleArray array_of(std::span<const Point> points) {
  DoubleArray array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  for (std::size_t i = 0; i < points.size(); ++i) {
    array.mutable_data()[2 * i] = points[i].x;
    array.mutable_data()[2 * i + 1] = points[i].y;
  }
  return array;
}

/// Rows of node numbers, each below `nodes`.
template <std::size_t width>
std::vector<std::array<NodeId, width>> rows_from(const IntArray& given, std::int32_t nodes,
                                                 const char* what) {
  const auto count = static_cast<std::size_t>(given.size()) / width;
  std::vector<std::array<NodeId, width>> rows(count);
  for (std::size_t i = 0; i < count * width; ++i) {
    const std::int32_t node = given.data()[i];
    if (node < 0 || node >= nodes)
      throw InputError(std::string(what) + ": row " + std::to_string(i / width) + " names node " +
                       std::to_string(node) + ", but there are " + std::to_string(nodes) + " nodes");
    rows[i / width][i % width] = NodeId{node};
  }
  return rows;
}

}  // namespace quadloop::python
