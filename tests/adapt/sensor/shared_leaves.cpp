#include "tests/adapt/sensor/shared_leaves.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include "mesher/base/ids.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

LeafRecord leaf_with(std::int32_t triangles, std::int32_t quads) {
  LeafRecord leaf;
  leaf.triangles = triangles;
  leaf.quads = quads;
  return leaf;
}

std::vector<LeafRecord> leaves_of(const Mesh& whole, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  auto triangles = size32(whole.triangles), quads = size32(whole.quads);
  std::vector<LeafRecord> leaves;
  while (triangles + quads > 0) {
    leaves.push_back(leaf_with(std::min(triangles, static_cast<std::int32_t>(random() % 4)),
                               std::min(quads, static_cast<std::int32_t>(random() % 4))));
    triangles -= leaves.back().triangles;
    quads -= leaves.back().quads;
  }
  leaves.push_back({});
  return leaves;
}

Piece piece_of(std::size_t count, Sharing sharing) {
  const auto rank = static_cast<std::size_t>(world().rank()),
             ranks = static_cast<std::size_t>(world().size());
  const auto cut = [&](std::size_t r) -> std::size_t {
    if (r == 0 || r == ranks) return r == 0 ? 0 : count;
    const std::size_t even = (r + 1) / 2 * 2;  // every other rank has nothing
    switch (sharing) {
      case Sharing::even: return count * r / ranks;
      case Sharing::uneven: return count * even * even / (ranks * ranks);
      case Sharing::last_rank: return 0;
    }
    return 0;
  };
  return {cut(rank), cut(rank + 1)};
}

Pieces::Pieces(const Mesh& mesh, const MeshOrder& order)
    : whole{scatter_mesh(Communicator(MPI_COMM_SELF), mesh, order)},
      part{scatter_mesh(world(), mesh, order)} {}

Mesh part_of(const Grid& grid) {
  const Mesh whole = grid.mesh();
  return Pieces(whole, own_order(whole)).part;
}

void for_each_distribution(const std::function<void(const Pieces&)>& check) {
  for (const std::int32_t n : {1, 2, 9}) {
    const Grid grid{n};
    Mesh mesh = grid.mesh();
    jitter(grid, 0.2, 3, mesh);
    for (const MeshOrder& order : {space_filling_order(mesh), shuffled_order(mesh, 12)})
      check(Pieces(mesh, order));
  }
}

Field field_of(const Mesh& mesh, const std::string& name,
               const std::function<double(std::int64_t, Point)>& value) {
  Field field{{name}, {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node)
    field.values.push_back(value(mesh.first_node + node, mesh.point(NodeId{node})));
  field.values.resize(mesh.points.size(), std::numeric_limits<double>::quiet_NaN());
  return field;
}

RuledFlags flags_by(const adapt::ThresholdRule& rule, const Communicator& comm,
                    std::span<const LeafRecord> leaves, std::span<const double> values) {
  const adapt::OrderedValues ordered(comm, leaves, values);
  RuledFlags ruled;
  ruled.statistics = adapt::statistics_of(comm, ordered);
  ruled.thresholds = adapt::thresholds_by(rule, ordered, ruled.statistics);
  ruled.flags = adapt::flags_above(leaves, values, ruled.thresholds);
  ruled.refined = adapt::count_of(comm, ruled.flags, adapt::RefinementFlag::refine);
  ruled.coarsened = adapt::count_of(comm, ruled.flags, adapt::RefinementFlag::coarsen);
  return ruled;
}

Field joined_fields(const Field& one, const Field& other) {
  Field both{one.names, {}, {}};
  both.names.insert(both.names.end(), other.names.begin(), other.names.end());
  for (std::size_t i = 0; i < one.values.size() / one.width(); ++i) {
    for (const Field* field : {&one, &other}) {
      const auto row = field->row(NodeId{static_cast<std::int32_t>(i)});
      both.values.insert(both.values.end(), row.begin(), row.end());
    }
  }
  return both;
}

}  // namespace quadloop::test
