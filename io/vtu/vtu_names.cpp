#include "io/vtu/vtu_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/model/node_text.hpp"
#include "io/model/pair_text.hpp"
#include "io/model/strip_text.hpp"
#include "io/vtu/vtu_layers.hpp"

namespace quadloop::io {

namespace {

void read_layers(const TextScanner& scan, const VtuDocument& document, const VtuNumbers& numbers,
                 FileMesh& mesh, VtuNames& names) {
  const VtuArray* const counts = document.find("FieldData", vtu_layer_counts);
  const VtuArray* const thicknesses = document.find("FieldData", vtu_layer_thicknesses);
  if (counts == nullptr || counts->type.starts_with("Float")) return;
  const std::int64_t boundaries = std::ssize(names.boundaries);
  const std::vector<std::int64_t> of_boundary = numbers.integers(*counts, boundaries);
  std::vector<double> thickness(of_boundary.size());
  if (thicknesses != nullptr) thickness = numbers.reals(*thicknesses, boundaries);
  for (std::size_t b = 0; b < thickness.size(); ++b) {
    if (!std::isfinite(thickness[b]))
      scan.refuse_at(thicknesses->place,
                     fmt::format("'{}' is not finite at node {}", thicknesses->name, b + 1));
  }
  names.has_layers = true;
  for (std::size_t b = 0; b < of_boundary.size(); ++b) {
    const bool is_count = of_boundary[b] > 0 && of_boundary[b] <= std::numeric_limits<std::int32_t>::max();
    if (!is_count) continue;
    mesh.boundaries[mesh.boundary_named(names.boundaries[b])].layers = {
        static_cast<std::int32_t>(of_boundary[b]), std::max(0.0, thickness[b])};
  }
}

void read_strips(const VtuDocument& document, const VtuNumbers& numbers, const VtuArray& array,
                 FileMesh& mesh) {
  std::string texts;
  for (const std::string& text : numbers.texts(array)) texts += text + "\n";
  mesh.strips = strips_in_comments(texts, static_cast<std::int32_t>(document.points)).strips;
  mesh.pairs = pairs_in_comments(texts);
  mesh.named_nodes = nodes_in_comments(texts, static_cast<std::int32_t>(document.points));
}

}  // namespace

VtuNames read_vtu_names(const TextScanner& scan, const VtuDocument& document, const VtuNumbers& numbers,
                        FileMesh& mesh) {
  VtuNames names;
  if (const VtuArray* array = document.find("FieldData", "boundary_names"))
    names.boundaries = numbers.texts(*array);
  if (const VtuArray* array = document.find("FieldData", "block_names")) names.blocks = numbers.texts(*array);
  for (const std::string& name : names.boundaries) mesh.boundary_named(name);  // in their order
  for (const std::string& name : names.blocks) mesh.block_named(name);
  read_layers(scan, document, numbers, mesh, names);
  if (const VtuArray* array = document.find("FieldData", vtu_strips))
    read_strips(document, numbers, *array, mesh);
  return names;
}

bool is_nodal_variable(const VtuArray& array, const VtuNames& names) {
  const bool is_height =
      names.has_layers && (array.name == vtu_layer_height_asked || array.name == vtu_layer_height);
  return array.section == "PointData" && array.type != "String" && !is_height;
}

bool is_cell_variable(const VtuArray& array) {
  return array.section == "CellData" && array.type.starts_with("Float");
}

std::string name_of_component(const TextScanner& scan, const VtuArray& array, std::size_t component) {
  if (array.components > 9)
    scan.refuse_at(array.place, fmt::format("'{}' has {} components; at most 9 can be read", array.name,
                                            array.components));
  if (array.components == 1) return array.name;
  if (array.components <= 3) return array.name + "_" + "xyz"[component];
  return array.name + "_" + std::to_string(component + 1);
}

}  // namespace quadloop::io
