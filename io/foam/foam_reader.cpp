#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/foam/foam_file.hpp"
#include "io/foam/foam_patches.hpp"
#include "io/foam/foam_scanner.hpp"
#include "io/solid/block_collector.hpp"
#include "io/solid/cell_of_sides.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

class FoamReader {
 public:
  explicit FoamReader(std::string path) : path_{std::move(path)} {}

  SolidMesh read() {
    if (!std::filesystem::is_directory(path_)) throw InputError(path_ + ": is no folder of an OpenFOAM mesh");
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
      const std::int64_t width = scan.integer("the number of a face's points");
      if (width != 3 && width != 4)
        scan.refuse(fmt::format("a face of {} points; only triangles and quads can be read", width));
      SolidPatch::Face& face = faces_.emplace_back();
      face.fill(SolidPatch::no_node);
      scan.expect("(");
      for (std::int64_t k = 0; k < width; ++k) {
        const std::int64_t node = scan.integer("a point of a face");
        if (node < 0 || node >= std::ssize(mesh_.points))
          scan.refuse(fmt::format("point {} is none of the points 0 to {}", node, mesh_.points.size() - 1));
        face[k] = static_cast<std::int32_t>(node);
      }
      scan.expect(")");
    }
    scan.end_file();
  }

  /// Sides of each cell, one cell's after the other's, from owners and neighbours.
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
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      sides[ends[owner_[face]]++] = {faces_[face], true};
      if (face < neighbour_.size()) sides[ends[neighbour_[face]]++] = {faces_[face], false};
    }
    const std::vector<std::int32_t> block_of = blocks_of_cells(std::ssize(ends));
    std::int64_t begin = 0;
    for (std::size_t cell = 0; cell < ends.size(); ++cell) {
      const std::string fault = add_cell(mesh_, std::span(sides).subspan(begin, ends[cell] - begin));
      if (!fault.empty()) throw InputError(fmt::format("{}: cell {} {}", path_, cell, fault));
      begin = ends[cell];
      blocks_.take(mesh_, block_of[cell]);
    }
    blocks_.put_into(mesh_);
  }

  /// Zones of cells, where there are any; of a cell in several the first counts.
  std::vector<std::int32_t> blocks_of_cells(std::int64_t cells) {
    std::vector<std::int32_t> block_of(cells, -1);
    std::int64_t again = 0;
    const std::string path = file("cellZones");
    if (std::error_code ignored; std::filesystem::exists(path, ignored)) {
      for (const FoamZone& zone : read_foam_zones(path, cells)) {
        const std::int32_t block = blocks_.named(zone.name);
        for (const std::int32_t cell : zone.cells) {
          again += block_of[cell] >= 0 ? 1 : 0;
          if (block_of[cell] < 0) block_of[cell] = block;
        }
      }
    }
    if (again > 0)
      mesh_.warnings.push_back(
          fmt::format("{}: {} cells are in several zones; each is of the first alone", path_, again));
    for (std::int32_t& block : block_of) {
      if (block < 0) block = blocks_.named("domain");
    }
    return block_of;
  }

  void read_patches() {
    const std::string path = file("boundary");
    for (const FoamPatch& given : read_foam_boundary(path)) {
      const std::int64_t start = given.first_face;
      if (given.faces < 0 || start < std::ssize(neighbour_) || start + given.faces > std::ssize(faces_))
        throw InputError(fmt::format("{}: patch {} is of {} faces from {} on, of which there are {}", path,
                                     given.name, given.faces, start, faces_.size()));
      SolidPatch& patch = mesh_.patches.emplace_back();
      patch.name = given.name;
      patch.condition = condition_of(given.type);
      patch.is_empty = given.type == "empty";
      patch.faces.assign(faces_.begin() + start, faces_.begin() + start + given.faces);
    }
  }

  static std::string condition_of(std::string_view type) {
    if (type == "wall") return "wall";
    return type.starts_with("symmetry") || type == "empty" ? "symmetry" : "none";
  }

  std::string path_;
  std::vector<SolidPatch::Face> faces_;
  std::vector<std::int32_t> owner_, neighbour_;
  SolidMesh mesh_;
  BlockCollector blocks_;
};

}  // namespace

std::optional<SolidMesh> read_foam(const std::string& path) { return FoamReader(path).read(); }

}  // namespace quadloop
