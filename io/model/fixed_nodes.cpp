#include "io/model/fixed_nodes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

std::string quoted(const std::vector<std::string>& names) {
  return fmt::format("'{}'", fmt::join(names, "', '"));
}

class Fixed {
 public:
  Fixed(const LoadedMesh& loaded, NodeFlags& flags) : loaded_{loaded}, flags_{flags} {}

  template <class Nodes>
  void fix(const Nodes& nodes) {
    flags_.resize(loaded_.mesh.points.size(), 0);
    for (const NodeId node : nodes) flags_[node] = 1;
  }
  void fix(const BoundaryEdges& curve) {
    for (const auto& edge : curve.edges) fix(edge);
  }

  /// Returns whether anything has this name.
  bool fix_named(const std::string& name) {
    bool found = false;
    for (const auto* curves : {&loaded_.mesh.boundaries, &loaded_.inner_curves}) {
      for (const BoundaryEdges& curve : *curves) {
        if (curve.name != name) continue;
        fix(curve);
        found = true;
      }
    }
    for (std::int32_t block = 0; block < std::ssize(loaded_.block_names); ++block) {
      if (loaded_.block_names[block] != name) continue;
      for (const auto& cell : cells_of_block(loaded_.mesh.triangles, loaded_.triangle_to_block, block))
        fix(cell);
      for (const auto& cell : cells_of_block(loaded_.mesh.quads, loaded_.quad_to_block, block)) fix(cell);
      found = true;
    }
    return found;
  }

 private:
  const LoadedMesh& loaded_;
  NodeFlags& flags_;
};

std::vector<std::string> known_names(const LoadedMesh& loaded) {
  std::set<std::string> names(loaded.block_names.begin(), loaded.block_names.end());
  for (const auto* curves : {&loaded.mesh.boundaries, &loaded.inner_curves}) {
    for (const BoundaryEdges& curve : *curves) names.insert(curve.name);
  }
  return {names.begin(), names.end()};
}

/// Returns boundaries with an edge whose nodes are both periodic.
std::vector<std::string> periodic_boundaries(const LoadedMesh& loaded) {
  NodeFlags periodic(loaded.mesh.points.size(), 0);
  for (const NodeId node : loaded.periodic_nodes) periodic[node] = 1;
  const auto is_periodic = [&](const auto& edge) { return periodic[edge[0]] != 0 && periodic[edge[1]] != 0; };
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : loaded.mesh.boundaries) {
    if (std::ranges::any_of(boundary.edges, is_periodic)) names.push_back(boundary.name);
  }
  return names;
}

}  // namespace

std::vector<std::string> fix_nodes(const LoadedMesh& loaded, std::span<const std::string> names,
                                   const std::string& path, NodeFlags& flags) {
  Fixed fixed(loaded, flags);
  for (const std::string& name : names) {
    if (!fixed.fix_named(name))
      throw InputError(fmt::format("--fix: {} has no boundary, inner curve or block '{}', but {}", path, name,
                                   quoted(known_names(loaded))));
  }
  std::vector<std::string> notes;
  if (!loaded.periodic_nodes.empty()) {
    fixed.fix(loaded.periodic_nodes);
    notes.push_back(
        fmt::format("{}: the nodes of {} are fixed, because these sides are periodic or match node by node",
                    path, quoted(periodic_boundaries(loaded))));
  }
  std::vector<std::string> names_of_nodes;
  for (const NamedNode& named : loaded.mesh.named_nodes) {
    fixed.fix(std::array{NodeId{static_cast<std::int32_t>(named.node.value())}});
    names_of_nodes.push_back(named.name);
  }
  if (!names_of_nodes.empty())
    notes.push_back(fmt::format("{}: the named nodes {} are fixed", path, quoted(names_of_nodes)));
  std::vector<std::string> curves;
  for (const BoundaryEdges& curve : loaded.inner_curves) {
    fixed.fix(curve);
    curves.push_back(curve.name);
  }
  if (!curves.empty())
    notes.push_back(fmt::format("{}: the nodes of the inner curves {} are fixed", path, quoted(curves)));
  return notes;
}

}  // namespace quadloop::io
