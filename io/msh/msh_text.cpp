#include "io/msh/msh_text.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "mesher/base/ids.hpp"

namespace quadloop::io {

namespace {

std::string element_name(std::int64_t type) {
  switch (type) {
    case 4: return "4 (tetrahedron)";
    case 5: return "5 (hexahedron)";
    case 6: return "6 (prism)";
    case 7: return "7 (pyramid)";
    case 8: return "8 (line of second order)";
    case 9: return "9 (triangle of second order)";
    case 10: return "10 (quadrilateral of second order, 9 nodes)";
    case 11: return "11 (tetrahedron of second order)";
    case 12: return "12 (hexahedron of second order, 27 nodes)";
    case 13: return "13 (prism of second order, 18 nodes)";
    case 14: return "14 (pyramid of second order, 14 nodes)";
    case 16: return "16 (quadrilateral of second order, 8 nodes)";
    case 17: return "17 (hexahedron of second order, 20 nodes)";
    case 18: return "18 (prism of second order, 15 nodes)";
    case 19: return "19 (pyramid of second order, 13 nodes)";
    case 20:
    case 21: return std::to_string(type) + " (triangle of third order)";
    case 22:
    case 23: return std::to_string(type) + " (triangle of fourth order)";
    case 26: return "26 (line of third order)";
    case 27: return "27 (line of fourth order)";
    case 29: return "29 (tetrahedron of third order)";
    case 36: return "36 (quadrilateral of third order)";
    case 37: return "37 (quadrilateral of fourth order)";
    case 92: return "92 (hexahedron of third order)";
    default: return std::to_string(type);
  }
}

/// Returns the number of nodes of an element; 0 for a type that is not read.
std::size_t width_of(std::int64_t type) {
  switch (type) {
    case msh_point: return 1;
    case msh_line: return 2;
    case msh_triangle: return 3;
    case msh_quad:
    case msh_tetrahedron: return 4;
    case msh_pyramid: return 5;
    case msh_prism: return 6;
    case msh_hexahedron: return 8;
    default: return 0;
  }
}

int dimension_of(std::int64_t type) {
  if (type == msh_point) return 0;
  if (type == msh_line) return 1;
  return type == msh_triangle || type == msh_quad ? 2 : 3;
}

}  // namespace

void MshText::read(const PutPoint& put_point, const PutElement& put_element) {
  put_point_ = &put_point;
  put_element_ = &put_element;
  is_old_ = read_format();
  read_names();
  if (is_old_) {
    read_old_nodes();
    read_old_elements();
  } else {
    read_entities();
    read_nodes();
    read_elements();
  }
  read_periodic();
}

/// In version 2.2 drop_repeated() reports elements in several groups.
std::vector<std::string> MshText::warnings(int lowest) const {
  std::vector<std::string> lines = groups_.dropped(lowest);
  if (!is_old_) std::ranges::move(groups_.overlaps(lowest), std::back_inserter(lines));
  for (std::string& line : lines) line.insert(0, scan_.path() + ": ");
  return lines;
}

bool MshText::go_to_section(const std::string& name) {
  const std::string_view text = scan_.text();
  const std::string head = "$" + name;
  std::size_t found = text.size();
  for (std::size_t at = text.find(head); at != std::string_view::npos; at = text.find(head, at + 1)) {
    if (!is_line(text, at, head.size())) continue;
    if (found != text.size()) scan_.refuse_at(at, "a second section " + head + "; only one can be read");
    found = at;
  }
  if (found == text.size()) return false;
  scan_.go_to(found);
  scan_.token("");
  return true;
}

bool MshText::is_line(std::string_view text, std::size_t at, std::size_t length) {
  const std::size_t before = at == 0 ? std::string_view::npos : text.find_last_not_of(" \t", at - 1);
  const bool begins = before == std::string_view::npos || text[before] == '\n';
  return begins && (at + length == text.size() ||
                    std::string_view(" \t\r\n").find(text[at + length]) != std::string_view::npos);
}

void MshText::go_to_needed(const std::string& name) {
  if (go_to_section(name)) return;
  scan_.refuse_at(scan_.text().size(),
                  "the file ends without a section $" + name + "; it is cut short, or no mesh");
}

void MshText::end_section(const std::string& name) {
  const std::string found(scan_.token("$End" + name).substr(0, 40));
  if (found != "$End" + name)
    scan_.refuse("expected $End" + name + ", found \"" + found + "\"; a row too many, or a count too small");
}

bool MshText::read_format() {
  if (!go_to_section("MeshFormat")) scan_.refuse("is no MSH file of Gmsh: it has no section $MeshFormat");
  const double version = scan_.real("the format's version");
  const std::string written(scan_.text().substr(scan_.place(), 8));
  if (version != 2.2 && version != 4.1) {
    scan_.refuse("MSH version " + written.substr(0, written.find_first_of(" \t\r\n")) +
                 "; only 2.2 and 4.1 can be read: save it again from Gmsh");
  }
  if (scan_.integer("the file's type") != 0)
    scan_.refuse("a binary file; save it as ASCII (in Gmsh: Mesh.Binary = 0)");
  scan_.integer("the size of a number");
  end_section("MeshFormat");
  if (go_to_section("PartitionedEntities")) scan_.refuse("a partitioned mesh; save it without partitions");
  return version == 2.2;
}

std::int64_t MshText::physical_tag() {
  const std::int64_t tag = scan_.integer("the tag of a physical group");
  if (tag != static_cast<std::int32_t>(tag))
    scan_.refuse("no physical group has the tag " + std::to_string(tag));
  return tag;
}

void MshText::read_names() {
  if (!go_to_section("PhysicalNames")) return;
  const std::size_t count = scan_.count("physical names", 3);
  for (std::size_t i = 0; i < count; ++i) {
    const auto dimension = static_cast<int>(scan_.integer("the dimension of a physical group"));
    const std::int64_t physical = physical_tag();
    std::string_view name = scan_.rest_of_line();
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    groups_.name_physical(dimension, physical, std::string(name));
  }
  end_section("PhysicalNames");
}

void MshText::read_entities() {
  if (!go_to_section("Entities")) return;
  const std::size_t points = scan_.count("points", 5), curves = scan_.count("curves", 9),
                    surfaces = scan_.count("surfaces", 9), volumes = scan_.count("volumes", 9);
  for (std::size_t i = 0; i < points; ++i) read_point_entity();
  for (std::size_t i = 0; i < curves; ++i) read_entity(1, "the tag of a curve");
  for (std::size_t i = 0; i < surfaces; ++i) read_entity(2, "the tag of a surface");
  for (std::size_t i = 0; i < volumes; ++i) read_entity(3, "the tag of a volume");
}

void MshText::read_point_entity() {
  const std::int64_t entity = scan_.integer("the tag of a point");
  for (int k = 0; k < 3; ++k) scan_.token("a coordinate of a point");
  const std::size_t groups = scan_.count("physical groups", 1);
  for (std::size_t k = 0; k < groups; ++k) groups_.put_in_physical(0, entity, physical_tag());
}

void MshText::read_entity(int dimension, const char* expected) {
  const std::int64_t entity = scan_.integer(expected);
  for (int k = 0; k < 6; ++k) scan_.token("a bound of its box");
  const std::size_t groups = scan_.count("physical groups", 1);
  for (std::size_t k = 0; k < groups; ++k) groups_.put_in_physical(dimension, entity, physical_tag());
  const std::size_t bounds = scan_.count("bounding entities", 1);
  for (std::size_t k = 0; k < bounds; ++k) scan_.integer("the tag of a bounding entity");
}

void MshText::read_point(std::int64_t tag) {
  const double x = scan_.real("an x coordinate"), y = scan_.real("a y coordinate"),
               z = scan_.real("a z coordinate");
  tags_.add(tag);
  ++points_;
  (*put_point_)(tag, {x, y, z});
}

void MshText::end_nodes(const std::string& section) {
  const std::int64_t twice = tags_.sort();
  if (twice != 0) scan_.refuse("two nodes have the tag " + std::to_string(twice));
  end_section(section);
}

std::int64_t MshText::node_tag() {
  const std::int64_t tag = scan_.integer("the tag of a node");
  if (tag < 1) scan_.refuse("the tag of a node is " + std::to_string(tag) + "; tags begin with 1");
  return tag;
}

/// With parameters each row also has the entity's dimension and tag, and the point's parameters on it.
void MshText::read_old_nodes() {
  const bool parametric = go_to_section("ParametricNodes");
  if (!parametric) go_to_needed("Nodes");
  const std::size_t count = scan_.count("nodes", 4);
  tags_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    read_point(node_tag());
    if (parametric) scan_.rest_of_line();
  }
  end_nodes(parametric ? "ParametricNodes" : "Nodes");
}

void MshText::read_nodes() {
  go_to_needed("Nodes");
  const std::size_t blocks = scan_.count("blocks of nodes", 4), count = scan_.count("nodes", 4);
  scan_.integer("the smallest tag");
  scan_.integer("the largest tag");
  tags_.reserve(count);
  std::vector<std::int64_t> tags;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::int64_t dimension = scan_.integer("the dimension of a block");
    scan_.integer("the entity of a block");
    const bool parametric = scan_.integer("whether a block has parameters") != 0;
    tags.resize(scan_.count("nodes of this block", 4));
    for (std::int64_t& tag : tags) tag = node_tag();
    for (const std::int64_t tag : tags) {
      read_point(tag);
      for (std::int64_t k = 0; parametric && k < std::min<std::int64_t>(dimension, 3); ++k)
        scan_.real("a parameter of a node");
    }
  }
  if (points_ != count)
    scan_.refuse("the blocks hold " + std::to_string(points_) + " nodes, not " + std::to_string(count));
  end_nodes("Nodes");
}

void MshText::refuse_unknown(std::int64_t type) const {
  if (width_of(type) > 0) return;
  scan_.refuse("an element of type " + element_name(type) +
               "; only points, lines, triangles, quadrilaterals and 3D elements of first order can be read: "
               "mesh it with Mesh.ElementOrder = 1");
}

void MshText::read_element(std::int64_t tag, std::int64_t type, std::int64_t physical, std::int64_t entity) {
  MshElement element{tag, type, physical, entity, {}, scan_.place()};
  for (std::size_t k = 0; k < width_of(type); ++k) {
    const std::int64_t wanted = scan_.integer("a node of this element");
    const NodeId node = tags_.node_of(wanted);
    if (!node.valid()) scan_.refuse("node " + std::to_string(wanted) + " is none of the nodes");
    element.nodes[k] = node.value();
  }
  (*put_element_)(element);
}

void MshText::read_old_elements() {
  go_to_needed("Elements");
  const std::size_t count = scan_.count("elements", 4);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t number = scan_.integer("the number of an element");
    const std::int64_t type = scan_.integer("the type of an element");
    refuse_unknown(type);
    const std::size_t tags = scan_.count("tags", 1);
    std::int64_t physical = 0, entity = 0;
    for (std::size_t k = 0; k < tags; ++k) {
      const std::int64_t tag = k == 0 ? physical_tag() : scan_.integer("a tag of this element");
      if (k == 0) physical = tag;
      if (k == 1) entity = tag;
    }
    note_member(dimension_of(type), entity, physical);
    read_element(number, type, physical, entity);
  }
  end_section("Elements");
}

/// Elements of an entity are consecutive.
void MshText::note_member(int dimension, std::int64_t entity, std::int64_t physical) {
  const std::array member{std::int64_t{dimension}, entity, physical};
  if (physical != 0 && member != last_member_) groups_.put_in_physical(dimension, entity, physical);
  last_member_ = member;
}

void MshText::read_elements() {
  go_to_needed("Elements");
  const std::size_t blocks = scan_.count("blocks of elements", 4), count = scan_.count("elements", 2);
  scan_.integer("the smallest tag");
  scan_.integer("the largest tag");
  std::size_t found = 0;
  for (std::size_t block = 0; block < blocks; ++block) found += read_element_block();
  if (found != count)
    scan_.refuse("the blocks hold " + std::to_string(found) + " elements, not " + std::to_string(count));
  end_section("Elements");
}

void MshText::read_periodic() {
  if (!go_to_section("Periodic")) return;
  const std::size_t links = scan_.count("periodic entities", 4);
  for (std::size_t link = 0; link < links; ++link) {
    for (const char* expected : {"a dimension", "the tag of an entity", "the tag of its partner"})
      scan_.integer(expected);
    pass_over_transformation();
    for (std::size_t left = scan_.count("pairs of nodes", 2); left > 0; --left) {
      for (int k = 0; k < 2; ++k) {
        const NodeId node = tags_.node_of(node_tag());
        if (node.valid()) periodic_nodes_.push_back(node.value());  // others were not saved
      }
    }
  }
  end_section("Periodic");
}

/// "Affine" and numbers on a line of its own or, in version 4.1, a count and that many numbers.
void MshText::pass_over_transformation() {
  if (!is_old_) {
    for (std::size_t left = scan_.count("numbers of a transformation", 1); left > 0; --left)
      scan_.real("a number of a transformation");
    return;
  }
  const std::string_view next = scan_.token("a number of pairs of nodes");
  if (next == "Affine")
    scan_.rest_of_line();
  else
    scan_.go_to(scan_.place());
}

std::size_t MshText::read_element_block() {
  const auto dimension = static_cast<int>(scan_.integer("the dimension of a block"));
  const std::int64_t entity = scan_.integer("the entity of a block");
  const std::int64_t type = scan_.integer("the type of the elements of a block");
  refuse_unknown(type);
  const std::int64_t physical = groups_.physical_of(dimension, entity);
  const std::size_t count = scan_.count("elements of this block", 2);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t tag = scan_.integer("the tag of an element");
    read_element(tag, type, physical, entity);
  }
  return count;
}

}  // namespace quadloop::io
