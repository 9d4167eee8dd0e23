#include "io/fluent/fluent_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace quadloop::io {

namespace {

/// Section numbers.
enum FluentSection : std::int64_t {
  fluent_dimension_section = 2,
  fluent_nodes = 10,
  fluent_cells = 12,
  fluent_faces = 13,
  fluent_zone = 39,
  fluent_cell_tree = 58,
  fluent_face_tree = 59,
  fluent_zone_again = 45
};

/// Kinds of faces; other values are numbers of nodes.
constexpr std::int64_t mixed_faces = 0, polygonal_faces = 5;

}  // namespace

FluentSections::FluentSections(const std::string& path) : scan_{path} {
  while (!scan_.at_end()) read_section();
  if (points_.empty() || faces_.empty())
    scan().refuse_at(scan().text().size(),
                     "the file ends without nodes and faces; it is cut short, or no mesh");
  collect_faces();
}

void FluentSections::read_section() {
  scan_.expect("(");
  if (!scan_.is_number_next()) return scan_.skip_list();
  const std::int64_t section = scan_.decimal("the number of a section");
  switch (section) {
    case fluent_dimension_section: read_dimension(); break;
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

void FluentSections::read_dimension() {
  const std::int64_t found = scan_.decimal("the dimension");
  if (found != 2 && found != 3)
    scan_.refuse(fmt::format("a mesh of {} dimensions; those of 2 and 3 can be read", found));
  dimension_ = static_cast<std::int32_t>(found);
  scan_.expect(")");
}

FluentSections::Head FluentSections::read_head() {
  Head head;
  scan_.expect("(");
  head.zone = scan_.hexadecimal("the number of a zone");
  head.first = scan_.hexadecimal("a first number");
  head.last = scan_.hexadecimal("a last number");
  if (scan_.peek() != ")") head.type = scan_.hexadecimal("a type");
  if (scan_.peek() != ")") head.kind = scan_.hexadecimal("a kind");
  while (scan_.peek() != ")") scan_.token("\")\"");
  scan_.expect(")");
  if (head.zone != 0 &&
      (head.first < 1 || head.last < head.first - 1 || head.last > std::numeric_limits<std::int32_t>::max()))
    scan_.refuse(fmt::format("a section from {} to {}, which is no range", head.first, head.last));
  return head;
}

/// Throws unless the rest of the file can contain as many rows of at least this many bytes.
void FluentSections::require_room(const Head& head, std::size_t bytes_each, const char* of) const {
  if (static_cast<std::size_t>(head.count()) > scan_.bytes_left() / bytes_each)
    scan_.refuse(fmt::format("the file cannot hold its {} {}; it is cut short, or this count is wrong",
                             head.count(), of));
}

/// The head with zone 0 contains only the total number.
void FluentSections::read_nodes() {
  const Head head = read_head();
  if (head.zone == 0) return scan_.skip_list();
  require_room(head, 4, "nodes");
  if (head.kind != 0 && head.kind != dimension_)
    scan_.refuse(fmt::format("nodes of {} dimensions, but those of {} are expected", head.kind, dimension_));
  if (std::ssize(points_) < head.last) points_.resize(head.last);
  scan_.expect("(");
  for (std::int64_t i = head.first; i <= head.last; ++i) {
    Point3& p = points_[i - 1];
    p.x = scan_.real("an x coordinate");
    p.y = scan_.real("a y coordinate");
    if (dimension_ == 3) p.z = scan_.real("a z coordinate");
  }
  scan_.expect(")");
  scan_.expect(")");
}

void FluentSections::read_cells() {
  const Head head = read_head();
  if (head.zone != 0 && head.type != 0) cell_zones_.push_back(head);
  if (head.type == 32) scan_.refuse("a zone of parents of refined cells; only conforming meshes can be read");
  scan_.skip_list();
}

void FluentSections::read_faces() {
  constexpr std::int64_t parents = 31;
  const Head head = read_head();
  if (head.zone == 0) return scan_.skip_list();
  require_room(head, 8, "faces");
  require_kind(head.kind);
  if (head.type == parents)
    scan_.refuse("a zone of parents of refined faces; only conforming meshes can be read");
  const bool says_width = head.kind == mixed_faces || head.kind == polygonal_faces;
  scan_.expect("(");
  for (std::int64_t i = 0; i < head.count(); ++i) read_face(head, says_width ? read_width() : head.kind);
  scan_.expect(")");
  scan_.expect(")");
}

void FluentSections::require_kind(std::int64_t kind) const {
  if (kind == mixed_faces || kind == polygonal_faces) return;
  if (dimension_ == 2 && kind != 2)
    scan_.refuse(fmt::format("faces of {} nodes; those of a 2D mesh have 2", kind));
  if (dimension_ == 3 && kind != 3 && kind != 4)
    scan_.refuse(fmt::format("faces of {} nodes; those of a 3D mesh have 3 or 4 here", kind));
}

std::int64_t FluentSections::read_width() {
  const std::int64_t width = scan_.hexadecimal("the number of a face's nodes");
  if (dimension_ == 2 && width != 2)
    scan_.refuse("a face that has not two nodes; only meshes of two dimensions can be read here");
  if (dimension_ == 3 && width != 3 && width != 4)
    scan_.refuse(fmt::format("a face of {} nodes; only triangles and quads can be read", width));
  return width;
}

void FluentSections::read_face(const Head& head, std::int64_t width) {
  FluentFace face{{}, {}, head.zone, head.type, 0};
  face.nodes.fill(FluentFace::no_node);
  for (std::int64_t k = 0; k < width; ++k) {
    face.nodes[k] = number("a node of a face") - 1;
    if (face.nodes[k] < 0) scan_.refuse("a face names node 0; they are numbered from 1");
  }
  face.place = scan_.place();
  for (std::int32_t& cell : face.cells) cell = number("a cell of a face");
  if (face.cells[0] == face.cells[1]) scan_.refuse("a face has the same cell on both sides");
  faces_.push_back(face);
}

std::int32_t FluentSections::number(const char* expected) {
  const std::int64_t value = scan_.hexadecimal(expected);
  if (value < 0 || value > std::numeric_limits<std::int32_t>::max())
    scan_.refuse(fmt::format("{} is the number {}", expected, value));
  return static_cast<std::int32_t>(value);
}

/// "(zone type name ...)(...)"; the zone number is decimal.
void FluentSections::read_zone() {
  scan_.expect("(");
  const std::int64_t zone = scan_.decimal("the number of a zone");
  scan_.token("the type of a zone");
  zone_names_[zone] = scan_.token("the name of a zone");
  scan_.skip_list();
  scan_.skip_list();
}

std::string FluentSections::zone_name(std::int64_t zone) const {
  const auto found = zone_names_.find(zone);
  return found == zone_names_.end() ? fmt::format("zone_{}", zone) : found->second;
}

/// Lists the faces of each cell, cell by cell.
void FluentSections::collect_faces() {
  std::int32_t cells = 0;
  for (const FluentFace& face : faces_) cells = std::max({cells, face.cells[0], face.cells[1]});
  if (static_cast<std::size_t>(cells) > 2 * faces_.size())
    scan_.refuse(fmt::format("cell {} cannot be one of a mesh with {} faces", cells, faces_.size()));
  ends_.assign(cells + 1, 0);
  for (const FluentFace& face : faces_) {
    for (const std::int32_t node : face.nodes) {
      if (node == FluentFace::no_node) break;
      if (node >= std::ssize(points_))
        scan().refuse_at(face.place,
                         fmt::format("node {} is none of the nodes 1 to {}", node + 1, points_.size()));
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

std::vector<std::int64_t> FluentSections::zones_of_cells() const {
  std::vector<std::int64_t> zones(ends_.size(), 0);
  for (const Head& zone : cell_zones_) {
    for (std::int64_t cell = zone.first; cell <= zone.last && cell < std::ssize(zones); ++cell)
      zones[cell] = zone.zone;
  }
  return zones;
}

}  // namespace quadloop::io
