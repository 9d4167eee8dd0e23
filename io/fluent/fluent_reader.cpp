#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include "io/fluent/fluent_file.hpp"
#include "io/fluent/fluent_scanner.hpp"
#include "io/fluent/fluent_zones.hpp"
#include "io/loaded/foreign_mesh.hpp"

namespace quadloop {

namespace {

/// The head of a section of nodes, cells or faces: "(zone first last type kind)", its numbers hexadecimal.
struct SectionHead {
  std::int64_t zone = 0, first = 0, last = 0, type = 0, kind = 0;

  std::int64_t count() const { return last - first + 1; }
};

struct FluentFace {
  std::array<std::int32_t, 2> nodes;  ///< from 0
  std::array<std::int32_t, 2> cells;  ///< left and right, from 1; 0: none
  std::int64_t zone, type;
  std::size_t place;
};

/// Numbers of sections.
enum FluentSection : std::int64_t {
  fluent_dimension = 2,
  fluent_nodes = 10,
  fluent_cells = 12,
  fluent_faces = 13,
  fluent_zone = 39,
  fluent_cell_tree = 58,
  fluent_face_tree = 59,
  fluent_zone_again = 45
};

class FluentReader {
 public:
  explicit FluentReader(const std::string& path) : scan_{path} {}

  LoadedMesh read() {
    while (!scan_.at_end()) read_section();
    if (foreign_.loaded.mesh.points.empty() || faces_.empty())
      scan_.scan().refuse_at(scan_.scan().text().size(),
                             "the file ends without nodes and faces; it is cut short, or no mesh");
    collect_edges();
    add_cells();
    add_boundaries();
    drop_unused_nodes(foreign_, scan_.scan().path());
    return finish(std::move(foreign_), scan_.scan());
  }

 private:
  void read_section() {
    scan_.expect("(");
    const std::int64_t section = scan_.decimal("the number of a section");
    switch (section) {
      case fluent_dimension: read_dimension(); break;
      case fluent_nodes: read_nodes(); break;
      case fluent_cells: read_cells(); break;
      case fluent_faces: read_faces(); break;
      case fluent_zone:
      case fluent_zone_again: read_zone(); break;
      case fluent_cell_tree:
      case fluent_face_tree: scan_.refuse("a mesh with hanging nodes; only conforming ones can be read");
      default:
        if (section >= 2000 && section % 1000 >= fluent_nodes && section % 1000 <= fluent_faces)
          scan_.refuse("a binary file; save it as ASCII (in Fluent: no binary files)");
        scan_.skip_list();
    }
  }

  void read_dimension() {
    const std::int64_t dimension = scan_.decimal("the dimension");
    if (dimension != 2)
      scan_.refuse(
          fmt::format("a mesh of {} dimensions; of Fluent's only those of two can be read", dimension));
    scan_.expect(")");
  }

  SectionHead read_head() {
    SectionHead head;
    scan_.expect("(");
    head.zone = scan_.hexadecimal("the number of a zone");
    head.first = scan_.hexadecimal("a first number");
    head.last = scan_.hexadecimal("a last number");
    if (scan_.peek() != ")") head.type = scan_.hexadecimal("a type");
    if (scan_.peek() != ")") head.kind = scan_.hexadecimal("a kind");
    while (scan_.peek() != ")") scan_.token("\")\"");
    scan_.expect(")");
    if (head.zone != 0 && (head.first < 1 || head.last < head.first - 1 ||
                           head.last > std::numeric_limits<std::int32_t>::max()))
      scan_.refuse(fmt::format("a section from {} to {}, which is no range", head.first, head.last));
    return head;
  }

  /// That as many rows of so many bytes at least can follow.
  void require_room(const SectionHead& head, std::size_t bytes_each, const char* of) const {
    if (static_cast<std::size_t>(head.count()) > scan_.bytes_left() / bytes_each)
      scan_.refuse(fmt::format("the file cannot hold its {} {}; it is cut short, or this count is wrong",
                               head.count(), of));
  }

  /// Zone 0 tells how many there are.
  void read_nodes() {
    const SectionHead head = read_head();
    if (head.zone == 0) return scan_.skip_list();
    require_room(head, 4, "nodes");
    if (head.kind == 3) scan_.refuse("nodes of three dimensions; only meshes of two can be read");
    auto& points = foreign_.loaded.mesh.points;
    if (std::ssize(points) < head.last) points.resize(head.last);
    scan_.expect("(");
    for (std::int64_t i = head.first; i <= head.last; ++i) {
      const double x = scan_.real("an x coordinate"), y = scan_.real("a y coordinate");
      points[i - 1] = {x, y};
    }
    scan_.expect(")");
    scan_.expect(")");
  }

  void read_cells() {
    const SectionHead head = read_head();
    if (head.zone != 0 && head.type != 0) cell_zones_.push_back(head);
    if (head.type == 32)
      scan_.refuse("a zone of parents of refined cells; only conforming meshes can be read");
    scan_.skip_list();
  }

  void read_faces() {
    constexpr std::int64_t mixed = 0, linear = 2, polygonal = 5, parents = 31;
    const SectionHead head = read_head();
    if (head.zone == 0) return scan_.skip_list();
    require_room(head, 8, "faces");
    if (head.kind != mixed && head.kind != linear && head.kind != polygonal)
      scan_.refuse(fmt::format("faces of {} nodes; those of a 2D mesh have 2", head.kind));
    if (head.type == parents)
      scan_.refuse("a zone of parents of refined faces; only conforming meshes can be read");
    scan_.expect("(");
    for (std::int64_t i = 0; i < head.count(); ++i) read_face(head, head.kind != linear);
    scan_.expect(")");
    scan_.expect(")");
  }

  void read_face(const SectionHead& head, bool says_width) {
    if (says_width && scan_.hexadecimal("the number of a face's nodes") != 2)
      scan_.refuse("a face that has not two nodes; only meshes of two dimensions can be read");
    FluentFace face{{}, {}, head.zone, head.type, 0};
    for (std::int32_t& node : face.nodes) node = number("a node of a face") - 1;
    face.place = scan_.place();
    for (std::int32_t& cell : face.cells) cell = number("a cell of a face");
    if (face.cells[0] == face.cells[1]) scan_.refuse("a face has the same cell on both sides");
    faces_.push_back(face);
  }

  std::int32_t number(const char* expected) {
    const std::int64_t value = scan_.hexadecimal(expected);
    if (value < 0 || value > std::numeric_limits<std::int32_t>::max())
      scan_.refuse(fmt::format("{} is the number {}", expected, value));
    return static_cast<std::int32_t>(value);
  }

  /// "(zone type name ...)(...)", the zone decimal.
  void read_zone() {
    scan_.expect("(");
    const std::int64_t zone = scan_.decimal("the number of a zone");
    scan_.token("the type of a zone");
    zone_names_[zone] = scan_.token("the name of a zone");
    scan_.skip_list();
    scan_.skip_list();
  }

  std::string zone_name(std::int64_t zone) const {
    const auto found = zone_names_.find(zone);
    return found == zone_names_.end() ? fmt::format("zone_{}", zone) : found->second;
  }

  /// The faces of each cell, one cell's after the other's.
  void collect_edges() {
    const auto& points = foreign_.loaded.mesh.points;
    std::int32_t cells = 0;
    for (const FluentFace& face : faces_) cells = std::max({cells, face.cells[0], face.cells[1]});
    if (static_cast<std::size_t>(cells) > 2 * faces_.size())
      scan_.refuse(fmt::format("cell {} cannot be one of a mesh with {} faces", cells, faces_.size()));
    ends_.assign(cells + 1, 0);
    for (const FluentFace& face : faces_) {
      for (const std::int32_t node : face.nodes) {
        if (node < 0 || node >= std::ssize(points))
          scan_.scan().refuse_at(
              face.place, fmt::format("node {} is none of the nodes 1 to {}", node + 1, points.size()));
      }
      for (const std::int32_t cell : face.cells) ++ends_[cell];
    }
    std::int64_t total = 0;
    for (std::int64_t& end : ends_) total += std::exchange(end, total);
    faces_of_cells_.resize(total);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (const std::int32_t cell : faces_[f].cells)
        faces_of_cells_[ends_[cell]++] = static_cast<std::int32_t>(f);
    }
  }

  void add_cells() {
    std::vector<std::int64_t> zone_of(ends_.size(), 0);
    for (const SectionHead& zone : cell_zones_) {
      for (std::int64_t cell = zone.first; cell <= zone.last && cell < std::ssize(zone_of); ++cell)
        zone_of[cell] = zone.zone;
    }
    block_of_.assign(ends_.size(), -1);
    for (std::size_t cell = 1; cell < ends_.size(); ++cell) {
      const std::string name = zone_of[cell] == 0 ? "domain" : zone_name(zone_of[cell]);
      block_of_[cell] = foreign_.block_named(name);
      add_cell(static_cast<std::int32_t>(cell));
    }
  }

  /// From node to node over its faces; the first face has the cell to its left.
  void add_cell(std::int32_t cell) {
    const auto own = std::span(faces_of_cells_).subspan(ends_[cell - 1], ends_[cell] - ends_[cell - 1]);
    if (own.size() != 3 && own.size() != 4)
      scan_.scan().refuse_at(
          own.empty() ? 0 : faces_[own[0]].place,
          fmt::format("cell {} has {} faces; only triangles and quadrilaterals can be read", cell,
                      own.size()));
    std::array<std::int32_t, 4> nodes =
        faces_[own[0]].cells[0] == cell
            ? std::array{faces_[own[0]].nodes[0], faces_[own[0]].nodes[1], -1, -1}
            : std::array{faces_[own[0]].nodes[1], faces_[own[0]].nodes[0], -1, -1};
    std::array<bool, 4> used{true};
    for (std::size_t k = 1; k < own.size(); ++k) {
      const std::int32_t next = next_node(own, used, nodes[k]);
      const bool closes = k + 1 == own.size();
      if (next < 0 || (closes && next != nodes[0]))
        scan_.scan().refuse_at(faces_[own[0]].place,
                               fmt::format("the faces of cell {} do not go round it", cell));
      if (!closes) nodes[k + 1] = next;
    }
    const auto id = [&](std::size_t k) { return NodeId{nodes[k]}; };
    if (own.size() == 3) {
      foreign_.add_triangle({id(0), id(1), id(2)}, block_of_[cell]);
    } else {
      foreign_.add_quad({id(0), id(1), id(2), id(3)}, block_of_[cell]);
    }
  }

  /// The other end of a face, not used yet, at this node; -1 where there is none.
  std::int32_t next_node(std::span<const std::int32_t> own, std::array<bool, 4>& used,
                         std::int32_t node) const {
    for (std::size_t k = 1; k < own.size(); ++k) {
      const auto& [first, second] = faces_[own[k]].nodes;
      if (used[k] || (first != node && second != node)) continue;
      used[k] = true;
      return first == node ? second : first;
    }
    return -1;
  }

  static bool is_interior(const FluentFace& face) {
    return face.cells[0] != 0 && face.cells[1] != 0 && (face.type == fluent_interior || face.type == 0);
  }

  /// Zones of faces inside, of which some have the same block on both sides: no boundary, also where two
  /// blocks meet. One with edges between blocks alone is their boundary, unless it has the name that our
  /// writer gives the others.
  std::set<std::int64_t> inner_zones() const {
    std::set<std::int64_t> zones;
    for (const FluentFace& face : faces_) {
      if (is_interior(face) && block_of_[face.cells[0]] == block_of_[face.cells[1]]) zones.insert(face.zone);
    }
    for (const auto& [zone, name] : zone_names_) {
      if (name == fluent_inner_zone) zones.insert(zone);
    }
    return zones;
  }

  void add_boundaries() {
    const std::set<std::int64_t> inner = inner_zones();
    for (const FluentFace& face : faces_) {
      if (is_interior(face) && inner.contains(face.zone)) continue;
      const std::int32_t boundary = foreign_.boundary_named(zone_name(face.zone));
      foreign_.loaded.mesh.boundaries[boundary].condition = condition_of_fluent(face.type);
      foreign_.edges.push_back({{NodeId{face.nodes[0]}, NodeId{face.nodes[1]}}, boundary, face.place});
    }
  }

  FluentScanner scan_;
  ForeignMesh foreign_;
  std::vector<FluentFace> faces_;
  std::vector<SectionHead> cell_zones_;
  std::map<std::int64_t, std::string> zone_names_;
  std::vector<std::int64_t> ends_;            ///< of each cell's part of the next
  std::vector<std::int32_t> faces_of_cells_;  ///< those of cell 0, which is none, come first
  std::vector<std::int32_t> block_of_;        ///< of each cell, from 1
};

}  // namespace

bool is_fluent(const std::string& path) {
  std::ifstream file(path);
  char first = 0;
  return file >> first && first == '(';
}

LoadedMesh read_fluent(const std::string& path) { return FluentReader(path).read(); }

}  // namespace quadloop
