#include "adapt/transfer/conservative.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "adapt/transfer/overlap/overlap_integrals.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::adapt {

namespace {

using Corners = std::array<Point, 3>;

/// A triangle of which the old mesh covers at most this fraction counts as outside; touching triangles give
/// such values by rounding.
constexpr double touching = 1e-10;

/// Old triangles that are not those of equal cells, with a field that is linear on each. *Collective.*
std::vector<CellTriangle> changed_triangles(const Communicator& comm, const MeshPair& meshes) {
  return cell_triangles(comm, meshes.old_mesh, meshes.old_centre, meshes.equal.old_changed);
}

/// Integrates over the triangles of new cells, some thousands at a time: the integrals over all of them would
/// take several times as much memory as both meshes.
class TriangleBatches {
 public:
  struct Triangle {
    std::array<NodeId, 3> nodes;
    std::int32_t cell;
    std::int32_t integral;  ///< index of its integrals, -1 if it belongs to an equal cell
  };
  struct Batch {
    std::vector<Triangle> triangles;
    std::vector<Corners> corners;  ///< of those that are integrated
    OverlapIntegrals integrals;
  };

  TriangleBatches(const Communicator& comm, OldTriangles& old, std::span<const Point> places)
      : comm_{comm}, old_{old}, places_{places} {}

  void add(const TrianglesOfCell& parts, std::int32_t cell, bool is_equal) {
    for (std::size_t part = 0; part < parts.count; ++part) {
      const auto& [a, b, c] = parts.nodes[part];
      batch_.triangles.push_back({parts.nodes[part], cell, is_equal ? -1 : size32(batch_.corners)});
      if (!is_equal) batch_.corners.push_back({places_[a.value()], places_[b.value()], places_[c.value()]});
    }
  }

  /// Calls `use(batch)` if there are enough triangles. *Collective*: other ranks may be in finish().
  template <class Use>
  void use_if_full(const Use& use) {
    if (batch_.corners.size() >= at_once) use_rest(use, true);
  }

  /// The rest, and those of other ranks. *Collective.*
  template <class Use>
  void finish(const Use& use) {
    while (use_rest(use, false)) {
    }
  }

 private:
  static constexpr std::size_t at_once = 16384;

  /// Returns whether any rank has more.
  template <class Use>
  bool use_rest(const Use& use, bool has_more) {
    batch_.integrals = old_.integrate(batch_.corners);
    use(batch_);
    batch_.triangles.clear();
    batch_.corners.clear();
    return comm_.any(has_more);
  }

  const Communicator& comm_;
  OldTriangles& old_;
  std::span<const Point> places_;
  Batch batch_;
};

/// Limits the value to the bounds, if there are any.
double bounded(double value, const CoveredValue& by) {
  return by.smallest <= by.largest ? std::clamp(value, by.smallest, by.largest) : value;
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

/// Area-weighted means of the values at corners of triangles, for some of the owned nodes.
class NodeMeans {
 public:
  NodeMeans(const NodeFlags& wanted, std::int32_t owned_nodes, std::size_t width) : width_{width} {
    std::int32_t count = 0;
    for (const NodeId node : ids_below(NodeId{owned_nodes}))
      places_.push_back(wanted[node] != 0 ? count++ : -1);
    areas_.resize(count, 0);
    sums_.resize(count * width);
  }

  bool wants(NodeId node) const { return node.value() < std::ssize(places_) && places_[node.value()] >= 0; }

  /// Adds a corner of a triangle.
  void add(NodeId node, double area, std::span<const double> values) {
    const std::size_t place = places_[node.value()];
    areas_[place] += area;
    for (std::size_t k = 0; k < width_; ++k) {
      Sum& sum = sums_[place * width_ + k];
      sum.moment += area * values[k];
      sum.low = std::min(sum.low, values[k]);
      sum.high = std::max(sum.high, values[k]);
    }
  }

  /// Replaces the rows of the nodes that have triangles.
  void write(std::vector<double>& rows) const {
    for (std::size_t node = 0; node < places_.size(); ++node) {
      const std::int32_t place = places_[node];
      if (place < 0 || !(areas_[place] > 0)) continue;
      for (std::size_t k = 0; k < width_; ++k) {
        const Sum& sum = sums_[place * width_ + k];
        rows[node * width_ + k] = std::clamp(sum.moment / areas_[place], sum.low, sum.high);
      }
    }
  }

 private:
  struct Sum {
    double moment = 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
  };
  std::size_t width_;
  std::vector<std::int32_t> places_;  ///< of each owned node, or -1
  std::vector<double> areas_;
  std::vector<Sum> sums_;  ///< rows of `width_`
};

/// Rows at the corners of a new triangle. Returns false if the old mesh does not cover it.
bool fill_corners(const Corners& corners, const OverlapIntegrals& integrals, std::size_t triangle,
                  std::vector<double>& rows) {
  const double covered = integrals.areas[triangle];
  if (!(covered > touching * area_of(corners))) return false;
  rows.resize(3 * integrals.width);
  for (std::size_t k = 0; k < integrals.width; ++k) {
    const auto values = at_corners(corners, covered, integrals.value(triangle, k));
    for (std::size_t corner = 0; corner < 3; ++corner) rows[corner * integrals.width + k] = values[corner];
  }
  return true;
}

/// The new mesh with the cells of other ranks around its nodes, of which changed cells are known.
class NewCells {
 public:
  /// *Collective.*
  NewCells(const Communicator& comm, const MeshPair& meshes)
      : halo_(comm, meshes.new_mesh), places_{halo_.points()}, centre_{meshes.new_centre} {
    std::copy_n(meshes.places.begin(), halo_.owned_nodes(), places_.begin());
    halo_.exchange().update(places_);
    std::vector<char> own;
    for (const std::int32_t old : meshes.equal.old_cell) own.push_back(old == EqualCells::none ? 1 : 0);
    changed_ = halo_.spread(comm, own);
  }

  /// Flags the nodes of changed cells.
  NodeFlags nodes_of_changed() const {
    NodeFlags flags(places_.size(), 0);
    std::size_t cell = 0;
    halo_.for_each_cell([&](const auto& nodes) {
      if (changed_[cell++] != 0) flag_all(nodes, flags);
    });
    return flags;
  }

  /// Adds the corners of all cells around the wanted nodes, in the global order of cells. Corners of equal
  /// cells have the values in `rows`. *Collective.*
  void add_corners(const Communicator& comm, OldTriangles& old, const std::vector<double>& rows,
                   NodeMeans& means) const {
    TriangleBatches batches(comm, old, places_);
    std::vector<double> at_corners;
    const auto add_batch = [&](const TriangleBatches::Batch& batch) {
      for (const TriangleBatches::Triangle& triangle : batch.triangles)
        add_triangle(batch, triangle, rows, at_corners, means);
    };
    std::int32_t next_cell = 0;
    halo_.for_each_cell([&](const auto& nodes) {
      const std::int32_t cell = next_cell++;
      if (std::ranges::none_of(nodes, [&](NodeId node) { return means.wants(node); })) return;
      batches.add(parts_of(places_, centre_, nodes), cell, changed_[cell] == 0);
      batches.use_if_full(add_batch);
    });
    batches.finish(add_batch);
  }

  std::int32_t owned_nodes() const { return halo_.owned_nodes(); }

 private:
  /// Weighted with the area of the triangle where its nodes are.
  void add_triangle(const TriangleBatches::Batch& batch, const TriangleBatches::Triangle& triangle,
                    const std::vector<double>& rows, std::vector<double>& at_corners,
                    NodeMeans& means) const {
    const double area = area_of(corners_of(halo_, triangle.nodes));
    if (!(area > 0)) return;
    const bool is_equal = triangle.integral < 0;
    if (!is_equal &&
        !fill_corners(batch.corners[triangle.integral], batch.integrals, triangle.integral, at_corners))
      return;
    const std::size_t width = batch.integrals.width;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const NodeId node = triangle.nodes[corner];
      if (!means.wants(node)) continue;
      const auto values = is_equal ? rows.begin() + node.value() * width
                                   : at_corners.cbegin() + static_cast<std::ptrdiff_t>(corner * width);
      means.add(node, area, std::span(values, width));
    }
  }

  HaloMesh halo_;
  std::vector<Point> places_;
  Point centre_;
  std::vector<char> changed_;
};

/// The mean over a new cell from the integrals over its triangles.
class CellMean {
 public:
  void add(const TriangleBatches::Batch& batch, std::size_t integral) {
    const OverlapIntegrals& integrals = batch.integrals;
    area_ += area_of(batch.corners[integral]);
    if (integrals.areas[integral] == 0) return;
    if (covered_ == 0) sums_.assign(integrals.width, {0, {}, infinity, -infinity});
    for (std::size_t k = 0; k < integrals.width; ++k) {
      const CoveredValue& more = integrals.value(integral, k);
      sums_[k].integral += more.integral;
      sums_[k].smallest = std::min(sums_[k].smallest, more.smallest);
      sums_[k].largest = std::max(sums_[k].largest, more.largest);
    }
    covered_ += integrals.areas[integral];
  }

  bool is_covered() const { return covered_ > touching * area_; }
  double value(std::size_t variable) const {
    return bounded(sums_[variable].integral / covered_, sums_[variable]);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  double area_ = 0, covered_ = 0;
  std::vector<CoveredValue> sums_;
};

/// Writes the means over the cells of a batch.
void write_means(const TriangleBatches::Batch& batch, TransferredCells& result) {
  const std::size_t width = batch.integrals.width;
  for (std::size_t i = 0; i < batch.triangles.size();) {
    const std::int32_t cell = batch.triangles[i].cell;
    CellMean mean;
    for (; i < batch.triangles.size() && batch.triangles[i].cell == cell; ++i)
      mean.add(batch, batch.triangles[i].integral);
    if (!mean.is_covered()) {
      result.outside.push_back(cell);
      continue;
    }
    for (std::size_t k = 0; k < width; ++k) result.values[cell * width + k] = mean.value(k);
  }
}

/// Means of the cells that the old mesh has as well. *Collective.*
void copy_equal_cells(const Communicator& comm, const MeshPair& meshes, const CellValues& cells,
                      std::vector<double>& values) {
  const std::size_t width = cells.width();
  const std::vector<double> others =
      rows_of_cells(comm, CellOwners(comm, meshes.old_mesh),
                    std::span<const std::int64_t>(meshes.equal.numbers), cells.values, width);
  auto next = others.begin();
  auto to = values.begin();
  for (const std::int32_t old : meshes.equal.old_cell) {
    if (old >= 0) std::copy_n(cells.values.begin() + old * width, width, to);
    if (old == EqualCells::elsewhere) {
      std::copy_n(next, width, to);
      next += width;
    }
    to += width;
  }
}

}  // namespace

TransferredCells transfer_cells(const Communicator& comm, const MeshPair& meshes, const CellValues& cells) {
  const std::size_t width = cells.width();
  TransferredCells result{std::vector<double>(meshes.new_mesh.cell_count() * width, 0), {}};
  copy_equal_cells(comm, meshes, cells, result.values);
  OldTriangles old(comm, meshes.shares,
                   broken_cells(comm, meshes.old_mesh, cells, changed_triangles(comm, meshes)),
                   meshes.baffles);
  TriangleBatches batches(comm, old, meshes.places);
  const auto use = [&](const TriangleBatches::Batch& batch) { write_means(batch, result); };
  std::int32_t next_cell = 0;
  meshes.new_mesh.for_each_cell([&](const auto& nodes) {
    const std::int32_t cell = next_cell++;
    if (!meshes.equal.is_changed(cell)) return;
    const TrianglesOfCell parts = parts_of(meshes.places, meshes.new_centre, nodes);
    if (parts.count == 0) result.outside.push_back(cell);
    batches.add(parts, cell, false);
    batches.use_if_full(use);
  });
  batches.finish(use);
  std::ranges::sort(result.outside);
  return result;
}

void conserve_at_nodes(const Communicator& comm, const MeshPair& meshes, const Field& old_field,
                       std::vector<double>& values) {
  const NewCells cells(comm, meshes);
  NodeMeans means(cells.nodes_of_changed(), cells.owned_nodes(), old_field.width());
  OldTriangles old(comm, meshes.shares,
                   broken_nodal(meshes.old_mesh, old_field, changed_triangles(comm, meshes)), meshes.baffles);
  cells.add_corners(comm, old, values, means);
  means.write(values);
}

}  // namespace quadloop::adapt
