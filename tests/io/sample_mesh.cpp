#include "tests/io/sample_mesh.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "io/formats.hpp"
#include "mesher/base/ids.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

namespace {

std::pair<std::size_t, std::size_t> share(std::size_t count, int rank, int ranks) {
  const auto r = static_cast<std::size_t>(rank), n = static_cast<std::size_t>(ranks);
  return {count * r / n, count * (r + 1) / n};
}

/// Renumbers nodes of the whole mesh to those of one rank, which learns of copies as it goes.
class Localiser {
 public:
  Localiser(const Mesh& whole, Mesh& part) : whole_{whole}, part_{part} {}

  NodeId operator()(NodeId node) {
    const auto local = node.value() - static_cast<std::int32_t>(part_.first_node);
    if (local >= 0 && local < part_.owned_nodes) return NodeId{local};
    const auto [found, added] = ghosts_.emplace(node.value(), size32(part_.points));
    if (added) {
      part_.points.push_back(whole_.point(node));
      part_.ghosts.push_back(GlobalNodeId{node.value()});
    }
    return NodeId{found->second};
  }

  template <class Rows>
  Rows rows(const Rows& all, int rank, int ranks) {
    const auto [begin, end] = share(all.size(), rank, ranks);
    Rows own(all.begin() + static_cast<std::ptrdiff_t>(begin),
             all.begin() + static_cast<std::ptrdiff_t>(end));
    for (auto& row : own) {
      for (NodeId& node : row) node = (*this)(node);
    }
    return own;
  }

 private:
  const Mesh& whole_;
  Mesh& part_;
  std::map<std::int32_t, std::int32_t> ghosts_;
};

}  // namespace

Mesh sample_mesh(std::int32_t columns) {
  Mesh mesh;
  const auto node = [&](std::int32_t i, std::int32_t j) { return NodeId{j * (columns + 1) + i}; };
  for (std::int32_t j = 0; j <= 2; ++j) {
    for (std::int32_t i = 0; i <= columns; ++i)
      mesh.points.push_back({static_cast<double>(i), static_cast<double>(j)});
  }
  mesh.owned_nodes = size32(mesh.points);
  BoundaryEdges wall{"wall", "wall", {}}, sides{"far field", "farfield", {}};
  for (std::int32_t i = 0; i < columns; ++i) {
    mesh.quads.push_back({node(i, 0), node(i + 1, 0), node(i + 1, 1), node(i, 1)});
    mesh.triangles.push_back({node(i, 1), node(i + 1, 1), node(i + 1, 2)});
    mesh.triangles.push_back({node(i, 1), node(i + 1, 2), node(i, 2)});
    wall.edges.push_back({node(i, 0), node(i + 1, 0)});
    wall.edges.push_back({node(i + 1, 2), node(i, 2)});
  }
  for (std::int32_t j = 0; j < 2; ++j) {
    sides.edges.push_back({node(columns, j), node(columns, j + 1)});
    sides.edges.push_back({node(0, j + 1), node(0, j)});
  }
  mesh.boundaries = {wall, sides};
  return mesh;
}

StripLayers strip_across(const Mesh& mesh, std::int32_t columns) {
  StripLayers strip{"wake_2", {1, 1 / 3.0}, true, 3, {}};
  for (std::int32_t i = 1; i <= 3; ++i) {
    for (std::int32_t j = 0; j <= 2; ++j) strip.nodes.push_back(mesh.global(NodeId{j * (columns + 1) + i}));
  }
  return strip;
}

Field sample_solution(const Mesh& mesh) {
  Field solution{{"density", "pressure"}, {}, {12, 0.1, -3e-300}};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    solution.values.push_back(1 + i / 3.0);
    solution.values.push_back(-1e17 / (i + 7));
  }
  return solution;
}

Mesh share_of(const Mesh& whole, int rank, int ranks) {
  Mesh part;
  const auto [begin, end] = share(whole.points.size(), rank, ranks);
  part.first_node = static_cast<std::int64_t>(begin);
  part.owned_nodes = static_cast<std::int32_t>(end - begin);
  part.points.assign(whole.points.begin() + static_cast<std::ptrdiff_t>(begin),
                     whole.points.begin() + static_cast<std::ptrdiff_t>(end));
  Localiser localise(whole, part);
  part.triangles = localise.rows(whole.triangles, rank, ranks);
  part.quads = localise.rows(whole.quads, rank, ranks);
  for (const BoundaryEdges& boundary : whole.boundaries) {
    part.boundaries.push_back(
        {boundary.name, boundary.condition, localise.rows(boundary.edges, rank, ranks), boundary.layers});
  }
  part.strips = whole.strips;
  return part;
}

Field share_of(const Field& whole, const Mesh& mesh, const Mesh& share) {
  Field part{whole.names, {}, whole.constants};
  const std::size_t width = whole.values.size() / mesh.points.size();
  const auto begin =
      whole.values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(share.first_node) * width);
  part.values.assign(
      begin, begin + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(share.owned_nodes) * width));
  return part;
}

TreeRecord sample_tree(std::int32_t leaves, int rank, int ranks) {
  TreeRecord tree;
  tree.attributes.root_x = -0.1;
  tree.attributes.tree_edge = 20;
  tree.attributes.coordinate_digest = 0xFEDCBA9876543210;
  const std::int32_t split =
      (leaves - 1) / 4 % 2 == 0 ? 1 : 2;  // the first tree has 4 or 16 leaves, the others one
  const std::int32_t in_first = 1 << (2 * split), edge = std::int32_t{1} << (30 - split);
  tree.attributes.trees_x = leaves - in_first + 1;
  const auto leaf = [&](std::int32_t n) {
    const auto mark = static_cast<std::int16_t>(n % 2);
    const auto level = static_cast<std::int8_t>(n < in_first ? split : 0);
    const std::int32_t x = (n & 1) + (n >> 1 & 2), y = (n >> 1 & 1) + (n >> 2 & 2);
    const auto wanted = static_cast<std::int8_t>(level - n % 2 * (level > 0 ? 1 : 0));
    return n < in_first
               ? LeafRecord{0,      0,    x * edge,       y * edge,       level,
                            wanted, mark, mark * (n % 4), mark * (n % 6), static_cast<std::uint32_t>(n % 2)}
               : LeafRecord{n - in_first + 1, 0, 0, 0, level, wanted, mark, mark * (n % 4),
                            mark * (n % 6),   0};
  };
  for (std::int32_t n = 0; n < leaves; ++n) {
    tree.attributes.triangles += leaf(n).triangles;
    tree.attributes.quads += leaf(n).quads;
  }
  const auto [begin, end] = share(static_cast<std::size_t>(leaves), rank, ranks);
  for (std::size_t i = begin; i < end; ++i) tree.leaves.push_back(leaf(static_cast<std::int32_t>(i)));
  return tree;
}

ExitStatus status_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.status();
  }
  return ExitStatus::done;
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

BoundaryCondition condition_back(const std::string& format, BoundaryCondition condition) {
  if (!io::format_named(format)->holds(io::Content::conditions)) return BoundaryCondition::none;
  const std::map<std::string, std::map<std::string, std::string>> changed{
      {"fluent.msh", {{"viscous_wall", "wall"}, {"inviscid_wall", "wall"}, {"none", "wall"}}},
      {"ugrid", {{"wall", "viscous_wall"}, {"symmetry", "inviscid_wall"}, {"interface", "none"}}}};
  const auto row = changed.find(format.ends_with(".ugrid") ? "ugrid" : format);
  if (row == changed.end() || !row->second.contains(condition.word())) return condition;
  return *BoundaryCondition::named(row->second.at(condition.word()));
}

}  // namespace quadloop::test
