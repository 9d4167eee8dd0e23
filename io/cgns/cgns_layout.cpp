#include "io/cgns/cgns_layout.hpp"

#include <array>
#include <optional>
#include <vector>

#include "io/cgns/cgns_exponents.hpp"
#include "io/cgns/cgns_names.hpp"

namespace quadloop::io {

namespace {

constexpr std::array coordinate_names{"CoordinateX", "CoordinateY", "CoordinateZ"};
constexpr const char* coordinates_name = "GridCoordinates";

}  // namespace

CgnsLayout::CgnsLayout(CgnsNodes& nodes, int dimension) : nodes_{nodes}, dimension_{dimension} {
  const CgnsNodes::Node root = nodes.at("/");
  nodes.add_reals(root, "CGNSLibraryVersion", "CGNSLibraryVersion_t",
                  std::array{static_cast<float>(CGNS_DOTVERS)});
  const CgnsNodes::Node base =
      nodes.add_integers(root, base_name, "CGNSBase_t", std::array{dimension_, dimension_});
  // the unit of length is chosen by the user
  nodes.add_text(base, "DataClass", "DataClass_t", cg_DataClassName(NormalizedByUnknownDimensional));
}

std::string CgnsLayout::path_of_coordinate(const std::string& zone, int k) {
  return path_of_zone(zone) + "/" + coordinates_name + "/" + coordinate_names[k];
}

int CgnsLayout::nodes_of(ElementType_t type) {
  int nodes = 0;
  cg_npe(type, &nodes);
  return nodes;
}

void CgnsLayout::begin_zone(const std::string& name, std::int64_t nodes, std::int64_t cells) {
  const std::array<std::int64_t, 3> size{nodes, cells, 0};
  zone_ = nodes_.add_sizes(nodes_.at(base_path), name, "Zone_t", size, 1);
  nodes_.add_text(zone_, "ZoneType", "ZoneType_t", cg_ZoneTypeName(Unstructured));
  all_nodes_ = nodes;
  all_cells_ = cells;
  next_element_ = 1;
}

/// Coordinates are lengths.
void CgnsLayout::add_coordinates() {
  const CgnsNodes::Node grid = nodes_.add(zone_, coordinates_name, "GridCoordinates_t");
  for (std::int32_t k = 0; k < dimension_; ++k)
    put_dimension(nodes_.add_array(grid, coordinate_names[k], all_nodes_), {0, 1, 0, 0, 0});
}

/// Exponents of mass, length, time, temperature, angle.
void CgnsLayout::put_dimension(const CgnsNodes::Node& array, const std::array<float, 5>& exponents) const {
  nodes_.add_reals(array, "DimensionalExponents", "DimensionalExponents_t", exponents);
}

void CgnsLayout::add_section(const std::string& name, ElementType_t type, std::int64_t elements) {
  nodes_.add_section(zone_, name, type, {next_element_, next_element_ + elements - 1}, nodes_of(type));
  next_element_ += elements;
}

void CgnsLayout::add_solution(GridLocation_t location, const std::vector<std::string>& variables) {
  const CgnsNodes::Node solution = nodes_.add(zone_, solution_name(location), "FlowSolution_t");
  if (location != Vertex)
    nodes_.add_text(solution, "GridLocation", "GridLocation_t", cg_GridLocationName(location));
  const std::vector<std::string> names = cgns_variable_names(variables);
  for (std::size_t k = 0; k < names.size(); ++k)
    add_variable(solution, variables[k], names[k], location == Vertex ? all_nodes_ : all_cells_);
}

/// Sets the dimensions of a variable; the units are those of the solver, or it is non-dimensional.
void CgnsLayout::add_variable(const CgnsNodes::Node& solution, const std::string& variable,
                              const std::string& name, std::int64_t count) {
  const CgnsNodes::Node array = nodes_.add_array(solution, name, count);
  if (variable_name_of_cgns(name) != variable)
    nodes_.add_text(array, full_name_descriptor, "Descriptor_t", variable);
  const std::optional<CgnsExponents> exponents = cgns_exponents(name);
  if (!exponents) return;
  if (*exponents == CgnsExponents{})
    nodes_.add_text(array, "DataClass", "DataClass_t", cg_DataClassName(NondimensionalParameter));
  else
    put_dimension(array, *exponents);
}

}  // namespace quadloop::io
