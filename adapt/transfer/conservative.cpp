#include "adapt/transfer/conservative.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "adapt/transfer/overlap/overlap_integrals.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::adapt {

namespace {

using Corners = std::array<Point, 3>;

/// A triangle of which the old mesh covers at most this fraction counts as outside; touching triangles give
/// such values by rounding.
constexpr double touching = 1e-10;

std::vector<Corners> corners_of(const TransferSide& side) {
  std::vector<Corners> corners;
  corners.reserve(side.triangles.size());
  for (const CellTriangle& triangle : side.triangles) {
    const auto& [a, b, c] = triangle.nodes;
    corners.push_back({side.mesh.point(a), side.mesh.point(b), side.mesh.point(c)});
  }
  return corners;
}

/// Limits the value to the bounds, if there are any.
double bounded(double value, const CoveredValue& by) {
  return by.smallest <= by.largest ? std::clamp(value, by.smallest, by.largest) : value;
}

void add(CoveredValue& sum, const CoveredValue& more) {
  sum.integral += more.integral;
  sum.smallest = std::min(sum.smallest, more.smallest);
  sum.largest = std::max(sum.largest, more.largest);
}

/// Corner values of a triangle by a linear function with this mean and gradient, limited to the old values.
std::array<double, 3> at_corners(const Corners& corners, double covered, const CoveredValue& value) {
  const double mean = bounded(value.integral / covered, value);
  const Point gradient = (1 / covered) * value.slope, origin = corners[0];
  const Point centroid = (1.0 / 3) * ((corners[1] - origin) + (corners[2] - origin));
  std::array<double, 3> changes{};
  double share = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    changes[k] = dot(gradient, corners[k] - origin - centroid);
    if (changes[k] > 0) share = std::min(share, (value.largest - mean) / changes[k]);
    if (changes[k] < 0) share = std::min(share, (value.smallest - mean) / changes[k]);
  }
  for (double& change : changes) change = bounded(mean + std::max(share, 0.0) * change, value);
  return changes;
}

/// Contribution of a cell's triangles to one of its corners: area, area times value, range of values.
struct CornerSum {
  double area = 0, moment = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(const CornerSum& more) {
    area += more.area;
    moment += more.moment;
    low = std::min(low, more.low);
    high = std::max(high, more.high);
  }
  double mean() const { return std::clamp(moment / area, low, high); }
};
using CornerSums = std::array<CornerSum, 4>;

/// Sums of one variable over the local cells, triangles, then quadrilaterals.
class CellSums {
 public:
  CellSums(const Communicator& comm, const TransferSide& side, const Mesh& areas_of,
           const OverlapIntegrals& integrals)
      : side_{side},
        areas_of_{areas_of},
        integrals_{integrals},
        owners_(comm, side.mesh),
        corners_{corners_of(side)} {}

  std::vector<CornerSums> of(std::size_t variable) const {
    std::vector<CornerSums> sums(side_.mesh.cell_count());
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const double covered = integrals_.areas[i];
      if (!(covered > touching * area_of(corners_[i]))) continue;
      const auto& [a, b, c] = side_.triangles[i].nodes;
      const double area = area_of({areas_of_.point(a), areas_of_.point(b), areas_of_.point(c)});
      if (!(area > 0)) continue;
      const auto values = at_corners(corners_[i], covered, integrals_.value(i, variable));
      const std::int64_t cell = owners_.local(side_.triangles[i].number / 2);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t corner = corner_of(cell, side_.triangles[i].nodes[k]);
        sums[cell][corner].add({area, area * values[k], values[k], values[k]});
      }
    }
    return sums;
  }

 private:
  std::size_t corner_of(std::int64_t cell, NodeId node) const {
    const Mesh& mesh = side_.mesh;
    const auto place_in = [&](const auto& nodes) { return std::ranges::find(nodes, node) - nodes.begin(); };
    const auto triangles = std::ssize(mesh.triangles);
    return cell < triangles ? place_in(mesh.triangles[cell]) : place_in(mesh.quads[cell - triangles]);
  }

  const TransferSide& side_;
  const Mesh& areas_of_;
  const OverlapIntegrals& integrals_;
  CellOwners owners_;
  std::vector<Corners> corners_;
};

/// Means of one variable at owned nodes, from the cells of all ranks in their global order. *Collective.*
void set_column(const Communicator& comm, const HaloMesh& halo, const std::vector<CornerSums>& own,
                std::size_t column, std::size_t width, std::vector<double>& values) {
  const std::vector<CornerSums> sums = halo.spread(comm, own);
  std::vector<CornerSum> at_nodes(halo.owned_nodes());
  std::size_t cell = 0;
  halo.for_each_cell([&](const auto& nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (halo.owns(nodes[k])) at_nodes[nodes[k].value()].add(sums[cell][k]);
    }
    ++cell;
  });
  for (std::int32_t node = 0; node < halo.owned_nodes(); ++node) {
    if (at_nodes[node].area > 0) values[node * width + column] = at_nodes[node].mean();
  }
}

}  // namespace

TransferredCells transfer_cells(const Communicator& comm, const CurvePartition& shares,
                                const TransferSide& old_side, const CellValues& cells,
                                const TransferSide& new_side) {
  const BrokenField old_field = broken_cells(comm, old_side.mesh, cells, old_side.triangles);
  const std::vector<Corners> corners = corners_of(new_side);
  const OverlapIntegrals integrals = integrate_overlaps(comm, shares, old_field, corners, old_side.baffles);
  const CellOwners owners(comm, new_side.mesh);
  const std::size_t count = new_side.mesh.cell_count(), width = cells.width();
  std::vector<double> areas(count, 0), covered(count, 0);
  std::vector<CoveredValue> sums(count * width);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::int64_t cell = owners.local(new_side.triangles[i].number / 2);
    areas[cell] += area_of(corners[i]);
    if (integrals.areas[i] == 0) continue;
    for (std::size_t k = 0; k < width; ++k) {
      CoveredValue& sum = sums[cell * width + k];
      if (covered[cell] == 0) {
        sum = integrals.value(i, k);
      } else {
        add(sum, integrals.value(i, k));
      }
    }
    covered[cell] += integrals.areas[i];
  }
  TransferredCells result{std::vector<double>(count * width, 0), {}};
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (!(covered[cell] > touching * areas[cell])) {
      result.outside.push_back(static_cast<std::int64_t>(cell));
      continue;
    }
    for (std::size_t k = 0; k < width; ++k) {
      const CoveredValue& sum = sums[cell * width + k];
      result.values[cell * width + k] = bounded(sum.integral / covered[cell], sum);
    }
  }
  return result;
}

void conserve_at_nodes(const Communicator& comm, const CurvePartition& shares, const TransferSide& old_side,
                       const Field& old_field, const TransferSide& new_side, const Mesh& areas_of,
                       std::vector<double>& values) {
  const OverlapIntegrals integrals =
      integrate_overlaps(comm, shares, broken_nodal(old_side.mesh, old_field, old_side.triangles),
                         corners_of(new_side), old_side.baffles);
  const HaloMesh halo(comm, new_side.mesh);
  const CellSums sums(comm, new_side, areas_of, integrals);
  const std::size_t width = old_field.width();
  for (std::size_t k = 0; k < width; ++k) set_column(comm, halo, sums.of(k), k, width, values);
}

}  // namespace quadloop::adapt
