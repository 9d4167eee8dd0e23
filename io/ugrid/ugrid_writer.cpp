#include <algorithm>
#include <limits>

#include "io/files/binary_output.hpp"
#include "io/files/row_output.hpp"
#include "io/stream/mesh_stream.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// In UGRID the third node of a pyramid is its apex.
template <std::size_t width>
std::array<NodeNumber, width> as_ugrid(const std::array<NodeNumber, width>& cell) {
  if constexpr (width == 5) return {cell[0], cell[3], cell[4], cell[1], cell[2]};
  return cell;
}

template <std::endian order>
class UgridWriter {
 public:
  UgridWriter(const MeshStream& stream, OutputSet& outputs, const std::string& path)
      : stream_{stream}, file_{outputs, stage(outputs, stream, path)} {
    const StagedFile names = outputs.stage(mapbc_path(path));
    stream_.on_root([&] { write_names(names); });
  }

  void write() {
    write_head();
    put_rows(stream_.point_rows(), [&](std::int64_t i) {
      const Point3 p = stream_.point(i);
      return std::array{p.x, p.y, p.z};
    });
    write_faces();
    write_face_patches();
    for_each_kind([&]<CellKind kind>() {
      put_rows(stream_.cell_rows<kind>(),
               [&](std::int64_t i) { return as<std::int32_t>(as_ugrid(stream_.cell<kind>(i)), 1); });
    });
    if (const StreamBlocks blocks(stream_); blocks.several()) write_volumes(blocks);
    file_.close();
  }

 private:
  /// Stages the file, unless the mesh is too large for it.
  static StagedFile stage(OutputSet& outputs, const MeshStream& stream, const std::string& path) {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const StreamCounts& counts = stream.counts();
    if (counts.nodes <= most && std::ranges::max(counts.of_kind) <= most && stream.patch_quads() <= most &&
        stream.patch_triangles() <= most)
      return outputs.stage(path);
    throw OutputError(
        path + ": " + std::to_string(counts.nodes) + " nodes and " + std::to_string(counts.cells()) +
        " cells are more than this format can count (32-bit numbers); write a .vtu file instead");
  }

  void write_names(const StagedFile& staged) const {
    OutputFile file(staged);
    std::vector<MapbcPatch> patches;
    for (const StreamedPatch& patch : stream_.patches())
      patches.push_back({patch.name, mapbc_condition(patch.condition, patch.axis)});
    file.write(mapbc_text(patches));
    file.close();
  }

  void write_head() {
    const StreamCounts& counts = stream_.counts();
    const auto head = in_order<order>(as<std::int32_t>(std::array<NodeNumber, 7>{
        counts.nodes, stream_.patch_triangles(), stream_.patch_quads(), counts.of(CellKind::tetrahedron),
        counts.of(CellKind::pyramid), counts.of(CellKind::prism), counts.of(CellKind::hexahedron)}));
    file_.write(bytes_of(std::span<const std::int32_t>(head)));
  }

  /// `make(i)` returns an array in native byte order.
  template <class Make>
  void put_rows(std::int64_t rows, const Make& make) {
    file_.write_rows(rows, [&](std::int64_t i) { return in_order<order>(make(i)); });
  }

  void write_faces() {
    const auto make = [](const auto& face) { return in_order<order>(as<std::int32_t>(face, 1)); };
    for_each_end([&](std::size_t n) { put_faces<3>(n); });
    if (stream_.boundaries() != nullptr)
      file_.write_edges(*stream_.boundaries(), stream_.layers(),
                        [&](const BoundaryStream::Edge& edge, std::int64_t layer) {
                          return make(stream_.side(edge, layer));
                        });
    for_each_end([&](std::size_t n) { put_faces<4>(n); });
  }

  /// Visits the patches that are not sides.
  template <class Visit>
  void for_each_end(const Visit& visit) const {
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) visit(n);
  }

  template <std::size_t width>
  void put_faces(std::size_t patch) {
    put_rows(stream_.face_rows<width>(patch),
             [&](std::int64_t i) { return as<std::int32_t>(stream_.face<width>(patch, i), 1); });
  }

  /// Writes the patch of each face, from 1, in the order of the faces: all triangles, then all quads.
  void write_face_patches() {
    const auto& patches = stream_.patches();
    const auto put = [&](std::int64_t count, std::size_t patch) {
      const std::array number{in_order<order>(static_cast<std::int32_t>(patch + 1))};
      file_.write_shared_rows(count, [&](std::int64_t) { return number; });
    };
    for (std::size_t n = 0; n < patches.size(); ++n) put(patches[n].triangles, n);
    for (std::size_t n = 0; n < patches.size(); ++n) put(patches[n].quads, n);
  }

  /// Writes a number of cells in layers, 0, then the block of each cell, from 1.
  void write_volumes(const StreamBlocks& blocks) {
    const std::array<std::int32_t, 1> none{0};
    file_.write(bytes_of(std::span(none)));
    for_each_kind([&]<CellKind kind>() {
      put_rows(stream_.cell_rows<kind>(), [&](std::int64_t i) { return std::array{blocks.of<kind>(i) + 1}; });
    });
  }

  const MeshStream& stream_;
  RowOutput file_;
};

}  // namespace

template <std::endian order>
void write_ugrid(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  UgridWriter<order>(mesh, outputs, path).write();
}

template void write_ugrid<std::endian::little>(OutputSet&, const MeshStream&, const std::string&);
template void write_ugrid<std::endian::big>(OutputSet&, const MeshStream&, const std::string&);

}  // namespace quadloop::io
