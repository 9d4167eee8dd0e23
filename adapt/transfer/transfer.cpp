#include "adapt/transfer/transfer.hpp"

#include <algorithm>

#include "adapt/transfer/cell_triangles.hpp"
#include "adapt/transfer/curve_shares.hpp"
#include "adapt/transfer/exchange_pieces.hpp"
#include "adapt/transfer/linear_values.hpp"
#include "adapt/transfer/locate_points.hpp"
#include "adapt/transfer/mesh_integrals.hpp"
#include "adapt/transfer/nearest_boundary.hpp"
#include "adapt/transfer/node_rows.hpp"
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
    std::copy(row, row + width, values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * width));
  }
};

/// Which new nodes were asked of each rank, and its answers: a row for each that lies in a triangle there, one after another.
struct Answers {
  ForRanks<std::int32_t> asked;
  ForRanks<char> inside;
  ForRanks<double> rows;
};

/// Answers all ranks' questions at once, so that the triangles are looked through once.
void answer(const TrianglePiece& piece, const ForRanks<Point>& questions, Answers& answers) {
  std::vector<Point> points;
  for (const auto& of_rank : questions) points.insert(points.end(), of_rank.begin(), of_rank.end());
  const std::vector<std::int32_t> found = locate_points(piece, points);
  std::vector<double> row(static_cast<std::size_t>(piece.rows.width));
  std::size_t i = 0;
  for (std::size_t rank = 0; rank < questions.size(); ++rank) {
    for (const Point p : questions[rank]) {
      const std::int32_t at = found[i++];
      answers.inside[rank].push_back(at >= 0 ? 1 : 0);
      if (at < 0) continue;
      const CellTriangle& triangle = piece.triangles[static_cast<std::size_t>(at)];
      const auto& [a, b, c] = triangle.nodes;
      interpolate_in_triangle(piece.corners(triangle), {piece.rows.of(a), piece.rows.of(b), piece.rows.of(c)}, p, row);
      answers.rows[rank].insert(answers.rows[rank].end(), row.begin(), row.end());
    }
  }
}

Answers ask(const Communicator& comm, const CurveShares& shares, const TrianglePiece& piece, const Mesh& mesh) {
  const auto ranks = static_cast<std::size_t>(comm.size());
  Answers answers{ForRanks<std::int32_t>(ranks), ForRanks<char>(ranks), ForRanks<double>(ranks)};
  ForRanks<Point> questions(ranks);
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const Point p = mesh.point(NodeId{node});
    const auto rank = static_cast<std::size_t>(shares.rank_of(p));
    answers.asked[rank].push_back(node);
    questions[rank].push_back(p);
  }
  answer(piece, exchange_pieces(comm, std::move(questions)), answers);
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
void take_from_boundary(const Communicator& comm, const Mesh& old_mesh, const NodeRows& old_rows, const Mesh& new_mesh,
                        const std::vector<std::int32_t>& outside, NewRows& rows) {
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
    for (std::size_t i = 0; i < asked[rank].size(); ++i) rows.put(asked[rank][i], answers[rank].data() + i * rows.width);
  }
}

/// What the old mesh had of each variable: its integral, and that of its absolute value.
struct OldIntegrals {
  std::vector<double> of_values, of_sizes;
};

void report_drift(const Communicator& comm, const Mesh& new_mesh, const std::vector<double>& values, const OldIntegrals& before,
                  TransferReport& report) {
  const auto triangles = cell_triangles(comm, new_mesh, centre_of_nodes(comm, new_mesh));
  const NodeRows rows = rows_with_copies(comm, new_mesh, values, static_cast<int>(before.of_values.size()));
  const std::vector<double> after = integrate(comm, new_mesh, triangles, rows);
  for (std::size_t k = 0; k < after.size(); ++k) {
    report.drift.push_back(after[k] - before.of_values[k]);
    report.relative_drift.push_back(before.of_sizes[k] > 0 ? report.drift[k] / before.of_sizes[k] : 0);
  }
}

}  // namespace

Transferred transfer(const Communicator& comm, const Mesh& old_mesh, std::span<const double> old_values, int width, const Mesh& new_mesh) {
  const NodeRows old_rows = rows_with_copies(comm, old_mesh, old_values, width);
  const auto triangles = cell_triangles(comm, old_mesh, centre_of_nodes(comm, old_mesh));
  const auto owned = [](const Mesh& mesh) { return std::span(mesh.points).first(static_cast<std::size_t>(mesh.owned_nodes)); };
  const CurveShares shares(comm, owned(old_mesh), owned(new_mesh));
  NewRows rows{static_cast<std::size_t>(width), std::vector<double>(owned(new_mesh).size() * static_cast<std::size_t>(width))};
  std::vector<std::int32_t> outside;
  {
    const TrianglePiece piece = gather_piece(comm, shares, old_mesh, old_rows, triangles);
    outside = take(ask(comm, shares, piece, new_mesh), rows);
  }
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
