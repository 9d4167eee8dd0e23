#pragma once

// For io/cgns only.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_nodes.hpp"

namespace quadloop::io {

/// Adds the base and the nodes of zones, except boundaries, to a new CGNS file, on rank 0. The contents of
/// the arrays are written later.
class CgnsLayout {
 public:
  /// `only_zone` is the name of the zone of a mesh without blocks.
  static constexpr const char *base_name = "Base", *only_zone = "domain", *base_path = "/Base";
  static std::string path_of_zone(const std::string& name) { return std::string(base_path) + "/" + name; }
  /// Paths of arrays, for CgnsNodes::places().
  static std::string path_of_coordinate(const std::string& zone, int k);
  static std::string path_of_elements(const std::string& zone, const std::string& section) {
    return path_of_zone(zone) + "/" + section + "/" + CgnsNodes::elements_name;
  }
  /// `name` is that in the file.
  static std::string path_of_variable(const std::string& zone, GridLocation_t location,
                                      const std::string& name) {
    return path_of_zone(zone) + "/" + solution_name(location) + "/" + name;
  }

  /// Number of nodes of an element.
  static int nodes_of(ElementType_t type);

  /// `dimension` is that of the cells and of the space.
  CgnsLayout(CgnsNodes& nodes, int dimension);

  /// The following nodes are those of this zone.
  void begin_zone(const std::string& name, std::int64_t nodes, std::int64_t cells);
  void add_coordinates();
  /// Adds a section after the last one.
  void add_section(const std::string& name, ElementType_t type, std::int64_t elements);
  /// Adds a solution at the vertices, or in the cells. `variables` are our names; in the file they are
  /// cgns_variable_names().
  void add_solution(GridLocation_t location, const std::vector<std::string>& variables);

  /// HDF5 keeps a file open as long as any object in it is open.
  void end_zone() { zone_ = {}; }

 private:
  static const char* solution_name(GridLocation_t location) {
    return location == CellCenter ? "CellSolution" : "FlowSolution";
  }
  void put_dimension(const CgnsNodes::Node& array, const std::array<float, 5>& exponents) const;
  void add_variable(const CgnsNodes::Node& solution, const std::string& variable, const std::string& name,
                    std::int64_t count);

  CgnsNodes& nodes_;
  std::int32_t dimension_;
  CgnsNodes::Node zone_;
  std::int64_t all_nodes_ = 0, all_cells_ = 0;
  std::int64_t next_element_ = 1;
};

}  // namespace quadloop::io
