#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/files/boundary_stream.hpp"
#include "io/files/row_stream.hpp"
#include "mesher/solid/extruded_mesh.hpp"

namespace quadloop {

/// A patch of an extruded mesh: a boundary of the plane, or an end.
struct ExtrudedPatch {
  std::string name, condition;
  std::int64_t triangles = 0, quads = 0;

  std::int64_t faces() const { return triangles + quads; }
};

/// An extruded mesh as it passes through rank 0 into a file, in bounded pieces: each rank makes its own rows.
/// All members but the accessors are *collective*.
class ExtrudedStream {
 public:
  ExtrudedStream(const Communicator& comm, const ExtrudedMesh& mesh);

  const Communicator& communicator() const { return comm_; }
  const ExtrudedMesh& mesh() const { return mesh_; }
  const ExtrudedCounts& counts() const { return counts_; }
  const BoundaryStream& boundaries() const { return boundaries_; }
  /// Boundaries with edges in their order, the back, the front.
  const std::vector<ExtrudedPatch>& patches() const { return patches_; }
  std::size_t sides() const { return patches_.size() - 2; }  ///< the index of the back
  std::vector<std::string> patch_names() const;
  std::int64_t patch_triangles() const { return 2 * counts_.triangles; }  ///< of all patches
  std::int64_t patch_quads() const;

  /// Runs `action` on rank 0; if it throws, all ranks do.
  template <class Action>
  void on_root(const Action& action) const {
    comm_.together([&] {
      if (comm_.is_root()) action();
    });
  }

  /// The ranks' rows, an array or a number each: `make(i)` is this rank's row i, `put(span of rows)` gets
  /// them on rank 0.
  template <class Make, class Put>
  void rows(std::int64_t count, const Make& make, const Put& put) const {
    using Row = decltype(make(std::int64_t{0}));
    const RowStream stream{comm_, count, bytes_per_piece / std::int64_t{sizeof(Row)}};
    stream.run<Row>(
        [&](std::int64_t begin, std::int64_t end) {
          std::vector<Row> made;
          made.reserve(end - begin);
          for (std::int64_t i = begin; i < end; ++i) made.push_back(make(i));
          return made;
        },
        put);
  }

  /// Faces of the sides: `begin(patch)`, then pieces of its faces, made by `make(nodes)`, go to `put`; all on
  /// rank 0.
  template <class Begin, class Make, class Put>
  void sides(const Begin& begin, const Make& make, const Put& put) const {
    using Row = decltype(make(std::array<SolidNode, 4>{}));
    constexpr std::size_t most = bytes_per_piece / sizeof(Row);
    std::vector<Row> made;
    boundaries_.run(begin, [&](std::span<const BoundaryStream::Edge> edges) {
      for (const auto& [from, to] : edges) {
        for (std::int64_t layer = 0; layer < mesh_.layers(); ++layer) {
          made.push_back(make(mesh_.side(GlobalNodeId{from}, GlobalNodeId{to}, layer)));
          if (made.size() < most) continue;
          put(std::span<const Row>(made));
          made.clear();
        }
      }
      put(std::span<const Row>(made));
      made.clear();
    });
  }

  /// Triangles, or quads, of an end: those of the back, or of the front.
  template <class Cells, class Make, class Put>
  void end(const Cells& cells, bool front, const Make& make, const Put& put) const {
    rows(
        std::ssize(cells),
        [&](std::int64_t i) { return make(front ? mesh_.front_face(cells[i]) : mesh_.back_face(cells[i])); },
        put);
  }

 private:
  static constexpr std::int64_t bytes_per_piece = std::int64_t{1} << 20;

  const Communicator& comm_;
  const ExtrudedMesh& mesh_;
  ExtrudedCounts counts_;
  BoundaryStream boundaries_;
  std::vector<ExtrudedPatch> patches_;
};

/// A row in another type of number, `more` added to each.
template <class Number, std::size_t width>
std::array<Number, width> as(const std::array<SolidNode, width>& nodes, SolidNode more = 0) {
  std::array<Number, width> result;
  for (std::size_t i = 0; i < width; ++i) result[i] = static_cast<Number>(nodes[i] + more);
  return result;
}

}  // namespace quadloop
