#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "io/files/binary_output.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

template <std::endian order>
class UgridReader {
 public:
  explicit UgridReader(const std::string& path) : path_{path}, bytes_{read_input(path)} {}

  FileMesh read() {
    const auto head = take<std::int32_t, 7>("its seven counts");
    check_counts(head);
    points_ = head[0];
    for (std::int32_t i = 0; i < head[0]; ++i) {
      const auto p = take<double, 3>("coordinates");
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        throw InputError(fmt::format("{}: node {} has a coordinate that is not finite", path_, i + 1));
      mesh_.points.push_back({p[0], p[1], p[2]});
    }
    read_faces(head[1], head[2]);
    read_cells(mesh_.tetrahedra, head[3]);
    read_cells(mesh_.pyramids, head[4]);
    for (auto& n : mesh_.pyramids) n = {n[0], n[3], n[4], n[1], n[2]};  // in UGRID the third node is the apex
    read_cells(mesh_.prisms, head[5]);
    read_cells(mesh_.hexahedra, head[6]);
    read_volumes();
    if (at_ < bytes_.size())
      mesh_.warnings.push_back(
          fmt::format("{}: {} bytes after the mesh are ignored", path_, bytes_.size() - at_));
    return std::move(mesh_);
  }

 private:
  template <class Number, std::size_t width>
  std::array<Number, width> take(const char* what) {
    std::array<Number, width> values;
    if (bytes_.size() - at_ < sizeof values)
      throw InputError(
          fmt::format("{}: the file ends where {} should follow; it is cut short, or its counts are "
                      "wrong",
                      path_, what));
    std::memcpy(values.data(), bytes_.data() + at_, sizeof values);
    at_ += sizeof values;
    return in_order<order>(values);
  }

  /// The counts must be consistent with the file size.
  void check_counts(const std::array<std::int32_t, 7>& head) const {
    constexpr std::array<std::uint64_t, 7> widths{24, 16, 20, 16, 20, 24, 32};
    std::uint64_t bytes = 0;
    for (std::size_t k = 0; k < head.size(); ++k) {
      if (head[k] < 0)
        throw InputError(fmt::format(
            "{}: one of its counts is negative: {}; is its byte order different (.b8.ugrid, .lb8.ugrid)?",
            path_, head[k]));
      bytes += widths[k] * head[k];
    }
    if (bytes > bytes_.size() - at_)
      throw InputError(
          fmt::format("{}: its counts require {} bytes, but {} follow; it is cut short, or its byte order is "
                      "different (.b8.ugrid, .lb8.ugrid)",
                      path_, bytes, bytes_.size() - at_));
  }

  /// A number of layer cells, then the identifier of each cell, if just as many numbers follow.
  void read_volumes() {
    const std::uint64_t cells = cell_count(mesh_);
    if (cells == 0 || bytes_.size() - at_ != (cells + 1) * sizeof(std::int32_t)) return;
    take<std::int32_t, 1>("the number of cells in layers");
    std::vector<std::int64_t> identifiers;
    for (std::uint64_t i = 0; i < cells; ++i)
      identifiers.push_back(take<std::int32_t, 1>("the identifier of a cell")[0]);
    set_blocks(mesh_, identifiers);
  }

  std::int32_t node(std::int32_t number) const {
    if (number < 1 || number > points_)
      throw InputError(
          fmt::format("{}: an element names node {}, which is none of 1 to {}", path_, number, points_));
    return number - 1;
  }

  template <std::size_t width>
  void read_cells(std::vector<std::array<std::int32_t, width>>& cells, std::int32_t count) {
    for (std::int32_t i = 0; i < count; ++i) {
      cells.push_back(take<std::int32_t, width>("the nodes of a cell"));
      for (std::int32_t& n : cells.back()) n = node(n);
    }
  }

  void read_faces(std::int32_t triangles, std::int32_t quads) {
    std::vector<FileBoundary::Face> faces;
    for (std::int32_t i = 0; i < triangles; ++i) {
      const auto n = take<std::int32_t, 3>("the nodes of a face");
      faces.push_back({node(n[0]), node(n[1]), node(n[2]), FileBoundary::no_node});
    }
    for (std::int32_t i = 0; i < quads; ++i) {
      const auto n = take<std::int32_t, 4>("the nodes of a face");
      faces.push_back({node(n[0]), node(n[1]), node(n[2]), node(n[3])});
    }
    const std::map<std::int32_t, MapbcPatch> names = read_mapbc(mapbc_path(path_));
    std::map<std::int32_t, FileBoundary> patches;
    for (const FileBoundary::Face& face : faces)
      patches[take<std::int32_t, 1>("the patch of a face")[0]].faces.push_back(face);
    for (auto& [number, patch] : patches) {
      const auto named = names.find(number);
      patch.name = named == names.end() ? fmt::format("patch_{}", number) : named->second.name;
      if (named != names.end()) patch.condition = condition_of_mapbc(named->second.condition);
      mesh_.boundaries.push_back(std::move(patch));
    }
  }

  std::string path_, bytes_;
  std::size_t at_ = 0;
  std::int32_t points_ = 0;
  FileMesh mesh_;
};

}  // namespace

template <std::endian order>
MeshOfFile read_ugrid(const std::string& path) {
  return UgridReader<order>(path).read();
}

template MeshOfFile read_ugrid<std::endian::little>(const std::string&);
template MeshOfFile read_ugrid<std::endian::big>(const std::string&);

}  // namespace quadloop::io
