#include "adapt/transfer/equal_cells.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

#include "adapt/transfer/locate/unchanged_nodes.hpp"
#include "mesher/base/mixed_bits.hpp"
#include "mesher/base/parallel/partners.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"

namespace quadloop::adapt {

namespace {

enum class MeshSide : std::uint64_t { of_old, of_new };

/// The side and 128 bits of a hash: equal for different cells with a probability of 1e-20 among 1e9 cells.
using CellHash = PairKey<3>;

/// The local cells of one kind in one of the meshes.
template <std::size_t width>
struct CellsOfKind {
  std::span<const Point> points;
  const std::vector<std::array<NodeId, width>>& cells;

  std::int32_t count() const { return size32(cells); }

  /// The corners of a cell, from the leftmost one on, the lower of two.
  std::array<Point, width> corners(std::size_t cell) const {
    std::array<Point, width> corners;
    for (std::size_t k = 0; k < width; ++k) corners[k] = points[cells[cell][k].value()];
    std::ranges::rotate(
        corners, std::ranges::min_element(corners, {}, [](const Point& p) { return std::tuple(p.x, p.y); }));
    return corners;
  }

  /// The sum of each cell's corners: the same for equal cells, and hardly ever for others.
  std::vector<Point> sums() const {
    std::vector<Point> sums;
    sums.reserve(cells.size());
    for (std::int32_t cell = 0; cell < count(); ++cell) {
      Point sum;
      for (const Point p : corners(cell)) sum = sum + p;
      sums.push_back(sum);
    }
    return sums;
  }

  /// 0 and -0 are equal, so their hashes are.
  CellHash hash(std::size_t cell, MeshSide side) const {
    std::array<std::uint64_t, 2> bits{0, golden_step};
    for (const Point p : corners(cell)) {
      for (std::uint64_t& word : bits) {
        word = mixed_bits(word + std::bit_cast<std::uint64_t>(p.x + 0.0)) + golden_step;
        word = mixed_bits(word + std::bit_cast<std::uint64_t>(p.y + 0.0)) + golden_step;
      }
    }
    const auto own = static_cast<std::uint64_t>(side);
    return {{own, bits[0], bits[1]}, {1 - own, bits[0], bits[1]}};
  }
};

/// Equal cells of one kind.
template <std::size_t width>
class EqualOfKind {
 public:
  EqualOfKind(const CellsOfKind<width>& old_cells, const CellsOfKind<width>& new_cells)
      : old_{old_cells},
        new_{new_cells},
        old_changed_(old_cells.count(), 1),
        old_cell_(new_cells.count(), EqualCells::none) {}

  void find_here() {
    old_cell_ = find_in_order(old_.sums(), new_.sums());
    for (std::int32_t cell = 0; cell < new_.count(); ++cell) {
      std::int32_t& old = old_cell_[cell];
      if (old >= 0 && old_.corners(old) != new_.corners(cell)) old = EqualCells::none;
      if (old >= 0) old_changed_[old] = 0;
    }
  }

  /// Compares the cells of all ranks that have not been found. `number_of(cell)` is the global number of an
  /// old cell. Appends those of the old cells that are found. *Collective.*
  template <class NumberOf>
  void find_elsewhere(const Communicator& comm, const NumberOf& number_of,
                      std::vector<std::int64_t>& numbers) {
    const std::vector<std::int32_t> old_left = left(old_changed_, 1),
                                    new_left = left(old_cell_, EqualCells::none);
    std::vector<CellHash> hashes;
    hashes.reserve(old_left.size() + new_left.size());
    for (const std::int32_t cell : old_left) hashes.push_back(old_.hash(cell, MeshSide::of_old));
    for (const std::int32_t cell : new_left) hashes.push_back(new_.hash(cell, MeshSide::of_new));
    const std::vector<Partner> partners = find_partners(comm, std::span<const CellHash>(hashes));
    for (std::size_t i = 0; i < old_left.size(); ++i) old_changed_[old_left[i]] = partners[i].found() ? 0 : 1;
    std::vector<int> ranks;
    std::vector<std::int64_t> items;
    for (std::size_t i = 0; i < new_left.size(); ++i) {
      const Partner& old = partners[old_left.size() + i];
      if (!old.found()) continue;
      old_cell_[new_left[i]] = EqualCells::elsewhere;
      ranks.push_back(old.rank);
      items.push_back(old.item);
    }
    const Exchange questions(comm, ranks);
    items = questions.deliver(items);
    for (std::int64_t& item : items) item = number_of(old_left[item]);
    items = questions.answer(items);
    numbers.insert(numbers.end(), items.begin(), items.end());
  }

  const std::vector<char>& old_changed() const { return old_changed_; }
  const std::vector<std::int32_t>& old_cell() const { return old_cell_; }

 private:
  /// The places at which a list has a value.
  template <class Values, class Value>
  static std::vector<std::int32_t> left(const Values& values, Value value) {
    std::vector<std::int32_t> places;
    for (std::int32_t i = 0; i < size32(values); ++i) {
      if (values[i] == value) places.push_back(i);
    }
    return places;
  }

  CellsOfKind<width> old_, new_;
  std::vector<char> old_changed_;
  std::vector<std::int32_t> old_cell_;
};

}  // namespace

EqualCells find_equal_cells(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh,
                            std::span<const Point> places, bool quads) {
  EqualCells equal;
  const CellOwners owners(comm, old_mesh);
  const auto append = [&](auto of_kind, bool compared) {
    const auto first = size32(equal.old_changed);
    if (compared) {
      of_kind.find_here();
      of_kind.find_elsewhere(
          comm, [&](std::int32_t cell) { return owners.number(first + cell); }, equal.numbers);
    }
    for (const std::int32_t cell : of_kind.old_cell())
      equal.old_cell.push_back(cell >= 0 ? first + cell : cell);
    equal.old_changed.insert(equal.old_changed.end(), of_kind.old_changed().begin(),
                             of_kind.old_changed().end());
  };
  append(EqualOfKind<3>({old_mesh.points, old_mesh.triangles}, {places, new_mesh.triangles}), true);
  append(EqualOfKind<4>({old_mesh.points, old_mesh.quads}, {places, new_mesh.quads}), quads);
  return equal;
}

}  // namespace quadloop::adapt
