#pragma once

// Inside io/cgns only.
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/cgns/cgns_handle.hpp"
#include "io/files/output_file.hpp"

namespace quadloop {

/// The most entries that an array of the file may have.
constexpr std::int64_t largest_cgns_size = std::numeric_limits<cgsize_t>::max();

/// What stands on rank 0 while a CGNS file is written: the file, its one base and zone, and where the next
/// piece of the array under way goes.
class CgnsSink {
 public:
  static constexpr const char *base_name = "Base", *zone_name = "domain", *base_path = "/Base",
                              *zone_path = "/Base/domain";

  /// `dimension` is that of the cells and of the space.
  CgnsSink(const StagedFile& staged, int dimension) : file_{open(staged)}, dimension_{dimension} {}

  void begin_zone(std::int64_t nodes, std::int64_t cells);

  void begin_rows() { next_row_ = 1; }
  /// Of so many coordinates for each node as the space has dimensions.
  void put_coordinates(std::span<const double> rows);
  /// At the vertices, or in the cells: each place has a solution of its own.
  void begin_solution(GridLocation_t location = Vertex);
  /// `variables` are named as ours are; the file has cgns_variable_names() of them.
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

}  // namespace quadloop
