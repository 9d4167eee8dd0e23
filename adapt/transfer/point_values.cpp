#include "adapt/transfer/point_values.hpp"

#include <algorithm>
#include <utility>

#include "adapt/transfer/locate/cell_triangles.hpp"
#include "adapt/transfer/locate/locate_points.hpp"
#include "adapt/transfer/locate/point_cells.hpp"
#include "adapt/transfer/locate/triangle_piece.hpp"
#include "adapt/transfer/locate/unchanged_nodes.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/geometry/point_table.hpp"

namespace quadloop::adapt {

namespace {

/// Nodes with their rows, in one part of the plane.
struct NodeShare {
  std::vector<Point> points;
  Field field;
};

/// Exchange from this rank's points to the ranks whose parts of the plane contain them.
Exchange to_partition(const Communicator& comm, const CurvePartition& shares, std::span<const Point> points) {
  std::vector<int> ranks;
  for (const Point p : points) ranks.push_back(shares.rank_of(p));
  return {comm, ranks};
}

/// Boundary nodes that may coincide with one of the points. Interior nodes are corners of triangles, and none
/// coincides with another.
NodeShare gather_boundary_nodes(const Communicator& comm, const PointValues& old, const PointCells& cells) {
  std::vector<Point> points;
  std::vector<double> values;
  for (const NodeId node : old.is_inner().ids()) {
    const Point p = old.mesh().point(node);
    if (old.is_inner()[node] != 0 || !cells.meet({p, p})) continue;
    points.push_back(p);
    const auto row = old.field().row(node);
    values.insert(values.end(), row.begin(), row.end());
  }
  const Exchange exchange = to_partition(comm, old.shares(), points);
  return {exchange.deliver(points), {old.field().names, exchange.deliver(values, old.field().width()), {}}};
}

/// Sends only triangles of cells that may contain one of the points.
TrianglePiece gather_triangles(const Communicator& comm, const PointValues& old, const PointCells& cells) {
  const std::vector<CellTriangle> near = cell_triangles(comm, old.mesh(), old.centre(), cells);
  return gather_piece(comm, old.shares(), old.mesh(), old.field(), near);
}

/// The old mesh's values at points of this rank's part of the plane.
class Found {
 public:
  /// *Collective.*
  Found(const Communicator& comm, const PointValues& old, std::span<const Point> points) : points_{points} {
    const PointCells cells(comm, old.shares().grid(), points);
    nodes_ = gather_boundary_nodes(comm, old, cells);
    at_node_ = find_equal_points(nodes_.points, points);
    std::vector<Point> moved;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (at_node_[i] < 0) moved.push_back(points[i]);
    }
    piece_ = gather_triangles(comm, old, cells);
    in_triangle_ = locate_points(piece_, moved);
  }

  /// Fills the row of the next point; returns false if the point is outside the old mesh.
  bool next(std::span<double> row, Combine combine) {
    const std::size_t point = next_point_++;
    if (const std::int32_t node = at_node_[point]; node >= 0) {
      const auto values = nodes_.field.row(NodeId{node});
      std::copy(values.begin(), values.end(), row.begin());
      return true;
    }
    const std::int32_t found = in_triangle_[next_moved_++];
    if (found < 0) return false;
    const CellTriangle& triangle = piece_.triangles[found];
    const auto& [a, b, c] = triangle.nodes;
    interpolate_in_triangle(piece_.corners(triangle),
                            {piece_.field.row(a), piece_.field.row(b), piece_.field.row(c)}, points_[point],
                            row, combine);
    return true;
  }

 private:
  std::span<const Point> points_;
  NodeShare nodes_;
  TrianglePiece piece_;
  std::vector<std::int32_t> at_node_;      ///< for each point the coincident old boundary node, or -1
  std::vector<std::int32_t> in_triangle_;  ///< for each other point its triangle in the piece
  std::size_t next_point_ = 0, next_moved_ = 0;
};

}  // namespace

PointValues::PointValues(const Communicator& comm, const Mesh& mesh, const Field& field, Point centre,
                         const CurvePartition& shares)
    : comm_{comm},
      mesh_{mesh},
      field_{field},
      centre_{centre},
      shares_{shares},
      is_inner_{inner_nodes(comm, mesh)} {}

PointValues::Answers PointValues::at(std::span<const Point> places, Combine combine) const {
  const Exchange questions = to_partition(comm_, shares_, places);
  const std::vector<Point> points = questions.deliver(places);
  Found found(comm_, *this, points);
  const auto width = field_.width();
  std::vector<double> rows(points.size() * width);
  std::vector<char> is_inside;
  for (std::size_t i = 0; i < points.size(); ++i)
    is_inside.push_back(found.next(std::span(rows).subspan(i * width, width), combine) ? 1 : 0);
  return {questions.answer(rows, width), questions.answer(is_inside)};
}

}  // namespace quadloop::adapt
