#include "io/cgns/cgns_patches.hpp"

#include <array>
#include <utility>
#include <vector>

#include "io/cgns/cgns_layout.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/model/layers_text.hpp"

namespace quadloop::io {

CgnsPatches::CgnsPatches(CgnsNodes& nodes) : nodes_{nodes}, base_{nodes_.at(CgnsLayout::base_path)} {}

void CgnsPatches::begin_zone(const std::string& zone, std::int64_t first_element) {
  zone_ = nodes_.at(CgnsLayout::path_of_zone(zone));
  next_ = first_element;
}

/// HDF5 keeps a file open as long as any object in it is open.
void CgnsPatches::end_zone() {
  zone_ = {};
  conditions_ = {};
}

CgnsNodes::Node CgnsPatches::add_section(const std::string& name, ElementType_t type, std::int64_t elements) {
  const std::int64_t first = std::exchange(next_, next_ + elements);
  return nodes_.add_section(zone_, name, type, {first, next_ - 1}, CgnsLayout::nodes_of(type));
}

void CgnsPatches::put_full_name(const CgnsNodes::Node& node, const std::string& in_file,
                                const std::string& name) {
  if (in_file != name) nodes_.add_text(node, full_name_descriptor, "Descriptor_t", name);
}

void CgnsPatches::put_condition(const std::string& name, const BoundaryEdges& boundary,
                                GridLocation_t location) {
  const std::array<std::int64_t, 2> range{first_, next_ - 1};
  const std::string type = cg_BCTypeName(static_cast<BCType_t>(cgns_condition(boundary.condition)));
  if (families_.insert(name).second) {
    const CgnsNodes::Node family = nodes_.add(base_, name, "Family_t");
    nodes_.add_text(family, cgns_family_condition(boundary.condition), "FamilyBC_t", type);
  }
  if (!conditions_.valid()) conditions_ = nodes_.add(zone_, "ZoneBC", "ZoneBC_t");
  const CgnsNodes::Node condition =
      nodes_.add_text(conditions_, name, "BC_t", cg_BCTypeName(FamilySpecified));
  nodes_.add_sizes(condition, "PointRange", "IndexRange_t", range, 1);
  nodes_.add_text(condition, "GridLocation", "GridLocation_t", cg_GridLocationName(location));
  nodes_.add_text(condition, "FamilyName", "FamilyName_t", name);
  put_full_name(condition, name, boundary.name);
  if (boundary.layers.count > 0)
    nodes_.add_text(condition, layers_descriptor, "Descriptor_t", text_of_layers(boundary.layers));
}

void CgnsPatches::put_comments(const std::string& comments) {
  if (!comments.empty()) nodes_.add_text(zone_, strips_descriptor, "Descriptor_t", comments);
}

void CgnsPatches::put_pair(const std::string& zone, const std::string& name, const PeriodicPair& pair,
                           const PairedNodes& nodes) {
  const auto numbers_of = [](const BoundaryLine& line) {
    std::vector<std::int64_t> numbers;
    for (const GlobalNodeId node : line.nodes) numbers.push_back(node.value() + 1);
    return numbers;
  };
  const std::vector<std::int64_t> from = numbers_of(nodes.from), to = numbers_of(nodes.to);
  const CgnsNodes::Node forth = put_connection(zone, name, zone, from, to),
                        back = put_connection(zone, name + "_back", zone, to, from);
  if (pair.rotates()) return;
  put_translation(forth, pair.translation);
  put_translation(back, -1.0 * pair.translation);
}

void CgnsPatches::put_translation(const CgnsNodes::Node& connection, Point translation) {
  const CgnsNodes::Node property =
      nodes_.add(connection, "GridConnectivityProperty", "GridConnectivityProperty_t");
  const CgnsNodes::Node periodic = nodes_.add(property, "Periodic", "Periodic_t");
  const std::array<float, 2> none{},
      way{static_cast<float>(translation.x), static_cast<float>(translation.y)};
  const std::array<float, 5> of_length{0, 1, 0, 0, 0},
      of_angle{0, 0, 0, 0, 1};  // exponents of the five units
  const auto put_reals = [&](const char* of, const auto& values, const auto& exponents) {
    const CgnsNodes::Node reals = nodes_.add_reals(periodic, of, "DataArray_t", values);
    nodes_.add_reals(reals, "DimensionalExponents", "DimensionalExponents_t", exponents);
  };
  put_reals("RotationCenter", none, of_length);
  put_reals("RotationAngle", none, of_angle);
  put_reals("Translation", way, of_length);
}

CgnsNodes::Node CgnsPatches::put_connection(const std::string& zone, const std::string& name,
                                            const std::string& donor, std::span<const std::int64_t> nodes,
                                            std::span<const std::int64_t> of_donor) {
  constexpr const char* list = "ZoneGridConnectivity";
  const std::string path = CgnsLayout::path_of_zone(zone);
  const CgnsNodes::Node all = connected_.insert(zone).second
                                  ? nodes_.add(nodes_.at(path), list, "ZoneGridConnectivity_t")
                                  : nodes_.at(path + "/" + list);
  CgnsNodes::Node here = nodes_.add_text(all, name, "GridConnectivity_t", donor);
  nodes_.add_text(here, "GridConnectivityType", "GridConnectivityType_t",
                  cg_GridConnectivityTypeName(Abutting1to1));
  nodes_.add_text(here, "GridLocation", "GridLocation_t", cg_GridLocationName(Vertex));
  nodes_.add_sizes(here, "PointList", "IndexArray_t", nodes, 1);
  nodes_.add_sizes(here, "PointListDonor", "IndexArray_t", of_donor, 1);
  return here;
}

void CgnsPatches::put_block(const std::string& zone, std::int32_t number, const std::string& name) {
  const CgnsNodes::Node node = nodes_.at(CgnsLayout::path_of_zone(zone));
  nodes_.add_integers(node, "Ordinal", "Ordinal_t", std::array{number});
  put_full_name(node, zone, name);
}

}  // namespace quadloop::io
