#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "io/files/binary_output.hpp"
#include "io/files/boundary_stream.hpp"
#include "io/files/row_stream.hpp"

namespace quadloop::io {

/// A VTK XML file whose arrays are appended as raw little-endian bytes after the XML; all ranks write it
/// together, through rank 0, and the bytes are the same on any number of ranks. Arrays must be declared
/// first, each with its write function, as the XML contains their offsets. All functions except put() are
/// *collective*; they throw OutputError on all ranks.
class VtuAppended {
 public:
  VtuAppended(OutputSet& outputs, const std::string& path);

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
    using Row = decltype(make(std::int64_t{0}));
    const RowStream stream{comm_, rows, bytes_per_piece / std::int64_t{sizeof(Row)}};
    stream.run<Row>(
        [&](std::int64_t begin, std::int64_t end) {
          std::vector<Row> made;
          made.reserve(end - begin);
          for (std::int64_t i = begin; i < end; ++i) made.push_back(in_order<std::endian::little>(make(i)));
          return made;
        },
        [&](std::span<const Row> piece) { put(piece); });
  }
  /// A row for each boundary edge, made of what the stream has for it.
  template <class Make>
  void put_edges(const BoundaryStream& edges, const Make& make) {
    using Row = decltype(make(BoundaryStream::Edge{}));
    std::vector<Row> waiting;
    const auto flush = [&] {
      put(std::span<const Row>(waiting));
      waiting.clear();
    };
    edges.run([](std::size_t) {},
              [&](std::span<const BoundaryStream::Edge> some) {
                for (const BoundaryStream::Edge& edge : some)
                  waiting.push_back(in_order<std::endian::little>(make(edge)));
                if (waiting.size() * sizeof(Row) > std::size_t{bytes_per_piece}) flush();
              });
    on_root(flush);
  }

  /// Writes rows that are already in the file's byte order. On rank 0 only, not collective.
  template <class Row>
  void put(std::span<const Row> rows) {
    file_->write(bytes_of(rows));
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

  void on_root(const std::function<void()>& action) const;

  static constexpr std::int64_t bytes_per_piece = std::int64_t{1} << 20;

  const Communicator& comm_;
  std::vector<Array> arrays_;
  std::unique_ptr<OutputFile> file_;  ///< on rank 0 only
};

}  // namespace quadloop::io
