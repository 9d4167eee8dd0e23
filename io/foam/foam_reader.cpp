#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <unordered_map>
#include <utility>

#include "io/foam/foam_file.hpp"
#include "io/foam/foam_patches.hpp"
#include "io/foam/foam_polygons.hpp"
#include "io/foam/foam_scanner.hpp"
#include "io/model/clean_up.hpp"
#include "io/model/repeated_rows.hpp"
#include "io/stream/cell_of_sides.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

class FoamReader {
 public:
  explicit FoamReader(std::string path) : path_{std::move(path)} {}

  FileMesh read() {
    if (!std::filesystem::is_directory(path_)) throw InputError(path_ + ": is no folder of an OpenFOAM mesh");
    patches_ = read_foam_boundary(file("boundary"));
    read_points();
    read_faces();
    const std::int64_t most_cells = 2 * std::ssize(faces_);
    owner_ = read_foam_labels(file("owner"), most_cells);
    neighbour_ = read_foam_labels(file("neighbour"), most_cells);
    if (owner_.size() != faces_.size() || neighbour_.size() > faces_.size())
      throw InputError(fmt::format("{}: {} faces have {} owners and {} neighbours", path_, faces_.size(),
                                   owner_.size(), neighbour_.size()));
    make_cells();
    read_patches();
    drop_empty_groups(mesh_);
    return std::move(mesh_);
  }

 private:
  std::string file(const char* name) const { return (std::filesystem::path(path_) / name).string(); }

  void read_points() {
    FoamScanner scan(file("points"));
    for (std::size_t left = scan.begin_list("points", 7); left > 0; --left) {
      scan.expect("(");
      Point3& p = mesh_.points.emplace_back();
      for (double* coordinate : {&p.x, &p.y, &p.z}) *coordinate = scan.real("a coordinate");
      scan.expect(")");
    }
    scan.end_file();
  }

  void read_faces() {
    FoamScanner scan(file("faces"));
    for (std::size_t left = scan.begin_list("faces", 8); left > 0; --left) {
      read_face(scan);
    }
    scan.end_file();
  }

  bool is_plane() const {
    return std::ranges::any_of(patches_, [](const FoamPatch& patch) { return patch.type == "empty"; });
  }

  /// A polygon of a plane mesh has no entry in the face nodes; it is stored separately.
  void read_face(FoamScanner& scan) {
    const std::int64_t width = scan.integer("the number of a face's points");
    const bool is_polygon = width > 4 && is_plane();
    if (width != 3 && width != 4 && !is_polygon)
      scan.refuse(
          fmt::format("a face of {} points; only triangles and quads can be read, and polygons of plane "
                      "meshes",
                      width));
    if (width > std::ssize(mesh_.points))
      scan.refuse(fmt::format("a face of {} points, more than there are", width));
    scan.expect("(");
    std::vector<std::int32_t> nodes;
    for (std::int64_t k = 0; k < width; ++k) {
      const std::int64_t node = scan.integer("a point of a face");
      if (node < 0 || node >= std::ssize(mesh_.points))
        scan.refuse(fmt::format("point {} is none of the points 0 to {}", node, mesh_.points.size() - 1));
      nodes.push_back(static_cast<std::int32_t>(node));
    }
    scan.expect(")");
    FileBoundary::Face& face = faces_.emplace_back();
    face.fill(FileBoundary::no_node);
    if (is_polygon)
      polygons_[faces_.size() - 1].nodes = std::move(nodes);
    else
      std::ranges::copy(nodes, face.begin());
  }

  /// Lists the sides of each cell, cell by cell, from owners and neighbours.
  void make_cells() {
    std::vector<std::int64_t> ends;
    const auto count = [&](const std::vector<std::int32_t>& labels) {
      for (const std::int32_t cell : labels) {
        if (cell >= std::ssize(ends)) ends.resize(cell + 1, 0);
        ++ends[cell];
      }
    };
    count(owner_);
    count(neighbour_);
    std::int64_t total = 0;
    for (std::int64_t& end : ends) total += std::exchange(end, total);
    std::vector<CellSide> sides(total);
    std::vector<std::size_t> face_of(total);
    const auto put = [&](std::int32_t cell, std::size_t face, bool looks_out) {
      face_of[ends[cell]] = face;
      sides[ends[cell]++] = {faces_[face], looks_out};
    };
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      put(owner_[face], face, true);
      if (face < neighbour_.size()) put(neighbour_[face], face, false);
    }
    const std::vector<std::int32_t> block_of = blocks_of_cells(std::ssize(ends));
    std::int64_t begin = 0;
    for (std::size_t cell = 0; cell < ends.size(); ++cell) {
      const auto own = std::span(sides).subspan(begin, ends[cell] - begin);
      const auto own_faces = std::span<const std::size_t>(face_of).subspan(begin, own.size());
      const bool divide =
          std::ranges::any_of(own_faces, [&](std::size_t face) { return polygons_.contains(face); });
      const std::string fault = divide ? add_polygonal_cell(own, own_faces, block_of[cell])
                                       : add_cell_of_sides(mesh_, own, block_of[cell]);
      if (!fault.empty()) throw InputError(fmt::format("{}: cell {} {}", path_, cell, fault));
      begin = ends[cell];
    }
  }

  /// Adds a cell between two polygons as prisms and hexahedra. Returns an error message if it is no such
  /// cell.
  std::string add_polygonal_cell(std::span<const CellSide> sides, std::span<const std::size_t> faces,
                                 std::int32_t block) {
    std::vector<CellSide> quads;
    std::vector<std::size_t> ends;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      polygons_.contains(faces[k]) ? ends.push_back(k) : quads.push_back(sides[k]);
    }
    const auto nodes_of = [&](std::size_t end) { return polygons_[faces[ends[end]]].nodes; };
    if (ends.size() != 2 || nodes_of(0).size() != quads.size() || nodes_of(1).size() != quads.size())
      return "has polygons, but does not lie between two of the same number of points";
    if (quads.size() > most_polygon_corners)
      return fmt::format("lies between polygons of {} points; those of {} can be divided", quads.size(),
                         most_polygon_corners);
    std::vector<std::int32_t> base = nodes_of(0), top;
    if (sides[ends[0]].looks_out) std::ranges::reverse(base);
    for (const std::int32_t node : base) top.push_back(opposite_node(quads, base, node));
    if (!std::ranges::is_permutation(top, nodes_of(1))) return "has faces that do not fit together";
    std::vector<Point3> corners;
    for (const std::int32_t node : base) corners.push_back(mesh_.points[node]);
    const std::vector<PolygonPiece> pieces = divide_polygon(corners);
    if (pieces.empty())
      return fmt::format("lies between polygons of {} points that cannot be divided into triangles and quads",
                         base.size());
    for (const PolygonPiece& piece : pieces)
      add_piece(piece, base, top, {faces[ends[0]], faces[ends[1]]}, block);
    ++divided_;
    pieces_ += std::ssize(pieces);
    return {};
  }

  void add_piece(const PolygonPiece& piece, const std::vector<std::int32_t>& base,
                 const std::vector<std::int32_t>& top, const std::array<std::size_t, 2>& ends,
                 std::int32_t block) {
    std::array<FileBoundary::Face, 2> faces;
    for (std::size_t k = 0; k < 4; ++k) {
      faces[0][k] = piece[k] < 0 ? FileBoundary::no_node : base[piece[k]];
      faces[1][k] = piece[k] < 0 ? FileBoundary::no_node : top[piece[k]];
    }
    const auto& [b, t] = faces;
    if (piece[3] < 0)
      add_cell<CellKind::prism>(mesh_, std::array{b[0], b[1], b[2], t[0], t[1], t[2]}, block);
    else
      add_cell<CellKind::hexahedron>(mesh_, std::array{b[0], b[1], b[2], b[3], t[0], t[1], t[2], t[3]},
                                     block);
    for (std::size_t end = 0; end < 2; ++end) polygons_[ends[end]].pieces.push_back(faces[end]);
  }

  /// Reads cell zones, if there are any; for a cell in several the first counts.
  std::vector<std::int32_t> blocks_of_cells(std::int64_t cells) {
    std::vector<std::int32_t> block_of(cells, -1);
    std::int64_t again = 0;
    const std::string path = file("cellZones");
    if (std::error_code ignored; std::filesystem::exists(path, ignored)) {
      for (const FoamZone& zone : read_foam_zones(path, cells)) {
        const std::int32_t block = mesh_.block_named(zone.name);
        for (const std::int32_t cell : zone.cells) {
          again += block_of[cell] >= 0 ? 1 : 0;
          if (block_of[cell] < 0) block_of[cell] = block;
        }
      }
    }
    if (again > 0)
      mesh_.warnings.push_back(fmt::format("{}: {} in several zones, assigned to the first of them", path_,
                                           counted(again, "cell")));
    for (std::int32_t& block : block_of) {
      if (block < 0) block = mesh_.block_named("domain");
    }
    return block_of;
  }

  void read_patches() {
    std::vector<std::string> cyclic;
    for (const FoamPatch& given : patches_) {
      const std::int64_t start = given.first_face;
      if (given.faces < 0 || start < std::ssize(neighbour_) || given.faces > std::ssize(faces_) - start)
        throw InputError(fmt::format("{}: patch {} is of {} faces from {} on, of which there are {}",
                                     file("boundary"), given.name, given.faces, start, faces_.size()));
      FileBoundary& patch = mesh_.boundaries.emplace_back();
      patch.name = given.name;
      patch.condition =
          BoundaryCondition::named(given.physical_type).value_or(condition_of_foam_type(given.type));
      patch.is_empty = given.type == "empty";
      patch.is_periodic = given.type.starts_with("cyclic");
      if (patch.is_periodic) cyclic.push_back(given.name);
      for (std::int64_t face = start; face < start + given.faces; ++face) put_face(patch, face);
    }
    if (!cyclic.empty())
      mesh_.warnings.push_back(
          fmt::format("{}: patches of a cyclic type are plain boundaries here, not periodic: {}", path_,
                      some_names(cyclic)));
    if (divided_ > 0)
      mesh_.warnings.push_back(fmt::format("{}: divided {} into {} triangles and quads", path_,
                                           counted(divided_, "polygonal cell"), pieces_));
  }

  /// For a polygon, adds the pieces of its cell.
  void put_face(FileBoundary& patch, std::size_t face) const {
    const auto polygon = polygons_.find(face);
    if (polygon == polygons_.end())
      patch.faces.push_back(faces_[face]);
    else
      patch.faces.insert(patch.faces.end(), polygon->second.pieces.begin(), polygon->second.pieces.end());
  }

  /// A face with more than four points, with the pieces of its cell at it.
  struct Polygon {
    std::vector<std::int32_t> nodes;
    std::vector<FileBoundary::Face> pieces;
  };

  std::string path_;
  std::vector<FoamPatch> patches_;
  std::vector<FileBoundary::Face> faces_;
  std::unordered_map<std::size_t, Polygon> polygons_;  ///< by face number
  std::int64_t divided_ = 0, pieces_ = 0;
  std::vector<std::int32_t> owner_, neighbour_;
  FileMesh mesh_;
};

}  // namespace

MeshOfFile read_foam(const std::string& path) { return FoamReader(path).read(); }

}  // namespace quadloop::io
