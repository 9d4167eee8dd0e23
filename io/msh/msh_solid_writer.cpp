#include "io/msh/msh_file.hpp"
#include "io/msh/msh_output.hpp"
#include "io/msh/msh_text.hpp"
#include "io/solid/solid_blocks.hpp"

namespace quadloop {

namespace {

template <std::size_t width>
constexpr MshType type_of_cell = width == 4   ? msh_tetrahedron
                                 : width == 5 ? msh_pyramid
                                 : width == 6 ? msh_prism
                                              : msh_hexahedron;
template <std::size_t width>
constexpr MshType type_of_face = width == 3 ? msh_triangle : msh_quad;

/// The patches, then the blocks.
std::vector<MshOutputGroup> groups_of(const SolidStream& stream) {
  std::vector<MshOutputGroup> groups;
  for (const std::string& name : stream.patch_names()) groups.push_back({2, name});
  const SolidBlocks blocks(stream);
  for (const std::string& name : blocks.names()) groups.push_back({3, name});
  return groups;
}

class MshSolidWriter {
 public:
  MshSolidWriter(const SolidStream& stream, OutputSet& outputs, const std::string& path, MshVersion version)
      : stream_{stream}, blocks_{stream}, output_{outputs, path, version, groups_of(stream)} {}

  void write() {
    output_.write_nodes(stream_.point_rows(), [&](std::int64_t i) { return stream_.point(i); });
    output_.begin_elements(runs(),
                           stream_.counts().cells() + stream_.patch_triangles() + stream_.patch_quads());
    if (stream_.boundaries() != nullptr)
      output_.write_on_boundaries<4>(
          *stream_.boundaries(), msh_quad, stream_.layers(),
          [&](const BoundaryStream::Edge& edge, std::int64_t layer) { return stream_.side(edge, layer); });
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      write_faces<3>(n);
      write_faces<4>(n);
    }
    for (std::int32_t block = 0; block < blocks_.count(); ++block)
      for_each_kind_of_cell([&]<std::size_t width>() { write_cells<width>(block); });
    output_.end_elements();
  }

 private:
  /// Of elements of one type in one group.
  std::int64_t runs() const {
    std::int64_t count = 0;
    for (const StreamedPatch& patch : stream_.patches())
      count += (patch.triangles > 0 ? 1 : 0) + (patch.quads > 0 ? 1 : 0);
    for (std::int32_t block = 0; block < blocks_.count(); ++block)
      for_each_kind_of_cell([&]<std::size_t width>() {
        count += stream_.communicator().any(blocks_.rows<width>(block).size() > 0) ? 1 : 0;
      });
    return count;
  }

  template <std::size_t width>
  void write_faces(std::size_t patch) {
    output_.write_elements<width>(type_of_face<width>, static_cast<std::int64_t>(patch) + 1,
                                  stream_.face_rows<width>(patch),
                                  [&](std::int64_t i) { return stream_.face<width>(patch, i); });
  }

  template <std::size_t width>
  void write_cells(std::int32_t block) {
    const BlockRows rows = blocks_.rows<width>(block);
    output_.write_elements<width>(type_of_cell<width>, std::ssize(stream_.patches()) + 1 + block, rows.size(),
                                  [&](std::int64_t i) { return stream_.cell<width>(rows[i]); });
  }

  const SolidStream& stream_;
  const SolidBlocks blocks_;
  MshOutput output_;
};

}  // namespace

void write_msh_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path,
                     MshVersion version) {
  MshSolidWriter(mesh, outputs, path, version).write();
}

}  // namespace quadloop
