#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/files/binary_output.hpp"
#include "io/files/boundary_stream.hpp"
#include "io/files/row_output.hpp"

namespace quadloop::io {

/// Types of numbers in arrays of VTK.
enum class VtkNumber { float64, int64, int32, uint8 };

template <class Number>
inline constexpr VtkNumber vtk_number = VtkNumber::float64;
template <>
inline constexpr VtkNumber vtk_number<std::int64_t> = VtkNumber::int64;
template <>
inline constexpr VtkNumber vtk_number<std::int32_t> = VtkNumber::int32;
template <>
inline constexpr VtkNumber vtk_number<std::uint8_t> = VtkNumber::uint8;

constexpr std::int64_t bytes_of(VtkNumber number) {
  return number == VtkNumber::uint8 ? 1 : number == VtkNumber::int32 ? 4 : 8;
}

/// Parts of an unstructured grid, in the order in which files contain their arrays.
enum class VtkSection { points, cells, point_data, cell_data };
inline constexpr std::array vtk_sections{VtkSection::points, VtkSection::cells, VtkSection::point_data,
                                         VtkSection::cell_data};

/// Name of the field data with the names of the boundaries.
inline constexpr const char* vtk_boundary_names = "boundary_names";
/// Names of the arrays of points and cells.
inline constexpr const char *vtk_points = "Points", *vtk_connectivity = "connectivity",
                            *vtk_offsets = "offsets", *vtk_types = "types";

/// A file with an unstructured grid of VTK; all ranks write it together, each its own rows, and the bytes are
/// the same on any number of ranks. All arrays are declared first, each with its write function, as the file
/// begins with their places. All functions are *collective*; they throw OutputError on all ranks.
class VtkOutput {
 public:
  VtkOutput(OutputSet& outputs, const std::string& path)
      : staged_{outputs.stage(path)}, file_{outputs, staged_} {}
  virtual ~VtkOutput() = default;
  VtkOutput(const VtkOutput&) = delete;
  VtkOutput& operator=(const VtkOutput&) = delete;

  /// Whether the offsets begin with a 0 for the start of the first cell; else they are the ends alone.
  virtual bool has_first_offset() const = 0;
  /// Returns the names of variables in the file.
  virtual std::vector<std::string> names_of(const std::vector<std::string>& variables) const {
    return variables;
  }

  /// Sets the names of the boundaries, in the order of their numbers from 1, and the dimension of their
  /// elements.
  void name_boundaries(std::vector<std::string> names, int dimension) {
    boundaries_ = std::move(names);
    boundary_dimension_ = dimension;
  }
  /// Adds field data: a text, or a number, for each of several.
  using FieldValues = std::variant<std::vector<std::string>, std::vector<std::int32_t>, std::vector<double>>;
  void add_field(const std::string& name, FieldValues values) {
    fields_.push_back({name, std::move(values)});
  }

  /// Declares an array of `rows` rows over all ranks; `write` is called later to write it with the functions
  /// below, in one or several calls.
  template <class Number>
  void add(VtkSection section, const std::string& name, int components, std::int64_t rows,
           std::function<void()> write) {
    arrays_.push_back({section, name, vtk_number<Number>, components, rows, std::move(write)});
  }

  /// Writes the file of a grid with these numbers of points and cells, boundary elements included.
  virtual void write(std::int64_t points, std::int64_t cells) = 0;

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

 protected:
  struct Array {
    VtkSection section;
    std::string name;
    VtkNumber number;
    int components;
    std::int64_t rows;
    std::function<void()> write;

    std::int64_t bytes() const { return rows * components * bytes_of(number); }
  };
  struct FieldArray {
    std::string name;
    FieldValues values;
  };

  const StagedFile& staged() const { return staged_; }
  RowOutput& file() { return file_; }
  const std::vector<std::string>& boundaries() const { return boundaries_; }
  int boundary_dimension() const { return boundary_dimension_; }
  const std::vector<FieldArray>& fields() const { return fields_; }
  /// Calls `visit(array)` for each array, section by section.
  template <class Visit>
  void for_each_array(const Visit& visit) const {
    for (const VtkSection section : vtk_sections) {
      for (const Array& array : arrays_) {
        if (array.section == section) visit(array);
      }
    }
  }

 private:
  StagedFile staged_;
  std::vector<std::string> boundaries_;
  int boundary_dimension_ = 1;
  std::vector<FieldArray> fields_;
  std::vector<Array> arrays_;
  RowOutput file_;
};

}  // namespace quadloop::io
