#include "adapt/transfer/linear_rows.hpp"

#include <algorithm>
#include <optional>

#include "adapt/transfer/locate/nearest_boundary.hpp"
#include "adapt/transfer/locate/unchanged_nodes.hpp"
#include "adapt/transfer/point_values.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::adapt {

namespace {

/// A place on the old boundary for a row of the new mesh.
struct PlacedRow {
  std::int64_t row;
  BoundaryPlace place;
};

/// Rows at owned nodes, and the lists of nodes without values: those outside the old mesh, and those that
/// take values from a side of a baffle.
struct NewRows {
  std::vector<double> values;
  std::vector<std::int32_t> outside;
  std::vector<PlacedRow> at_baffles;
};

/// Values of the old mesh at the positions of a new mesh's owned nodes, the first of which is `first_node`.
/// *Collective.*
NewRows rows_at(const PointValues& old, const BafflePlaces& baffles, GlobalNodeId first_node,
                std::span<const Point> places, Combine combine) {
  const std::vector<std::int32_t> standing = unchanged_nodes(old.mesh(), old.is_inner(), places);
  const std::size_t width = old.field().width();
  NewRows rows{std::vector<double>(places.size() * width), {}, {}};
  std::vector<std::int32_t> others;
  for (std::int32_t node = 0; node < std::ssize(places); ++node) {
    std::optional<BoundaryPlace> at_baffle = baffles.of_node(GlobalNodeId{first_node.value() + node});
    if (!at_baffle) at_baffle = baffles.across(places[node]);
    if (at_baffle) {
      rows.at_baffles.push_back({node, *at_baffle});
      continue;
    }
    if (standing[node] < 0) {
      others.push_back(node);
      continue;
    }
    const std::span<const double> row = old.field().row(NodeId{standing[node]});
    for (std::size_t k = 0; k < width; ++k) rows.values[node * width + k] = row[k];  // a few values each
  }
  std::vector<Point> asked;
  for (const std::int32_t node : others) asked.push_back(places[node]);
  const PointValues::Answers answers = old.at(asked, combine);
  for (std::size_t i = 0; i < others.size(); ++i) {
    std::copy_n(answers.values.begin() + i * width, width, rows.values.begin() + others[i] * width);
    if (answers.is_inside[i] == 0) rows.outside.push_back(others[i]);
  }
  return rows;
}

/// Ranks that have the nearest edges send the values there. *Collective.*
void take_from_boundary(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                        std::span<const Point> at, Combine combine, NewRows& rows) {
  std::vector<PlacedRow> placed = rows.at_baffles;
  if (comm.sum(std::ssize(rows.outside)) > 0) {
    const NearestBoundary boundary(comm, old_mesh);
    for (const std::int32_t node : rows.outside) placed.push_back({node, boundary.nearest(at[node])});
  }
  std::vector<BoundaryPlace> places;
  std::vector<int> ranks;
  for (const PlacedRow& one : placed) {
    places.push_back(one.place);
    ranks.push_back(one.place.rank);
  }
  const Exchange questions(comm, ranks);
  const auto edges = boundary_edges_of(old_mesh);
  const auto width = old_field.width();
  std::vector<double> row(width), answers;
  for (const BoundaryPlace& place : questions.deliver(places)) {
    const auto& [from, to] = edges[place.edge];
    interpolate_on_segment(old_field.row(from), old_field.row(to), place.parameter, row, combine);
    answers.insert(answers.end(), row.begin(), row.end());
  }
  answers = questions.answer(answers, width);
  for (std::size_t i = 0; i < placed.size(); ++i)
    std::copy_n(answers.begin() + (i * width), width, rows.values.begin() + (placed[i].row * width));
}

}  // namespace

LinearRows linear_rows(const Communicator& comm, const LinearSource& old, const Mesh& new_mesh,
                       std::span<const Point> places, Combine combine) {
  NewRows rows;
  if (old.field.width() > 0)
    rows = rows_at(PointValues(comm, old.mesh, old.field, old.centre, old.shares), old.baffles,
                   GlobalNodeId{new_mesh.first_node}, places, combine);
  const std::int64_t outside = comm.sum(std::ssize(rows.outside));
  if (outside > 0 || comm.sum(std::ssize(rows.at_baffles)) > 0)
    take_from_boundary(comm, old.mesh, old.field, places, combine, rows);
  return {std::move(rows.values), outside};
}

}  // namespace quadloop::adapt
