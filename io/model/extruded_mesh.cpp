#include "io/model/extruded_mesh.hpp"

#include <algorithm>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

std::string free_name(const Mesh& mesh, const std::string& wanted) {
  std::string name = wanted;
  for (int number = 2; std::ranges::count(mesh.boundaries, name, &BoundaryEdges::name) > 0; ++number)
    name = wanted + "_" + std::to_string(number);
  return name;
}

/// Returns the column of "x_velocity" etc., under whatever name; none if it is ambiguous or missing.
std::int64_t column_of(const std::vector<std::string>& names, const std::string& wanted) {
  const std::vector<std::size_t> found = variables_like(names, wanted);
  return found.size() == 1 ? static_cast<std::int64_t>(found.front()) : ExtrudedVariable::zero;
}

}  // namespace

std::vector<double> even_heights(std::int64_t layers, double thickness) {
  std::vector<double> heights(layers + 1);
  for (std::int64_t k = 0; k <= layers; ++k)
    heights[k] = thickness * (static_cast<double>(k) / static_cast<double>(layers));
  return heights;
}

ExtrudedMesh extruded(const Mesh& plane, std::vector<double> heights, ExtrusionAxis axis,
                      const Field* solution) {
  QUADLOOP_REQUIRE(heights.size() >= 2 && std::ranges::is_sorted(heights, std::ranges::less_equal()) &&
                       std::ranges::adjacent_find(heights) == heights.end(),
                   "heights of an extrusion ascend");
  if (axis == ExtrusionAxis::y) std::ranges::reverse(heights);  // x, z and -y are right-handed
  return {plane, std::move(heights), axis, free_name(plane, "back"), free_name(plane, "front"), solution};
}

ExtrudedCounts::ExtrudedCounts(const Communicator& comm, const ExtrudedMesh& mesh)
    : triangles{comm.sum(std::ssize(mesh.plane.triangles))}, quads{comm.sum(std::ssize(mesh.plane.quads))} {
  nodes = comm.sum(mesh.plane.owned_nodes) * mesh.levels();
  prisms = triangles * mesh.layers();
  hexahedra = quads * mesh.layers();
}

std::vector<ExtrudedVariable> extruded_variables(const std::vector<std::string>& plane, ExtrusionAxis axis) {
  std::vector<ExtrudedVariable> variables;
  for (const std::string& name : plane) variables.push_back({name, std::ssize(variables)});
  for (const std::string vector : {"velocity", "momentum"}) {
    const std::int64_t x = column_of(plane, "x_" + vector), y = column_of(plane, "y_" + vector);
    if (x == ExtrudedVariable::zero || y == ExtrudedVariable::zero) continue;
    const bool along_y = axis == ExtrusionAxis::y;
    variables[x].name = "x_" + vector;
    variables[y].name = (along_y ? "z_" : "y_") + vector;
    const std::string third = (along_y ? "y_" : "z_") + vector;
    if (std::ranges::count(variables, third, &ExtrudedVariable::name) == 0) variables.push_back({third});
  }
  return variables;
}

}  // namespace quadloop::io
