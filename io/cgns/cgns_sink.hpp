#pragma once

// For io/cgns only.
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/cgns/cgns_handle.hpp"
#include "io/files/output_file.hpp"

namespace quadloop::io {

/// Maximum number of entries of an array in the file.
constexpr std::int64_t largest_cgns_size = std::numeric_limits<cgsize_t>::max();

/// State of a CGNS file being written, on rank 0: the file, its single base, the current zone, and the
/// position of the next piece in the current array.
class CgnsSink {
 public:
  /// `only_zone` is the name of the zone of a mesh without blocks.
  static constexpr const char *base_name = "Base", *only_zone = "domain", *base_path = "/Base";
  static std::string path_of_zone(const std::string& name) { return std::string(base_path) + "/" + name; }

  /// `dimension` is that of the cells and of the space.
  CgnsSink(const StagedFile& staged, int dimension) : file_{open(staged)}, dimension_{dimension} {}

  void begin_base();
  void begin_zone(const std::string& name, std::int64_t nodes, std::int64_t cells);

  void begin_rows() { next_row_ = 1; }
  /// Each node has as many coordinates as the space has dimensions.
  void put_coordinates(std::span<const double> rows);
  /// Begins a solution at the vertices, or in the cells: each location has its own.
  void begin_solution(GridLocation_t location = Vertex);
  /// `variables` are our names; in the file they are cgns_variable_names().
  void put_solution(std::span<const double> rows, const std::vector<std::string>& variables);

  void begin_section(const std::string& name, ElementType_t type, std::int64_t elements);
  void put_elements(std::span<const cgsize_t> nodes, std::size_t width);

  void close() { file_->close(); }

 private:
  using File = CgnsFile<OutputError>;

  static std::unique_ptr<File> open(const StagedFile& staged);
  int id() const { return file_->id(); }
  cgsize_t advance(std::size_t rows);
  void take_column(std::span<const double> rows, std::size_t width, std::size_t k);
  void put_length_dimension(int coordinate);
  void describe_variable(int field, const std::string& variable, const std::string& name);

  std::unique_ptr<File> file_;
  int dimension_;
  int base_ = 0, zone_ = 0, section_ = 0, solution_ = 0;
  cgsize_t next_row_ = 1, next_element_ = 1;
  std::vector<double> column_;
};

}  // namespace quadloop::io
