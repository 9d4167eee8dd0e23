#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Hands `count` items of each rank to the root in the order of ranks: calls `item(i)` for each on its rank,
/// and `visit` with the result on the root. A rank sends pieces of bounded size. *Collective.*
template <class Item, class Visit>
void hand_to_root(const Communicator& comm, std::size_t count, const Item& item, const Visit& visit) {
  using T = std::decay_t<decltype(item(std::size_t{}))>;
  static_assert(std::is_trivially_copyable_v<T>);
  constexpr std::size_t piece = 512;  // small, as the root maps buffers for the pieces of all ranks
  const std::vector<std::int64_t> counts = comm.all_gather(static_cast<std::int64_t>(count));
  if (!comm.is_root()) {
    for (std::size_t begin = 0; begin < count; begin += piece) {
      std::vector<T> items;
      for (std::size_t i = begin; i < std::min(count, begin + piece); ++i) items.push_back(item(i));
      comm.send_bytes(std::as_bytes(std::span<const T>(items)), 0);
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) visit(item(i));
  for (int rank = 1; rank < comm.size(); ++rank) {
    for (std::size_t received = 0; received < static_cast<std::size_t>(counts[rank]);) {
      for (const T& one : detail::from_bytes<T>(comm.receive_bytes(rank))) {
        visit(one);
        ++received;
      }
    }
  }
}

/// A cell as the root gets it: corners in the plane, and a value at each if a field is shown.
struct ShownCell {
  std::array<Point, 4> corners = {};
  std::array<double, 4> values = {};
  std::int32_t width = 3;
};

/// Hands cells of a distributed mesh to the root in their global order.
class CellStream {
 public:
  /// The mesh must outlive the object.
  CellStream(const Communicator& comm, const Mesh& mesh) : comm_{comm}, mesh_{mesh} {}

  const Communicator& communicator() const { return comm_; }
  const Mesh& mesh() const { return mesh_; }

  /// Calls `visit(ShownCell)` on the root for the cells of all ranks: `cells` are numbers on this rank,
  /// ascending, triangles before quads; `values` those of this rank's nodes, or empty. *Collective.*
  template <class Visit>
  void for_each(std::span<const std::size_t> cells, const std::vector<double>& values,
                const Visit& visit) const {
    const auto quads = std::ranges::lower_bound(cells, mesh_.triangles.size());
    const std::size_t triangles = quads - cells.begin();
    for (const auto& part : {cells.first(triangles), cells.subspan(triangles)}) {
      hand_to_root(
          comm_, part.size(), [&](std::size_t i) { return shown(part[i], values); }, visit);
    }
  }

 private:
  ShownCell shown(std::size_t cell, const std::vector<double>& values) const;

  const Communicator& comm_;
  const Mesh& mesh_;
};

}  // namespace quadloop::io
