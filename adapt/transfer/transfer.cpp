#include "adapt/transfer/transfer.hpp"

#include <algorithm>

#include "adapt/transfer/cell_triangles.hpp"
#include "adapt/transfer/curve_shares.hpp"
#include "adapt/transfer/equal_points.hpp"
#include "adapt/transfer/exchange_pieces.hpp"
#include "adapt/transfer/linear_values.hpp"
#include "adapt/transfer/locate_points.hpp"
#include "adapt/transfer/mesh_integrals.hpp"
#include "adapt/transfer/nearest_boundary.hpp"
#include "adapt/transfer/node_rows.hpp"
#include "adapt/transfer/point_cells.hpp"
#include "adapt/transfer/triangle_piece.hpp"

namespace quadloop {

namespace {

template <class T>
using ForRanks = std::vector<std::vector<T>>;

/// Rows of new values at owned nodes, as they are found.
struct NewRows {
  std::size_t width = 0;
  std::vector<double> values;

  void put(std::int32_t node, const double* row) {
    std::copy(row, row + width,
              values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * width));
  }
};

/// Which new nodes were asked of each rank, and its answers: a row for each that lies in a triangle there,
/// one after another.
struct Answers {
  ForRanks<std::int32_t> asked;
  ForRanks<char> inside;
  ForRanks<double> rows;
};

/// The old mesh, and by which shares of the plane it is asked.
struct OldMesh {
  const Mesh& mesh;
  const NodeRows& rows;
  std::span<const CellTriangle> triangles;
  const CurveShares& shares;
};

/// Old nodes with their rows, those of one share of the plane.
struct NodeShare {
  std::vector<Point> points;
  NodeRows rows;
};

template <class T>
std::vector<T> joined(ForRanks<T> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  std::vector<T> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

NodeShare gather_nodes(const Communicator& comm, const OldMesh& old) {
  const auto ranks = static_cast<std::size_t>(comm.size());
  ForRanks<Point> points(ranks);
  ForRanks<double> rows(ranks);
  for (std::int32_t node = 0; node < old.mesh.owned_nodes; ++node) {
    const Point p = old.mesh.point(NodeId{node});
    const auto rank = static_cast<std::size_t>(old.shares.rank_of(p));
    const auto row = old.rows.of(NodeId{node});
    points[rank].push_back(p);
    rows[rank].insert(rows[rank].end(), row.begin(), row.end());
  }
  return {joined(exchange_pieces(comm, std::move(points))),
          {old.rows.width, joined(exchange_pieces(comm, std::move(rows)))}};
}

/// Only triangles that may hold one of the points leave their rank.
TrianglePiece gather_triangles(const Communicator& comm, const OldMesh& old, std::span<const Point> points) {
  const PointCells cells(comm, old.shares.grid(), points);
  std::vector<CellTriangle> near;
  for (const CellTriangle& triangle : old.triangles) {
    Box box;
    for (const NodeId node : triangle.nodes) box.include(old.mesh.point(node));
    if (cells.meet(box)) near.push_back(triangle);
  }
  return gather_piece(comm, old.shares, old.mesh, old.rows, near);
}

/// The old mesh's values at points of this rank's share of the plane.
class Found {
 public:
  /// *Collective.*
  Found(const Communicator& comm, const OldMesh& old, std::span<const Point> points)
      : points_{points}, nodes_{gather_nodes(comm, old)} {
    at_node_ = find_equal_points(nodes_.points, points);
    std::vector<Point> moved;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (at_node_[i] < 0) moved.push_back(points[i]);
    }
    piece_ = gather_triangles(comm, old, moved);
    in_triangle_ = locate_points(piece_, moved);
  }

  /// Fills the row of the next point; false where it lies outside the old mesh.
  bool next(std::span<double> row) {
    const std::size_t point = next_point_++;
    if (const std::int32_t node = at_node_[point]; node >= 0) {
      const auto values = nodes_.rows.of(NodeId{node});
      std::copy(values.begin(), values.end(), row.begin());
      return true;
    }
    const std::int32_t found = in_triangle_[next_moved_++];
    if (found < 0) return false;
    const CellTriangle& triangle = piece_.triangles[static_cast<std::size_t>(found)];
    const auto& [a, b, c] = triangle.nodes;
    interpolate_in_triangle(piece_.corners(triangle),
                            {piece_.rows.of(a), piece_.rows.of(b), piece_.rows.of(c)}, points_[point], row);
    return true;
  }

 private:
  std::span<const Point> points_;
  NodeShare nodes_;
  TrianglePiece piece_;
  std::vector<std::int32_t> at_node_;      ///< of each point the old node at its place, -1 for none
  std::vector<std::int32_t> in_triangle_;  ///< of each of the others its triangle in the piece
  std::size_t next_point_ = 0, next_moved_ = 0;
};

Answers ask(const Communicator& comm, const OldMesh& old, const Mesh& mesh) {
  const auto ranks = static_cast<std::size_t>(comm.size());
  Answers answers{ForRanks<std::int32_t>(ranks), ForRanks<char>(ranks), ForRanks<double>(ranks)};
  ForRanks<Point> questions(ranks);
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const Point p = mesh.point(NodeId{node});
    const auto rank = static_cast<std::size_t>(old.shares.rank_of(p));
    answers.asked[rank].push_back(node);
    questions[rank].push_back(p);
  }
  questions = exchange_pieces(comm, std::move(questions));
  std::vector<std::size_t> counts;
  for (const auto& of_rank : questions) counts.push_back(of_rank.size());
  const std::vector<Point> points = joined(std::move(questions));
  Found found(comm, old, points);
  std::vector<double> row(static_cast<std::size_t>(old.rows.width));
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    answers.inside[rank].reserve(counts[rank]);
    answers.rows[rank].reserve(counts[rank] * row.size());
    for (std::size_t i = 0; i < counts[rank]; ++i) {
      const bool inside = found.next(row);
      answers.inside[rank].push_back(inside ? 1 : 0);
      if (inside) answers.rows[rank].insert(answers.rows[rank].end(), row.begin(), row.end());
    }
  }
  answers.inside = exchange_pieces(comm, std::move(answers.inside));
  answers.rows = exchange_pieces(comm, std::move(answers.rows));
  return answers;
}

/// The nodes that lie in no triangle.
std::vector<std::int32_t> take(const Answers& answers, NewRows& rows) {
  std::vector<std::int32_t> outside;
  for (std::size_t rank = 0; rank < answers.asked.size(); ++rank) {
    const double* row = answers.rows[rank].data();
    for (std::size_t i = 0; i < answers.asked[rank].size(); ++i) {
      if (answers.inside[rank][i] == 0) {
        outside.push_back(answers.asked[rank][i]);
        continue;
      }
      rows.put(answers.asked[rank][i], row);
      row += rows.width;
    }
  }
  return outside;
}

/// Each rank that has an edge tells the values there.
void take_from_boundary(const Communicator& comm, const Mesh& old_mesh, const NodeRows& old_rows,
                        const Mesh& new_mesh, const std::vector<std::int32_t>& outside, NewRows& rows) {
  const NearestBoundary boundary(comm, old_mesh);
  const auto ranks = static_cast<std::size_t>(comm.size());
  ForRanks<std::int32_t> asked(ranks);
  ForRanks<BoundaryPlace> questions(ranks);
  for (const std::int32_t node : outside) {
    const BoundaryPlace place = boundary.nearest(new_mesh.point(NodeId{node}));
    asked[static_cast<std::size_t>(place.rank)].push_back(node);
    questions[static_cast<std::size_t>(place.rank)].push_back(place);
  }
  questions = exchange_pieces(comm, std::move(questions));
  const auto edges = boundary_edges_of(old_mesh);
  std::vector<double> row(rows.width);
  ForRanks<double> answers(ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    for (const BoundaryPlace& place : questions[rank]) {
      const auto& [from, to] = edges[static_cast<std::size_t>(place.edge)];
      interpolate_on_segment(old_rows.of(from), old_rows.of(to), place.parameter, row);
      answers[rank].insert(answers[rank].end(), row.begin(), row.end());
    }
  }
  answers = exchange_pieces(comm, std::move(answers));
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    for (std::size_t i = 0; i < asked[rank].size(); ++i)
      rows.put(asked[rank][i], answers[rank].data() + i * rows.width);
  }
}

/// What the old mesh had of each variable: its integral, and that of its absolute value.
struct OldIntegrals {
  std::vector<double> of_values, of_sizes;
};

void report_drift(const Communicator& comm, const Mesh& new_mesh, const std::vector<double>& values,
                  const OldIntegrals& before, TransferReport& report) {
  const auto triangles = cell_triangles(comm, new_mesh, centre_of_nodes(comm, new_mesh));
  const NodeRows rows = rows_with_copies(comm, new_mesh, values, static_cast<int>(before.of_values.size()));
  const std::vector<double> after = integrate(comm, new_mesh, triangles, rows);
  for (std::size_t k = 0; k < after.size(); ++k) {
    report.drift.push_back(after[k] - before.of_values[k]);
    report.relative_drift.push_back(before.of_sizes[k] > 0 ? report.drift[k] / before.of_sizes[k] : 0);
  }
}

}  // namespace

Transferred transfer(const Communicator& comm, const Mesh& old_mesh, std::span<const double> old_values,
                     int width, const Mesh& new_mesh) {
  const NodeRows old_rows = rows_with_copies(comm, old_mesh, old_values, width);
  const auto triangles = cell_triangles(comm, old_mesh, centre_of_nodes(comm, old_mesh));
  const auto owned = [](const Mesh& mesh) {
    return std::span(mesh.points).first(static_cast<std::size_t>(mesh.owned_nodes));
  };
  const CurveShares shares(comm, owned(old_mesh), owned(new_mesh));
  NewRows rows{static_cast<std::size_t>(width),
               std::vector<double>(owned(new_mesh).size() * static_cast<std::size_t>(width))};
  const std::vector<std::int32_t> outside =
      take(ask(comm, {old_mesh, old_rows, triangles, shares}, new_mesh), rows);
  Transferred transferred;
  transferred.report.outside = comm.sum(static_cast<std::int64_t>(outside.size()));
  if (transferred.report.outside > 0) take_from_boundary(comm, old_mesh, old_rows, new_mesh, outside, rows);
  transferred.values = std::move(rows.values);
  OldIntegrals before{integrate(comm, old_mesh, triangles, old_rows), {}};
  before.of_sizes = integrate_sizes(comm, old_mesh, triangles, old_rows, before.of_values);
  report_drift(comm, new_mesh, transferred.values, before, transferred.report);
  return transferred;
}

}  // namespace quadloop
