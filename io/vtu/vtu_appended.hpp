#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "io/files/binary_output.hpp"
#include "io/files/boundary_stream.hpp"
#include "io/files/row_output.hpp"

namespace quadloop::io {

/// A VTK XML file whose arrays are appended as raw little-endian bytes after the XML; all ranks write it
/// together, each its own rows, and the bytes are the same on any number of ranks. Arrays must be declared
/// first, each with its write function, as the XML contains their offsets. All functions are *collective*;
/// they throw OutputError on all ranks.
class VtuAppended {
 public:
  VtuAppended(OutputSet& outputs, const std::string& path) : file_{outputs, outputs.stage(path)} {}

  /// Declares an array of `rows` rows over all ranks in an element ("Points", "Cells", "PointData",
  /// "CellData") of the piece; `write` is called later to write it with the functions below, in one or
  /// several calls.
  template <class Number>
  void add(const std::string& element, const std::string& name, int components, std::int64_t rows,
           std::function<void()> write) {
    add_array({element, name, vtk_type<Number>(), components,
               rows * components * std::int64_t{sizeof(Number)}, std::move(write)});
  }

  /// Writes the file: `head`, which ends with the start of the piece, the arrays' tags, and the arrays.
  void write(const std::string& head);

  /// Writes the rows of all ranks in the order of ranks: `make(i)` is this rank's row i, an array of numbers.
  template <class Make>
  void put_rows(std::int64_t rows, const Make& make) {
    file_.write_rows(rows, [&](std::int64_t i) { return in_order<std::endian::little>(make(i)); });
  }
  /// Writes `count` rows that any rank can create from their number: `make(i)` is an array of numbers.
  template <class Make>
  void put_shared_rows(std::int64_t count, const Make& make) {
    file_.write_shared_rows(count, [&](std::int64_t i) { return in_order<std::endian::little>(make(i)); });
  }
  /// Writes `on_each` rows for each boundary edge, made of what the stream has for it: `make(edge, k)`.
  template <class Make>
  void put_edges(const BoundaryStream& edges, std::int64_t on_each, const Make& make) {
    file_.write_edges(edges, on_each, [&](const BoundaryStream::Edge& edge, std::int64_t k) {
      return in_order<std::endian::little>(make(edge, k));
    });
  }

 private:
  struct Array {
    std::string element, name, type;
    int components;
    std::int64_t bytes;
    std::function<void()> write;
  };

  template <class Number>
  static std::string vtk_type() {
    if constexpr (std::is_same_v<Number, double>) return "Float64";
    return (std::is_signed_v<Number> ? "Int" : "UInt") + std::to_string(8 * sizeof(Number));
  }

  void add_array(Array array) { arrays_.push_back(std::move(array)); }
  std::string tags_of(const std::string& element, std::int64_t& offset) const;

  std::vector<Array> arrays_;
  RowOutput file_;
};

}  // namespace quadloop::io
