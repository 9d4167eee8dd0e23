#pragma once

// For io/fluent only.
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/fluent/fluent_scanner.hpp"
#include "io/model/point3.hpp"

namespace quadloop::io {

/// A face: an edge in 2D, a triangle or a quad in 3D.
struct FluentFace {
  static constexpr std::int32_t no_node = -1;

  std::array<std::int32_t, 4> nodes;  ///< from 0, no_node after the last
  std::array<std::int32_t, 2> cells;  ///< from 1; 0: none
  std::int64_t zone, type;
  std::size_t place;

  bool is_inside() const { return cells[0] != 0 && cells[1] != 0; }
  std::array<std::int32_t, 2> ends() const { return {nodes[0], nodes[1]}; }
};

/// The sections of an ASCII Fluent file in memory: nodes, faces and zones.
class FluentSections {
 public:
  /// Throws InputError "file:line: ..." if the file is incomplete; also for binary files, hanging nodes, and
  /// faces with other numbers of nodes.
  explicit FluentSections(const std::string& path);
  std::int32_t dimension() const { return dimension_; }  ///< 2 or 3; 2 if not specified in the file

  const TextScanner& scan() const { return scan_.scan(); }
  const std::vector<Point3>& points() const { return points_; }  ///< z = 0 in 2D
  const std::vector<FluentFace>& faces() const { return faces_; }
  const std::map<std::int64_t, std::string>& zone_names() const { return zone_names_; }
  std::string zone_name(std::int64_t zone) const;

  /// Number of cells, which are numbered from 1.
  std::int32_t cells() const { return static_cast<std::int32_t>(ends_.size()) - 1; }
  /// Returns the indices of a cell's faces, in the file's order.
  std::span<const std::int32_t> faces_of(std::int32_t cell) const {
    return std::span(faces_of_cells_).subspan(ends_[cell - 1], ends_[cell] - ends_[cell - 1]);
  }
  /// Returns the zone of each cell, from 1; 0: none.
  std::vector<std::int64_t> zones_of_cells() const;
  std::string block_name(std::int64_t zone) const { return zone == 0 ? "domain" : zone_name(zone); }

 private:
  /// The head of a section of nodes, cells or faces: "(zone first last type kind)"; numbers are hexadecimal.
  struct Head {
    std::int64_t zone = 0, first = 0, last = 0, type = 0, kind = 0;

    std::int64_t count() const { return last - first + 1; }
  };

  void read_section();
  void read_dimension();
  Head read_head();
  void require_room(const Head& head, std::size_t bytes_each, const char* of) const;
  void read_nodes();
  void read_cells();
  void read_faces();
  void require_kind(std::int64_t kind) const;
  void read_face(const Head& head, std::int64_t width);
  std::int64_t read_width();
  std::int32_t number(const char* expected);
  void read_zone();
  void collect_faces();

  FluentScanner scan_;
  std::int32_t dimension_ = 2;
  std::vector<Point3> points_;
  std::vector<FluentFace> faces_;
  std::vector<Head> cell_zones_;
  std::map<std::int64_t, std::string> zone_names_;
  std::vector<std::int64_t> ends_;            ///< end of each cell's range in faces_of_cells_
  std::vector<std::int32_t> faces_of_cells_;  ///< faces of cell 0, which stands for no cell, come first
};

}  // namespace quadloop::io
