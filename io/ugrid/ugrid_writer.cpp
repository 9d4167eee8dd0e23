#include <limits>
#include <memory>

#include "io/files/binary_output.hpp"
#include "io/solid/extruded_stream.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

template <std::endian order>
class UgridWriter {
 public:
  UgridWriter(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path)
      : stream_{outputs.communicator(), mesh} {
    refuse_too_large(path);
    const StagedFile staged = outputs.stage(path), names = outputs.stage(mapbc_path(path));
    stream_.on_root([&] {
      file_ = std::make_unique<OutputFile>(staged);
      write_names(names);
      write_head();
    });
  }

  void write() {
    const ExtrudedMesh& mesh = stream_.mesh();
    put_rows(mesh.point_rows(), [&](std::int64_t i) {
      const Point3 p = mesh.point(i);
      return std::array{p.x, p.y, p.z};
    });
    write_faces();
    write_face_patches();
    put_rows(mesh.prism_rows(), [&](std::int64_t i) { return as<std::int32_t>(mesh.prism(i), 1); });
    put_rows(mesh.hexahedron_rows(), [&](std::int64_t i) { return as<std::int32_t>(mesh.hexahedron(i), 1); });
    stream_.on_root([&] { file_->close(); });
  }

 private:
  void refuse_too_large(const std::string& path) const {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const ExtrudedCounts& counts = stream_.counts();
    if (counts.nodes <= most && counts.prisms <= most && counts.hexahedra <= most &&
        stream_.patch_quads() <= most && stream_.patch_triangles() <= most)
      return;
    throw OutputError(
        path + ": " + std::to_string(counts.nodes) + " nodes and " + std::to_string(counts.cells()) +
        " cells are more than this format can count (32-bit numbers); write a .vtu file instead");
  }

  void write_names(const StagedFile& staged) const {
    OutputFile file(staged);
    const std::vector<std::string> names = mapbc_names(stream_.patch_names());
    std::string text = std::to_string(names.size()) + "\n";
    for (std::size_t n = 0; n < names.size(); ++n) {
      const char axis = n < stream_.sides() ? ' ' : stream_.mesh().axis == ExtrusionAxis::y ? 'y' : 'z';
      text += std::to_string(n + 1) + " " +
              std::to_string(mapbc_condition(stream_.patches()[n].condition, axis)) + " " + names[n] + "\n";
    }
    file.write(text);
    file.close();
  }

  void write_head() {
    const ExtrudedCounts& counts = stream_.counts();
    const auto head = in_order<order>(as<std::int32_t>(
        std::array<SolidNode, 7>{counts.nodes, stream_.patch_triangles(), stream_.patch_quads(), 0, 0,
                                 counts.prisms, counts.hexahedra}));
    file_->write(bytes_of(std::span<const std::int32_t>(head)));
  }

  /// `make(i)` gives an array, in this machine's order of bytes.
  template <class Make>
  void put_rows(std::int64_t rows, const Make& make) {
    stream_.rows(
        rows, [&](std::int64_t i) { return in_order<order>(make(i)); },
        [&](auto some) { file_->write(bytes_of(some)); });
  }

  void write_faces() {
    const auto make = [](const auto& face) { return in_order<order>(as<std::int32_t>(face, 1)); };
    const auto put = [&](auto faces) { file_->write(bytes_of(faces)); };
    const Mesh& plane = stream_.mesh().plane;
    for (const bool front : {false, true}) stream_.end(plane.triangles, front, make, put);
    stream_.sides([](std::size_t) {}, make, put);
    for (const bool front : {false, true}) stream_.end(plane.quads, front, make, put);
  }

  /// The patch of each face, from 1, in the order of the faces: the ends' triangles, then all quads.
  void write_face_patches() {
    stream_.on_root([&] {
      const auto& patches = stream_.patches();
      const auto put = [&](std::int64_t count, std::size_t patch) {
        const std::vector<std::int32_t> numbers(std::min(count, most_numbers),
                                                in_order<order>(static_cast<std::int32_t>(patch + 1)));
        for (; count > 0; count -= most_numbers)
          file_->write(bytes_of(std::span<const std::int32_t>(numbers).first(std::min(count, most_numbers))));
      };
      for (std::size_t n = 0; n < patches.size(); ++n) put(patches[n].triangles, n);
      for (std::size_t n = 0; n < patches.size(); ++n) put(patches[n].quads, n);
    });
  }

  static constexpr std::int64_t most_numbers = std::int64_t{1} << 18;

  ExtrudedStream stream_;
  std::unique_ptr<OutputFile> file_;  ///< on rank 0 only
};

}  // namespace

void write_ugrid(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path) {
  if (path.ends_with(".lb8.ugrid")) {
    UgridWriter<std::endian::little>(outputs, mesh, path).write();
  } else {
    UgridWriter<std::endian::big>(outputs, mesh, path).write();
  }
}

}  // namespace quadloop
