#include "io/cgns/cgns_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "io/cgns/cgns_connections.hpp"
#include "io/cgns/cgns_elements.hpp"
#include "io/cgns/cgns_faces.hpp"
#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_places.hpp"
#include "io/cgns/cgns_values.hpp"
#include "io/model/clean_up.hpp"
#include "io/model/layers_text.hpp"
#include "io/model/node_text.hpp"
#include "io/model/pair_text.hpp"
#include "io/model/strip_text.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

using File = CgnsFile;
using Name = std::array<char, 33>;

std::string range_text(cgsize_t first, cgsize_t last) {
  return std::to_string(first) + " to " + std::to_string(last);
}

/// The boundary conditions of families by name; "none" for a family without one.
class CgnsFamilies {
 public:
  BoundaryCondition condition_of(const File& file, const std::string& family) {
    if (!conditions_) read(file);
    const auto found = conditions_->find(family);
    return found == conditions_->end() ? BoundaryCondition::none : found->second;
  }

 private:
  void read(const File& file) {
    conditions_.emplace();
    int families = 0;
    file.check(cg_nfamilies(file.id(), 1, &families));
    for (int f = 1; f <= families; ++f) {
      Name name{}, condition{};
      int conditions = 0, geometries = 0;
      BCType_t type = BCTypeNull;
      file.check(cg_family_read(file.id(), 1, f, name.data(), &conditions, &geometries));
      if (conditions == 0) continue;
      file.check(cg_fambc_read(file.id(), 1, f, 1, condition.data(), &type));
      conditions_->emplace(name.data(), condition_of_cgns_family(type, condition.data()));
    }
  }

  std::optional<std::unordered_map<std::string, BoundaryCondition>> conditions_;
};

/// Cell rows of each kind.
using ValuesByKind = std::array<std::vector<double>, cell_kinds>;

/// Reads one zone into the mesh; its nodes are numbered after the existing ones.
class ZoneReader {
 public:
  /// `number`: from 0, in the order of reading. Reads everything, or only notes the arrays, by ranges.
  ZoneReader(const File& file, const std::string& base_path, int zone, std::size_t number, bool alone,
             CgnsContents& contents, CgnsFamilies& families, ValuesByKind& cell_values)
      : file_{file},
        base_path_{base_path},
        zone_{zone},
        number_{number},
        alone_{alone},
        contents_{contents},
        mesh_{contents.mesh},
        families_{families},
        cell_values_{cell_values} {}

  const std::string& name() const { return name_; }

  void read(std::vector<ZoneConnection>& connections) {
    read_head();
    int sections = 0;
    file_.check(cg_nsections(file_.id(), 1, zone_, &sections));
    for (int s = 1; s <= sections && by_ranges(); ++s) contents_.by_ranges = section(s).type != MIXED;
    read_coordinates();
    for (int s = 1; s <= sections; ++s) read_section(s);
    faces_.sort();
    CgnsConnections({file_, 1, zone_, nodes_, cells_}, name_, number_, first_node_, faces_)
        .read(connections, mesh_);
    read_boundaries();
    if (number_ == 0) read_strips();
    by_ranges() ? note_solution() : read_solution();
  }

 private:
  bool by_ranges() const { return contents_.by_ranges; }
  std::string path() const { return base_path_ + "/" + name_; }

  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError(file_.shown() + ": zone " + name_ + ": " + message);
  }

  void read_head() {
    Name name{};
    std::array<cgsize_t, 9> size{};
    ZoneType_t type = ZoneTypeNull;
    file_.check(cg_zone_read(file_.id(), 1, zone_, name.data(), size.data()));
    file_.check(cg_zone_type(file_.id(), 1, zone_, &type));
    name_ = name.data();
    file_.check(cg_goto(file_.id(), 1, "Zone_t", zone_, "end"));
    const std::string full_name = file_.descriptor_here(full_name_descriptor).value_or(name_);
    block_ = mesh_.block_named(mesh_.dimension == 3 && alone_ ? "domain" : full_name);
    if (type != Unstructured) refuse("only unstructured zones can be read");
    nodes_ = size[0];
    cells_ = size[1];
    if (nodes_ < 1) refuse("it is said to have " + std::to_string(nodes_) + " nodes");
    first_node_ = mesh_.points.size();
    if (first_node_ + nodes_ > std::numeric_limits<std::int32_t>::max())
      refuse("too many nodes for one rank");
    contents_.nodes = nodes_;
  }

  std::vector<double> coordinate(const char* name) const {
    std::vector<double> values(nodes_);
    const cgsize_t first = 1;
    file_.check(cg_coord_read(file_.id(), 1, zone_, name, RealDouble, &first, &nodes_, values.data()));
    return values;
  }

  void read_coordinates() {
    int coordinates = 0;
    file_.check(cg_ncoords(file_.id(), 1, zone_, &coordinates));
    const bool has_z = mesh_.dimension == 3 || coordinates > 2;
    if (by_ranges()) return note_coordinates(has_z);
    const std::vector<double> x = coordinate("CoordinateX"), y = coordinate("CoordinateY");
    const std::vector<double> z = has_z ? coordinate("CoordinateZ") : std::vector<double>(x.size());
    if (mesh_.dimension == 2 && std::ranges::any_of(z, [](double height) { return height != 0; }))
      refuse("its nodes do not lie in the plane z = 0");
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!std::isfinite(x[i]) || !std::isfinite(y[i]) || !std::isfinite(z[i]))
        refuse("node " + std::to_string(i + 1) + " has a coordinate that is not finite");
      mesh_.points.push_back({x[i], y[i], z[i]});
    }
  }

  void note_coordinates(bool has_z) {
    const std::string grid = path() + "/GridCoordinates/Coordinate";
    for (const char* axis : {"X", "Y", "Z"}) {
      if (*axis != 'Z' || has_z) contents_.coordinates.emplace_back(grid + axis, nodes_);
    }
  }

  std::int32_t node_of(cgsize_t number) const {
    return node_of_zone(file_, name_, number, nodes_, first_node_);
  }

  void add_element(int type, const CgnsShape& shape, std::int64_t element, const cgsize_t* numbers) {
    if (shape.dimension == mesh_.dimension - 1) {
      CgnsFaces::Face face;
      face.fill(FileBoundary::no_node);
      std::transform(numbers, numbers + shape.width, face.begin(), [&](cgsize_t n) { return node_of(n); });
      faces_.add(element, face);
    }
    if (shape.dimension != mesh_.dimension) return;
    for_each_kind([&]<CellKind kind>() {
      if (type != cgns_type_of<kind>) return;
      std::array<std::int32_t, cell_width<kind>> nodes;
      std::transform(numbers, numbers + nodes.size(), nodes.begin(), [&](cgsize_t n) { return node_of(n); });
      add_cell<kind>(mesh_, nodes, block_);
      elements_[static_cast<std::size_t>(kind)].push_back(element);
    });
  }

  bool is_read(const CgnsShape& shape) const { return shape.width > 0 && shape.dimension <= mesh_.dimension; }

  struct Section {
    Name name{};
    ElementType_t type = ElementTypeNull;
    cgsize_t first = 0, last = 0;
  };
  Section section(int number) const {
    Section s;
    int boundary = 0, parents = 0;
    file_.check(cg_section_read(file_.id(), 1, zone_, number, s.name.data(), &s.type, &s.first, &s.last,
                                &boundary, &parents));
    return s;
  }

  void read_section(int number) {
    const auto [name, type, first, last] = section(number);
    cgsize_t size = 0;
    if (type == NODE) return;
    if (type != MIXED && !is_read(shape_of_cgns(type))) {
      refuse("section " + std::string(name.data()) + " holds " + cg_ElementTypeName(type) + "; only " +
             (mesh_.dimension == 3 ? "TETRA_4, PYRA_5, PENTA_6, HEXA_8, " : "") +
             "TRI_3, QUAD_4, BAR_2 and MIXED can be read");
    }
    file_.check(cg_ElementDataSize(file_.id(), 1, zone_, number, &size));
    const std::int64_t elements = std::int64_t{last} - first + 1;
    if (first < 1 || elements < 1 || size < 0)
      refuse("section " + std::string(name.data()) + " is said to hold the elements " +
             range_text(first, last));
    file_.check(cg_goto(file_.id(), 1, "Zone_t", zone_, "Elements_t", number, "end"));
    faces_.begin_section(file_.descriptor_here(full_name_descriptor).value_or(name.data()));
    if (by_ranges() && type != BAR_2) return note_section(name.data(), type, first, elements, size);
    std::vector<cgsize_t> data(size);
    const std::int64_t found =
        type == MIXED ? read_mixed(number, data, first) : read_rows(number, type, data, first);
    if (found == elements) return;
    refuse("section " + std::string(name.data()) + " holds " + std::to_string(found) +
           " elements, where its range " + range_text(first, last) + " is of " + std::to_string(elements));
  }

  /// A section whose nodes are not as many as its range says is not read by ranges.
  void note_section(const std::string& name, int type, std::int64_t first, std::int64_t elements,
                    std::int64_t size) {
    const std::int64_t width = static_cast<std::int64_t>(shape_of_cgns(type).width);
    CgnsSection& section = contents_.sections.emplace_back();
    section.kind = type == TRI_3 ? CellKind::triangle : CellKind::quad;
    section.cells = elements;
    section.first_row = first;  // until those of all sections are known
    section.nodes.path = path() + "/" + name + "/ElementConnectivity";
    if (size == elements * width) section.nodes.count = size;
  }

  /// Returns the number of elements of the section.
  std::int64_t read_rows(int section, int type, std::vector<cgsize_t>& data, std::int64_t element) {
    file_.check(cg_elements_read(file_.id(), 1, zone_, section, data.data(), nullptr));
    const CgnsShape shape = shape_of_cgns(type);
    for (std::size_t i = 0; i + shape.width <= data.size(); i += shape.width)
      add_element(type, shape, element++, data.data() + i);
    return data.size() / shape.width;
  }

  /// Each element is stored as its type followed by its nodes, from which the offsets follow. The file's own
  /// offsets are not read, as the library does not report how many it will write.
  std::int64_t read_mixed(int section, std::vector<cgsize_t>& data, std::int64_t element) {
    file_.check(cg_poly_elements_read(file_.id(), 1, zone_, section, data.data(), nullptr, nullptr));
    const std::int64_t first = element;
    for (std::size_t i = 0; i < data.size();) {
      const int type = static_cast<int>(data[i]);
      const CgnsShape shape = shape_of_cgns(type);
      if (!is_read(shape) || i + shape.width >= data.size())
        refuse("a MIXED section holds an element that is no cell, face or bar that can be read");
      add_element(type, shape, element++, data.data() + i + 1);
      i += shape.width + 1;
    }
    return element - first;
  }

  FileBoundary& boundary_named(const std::string& name, BoundaryCondition condition) {
    const std::size_t before = mesh_.boundaries.size();
    FileBoundary& boundary = mesh_.boundaries[mesh_.boundary_named(name)];
    if (mesh_.boundaries.size() > before) boundary.condition = condition;
    return boundary;
  }

  void read_boundaries() {
    int count = 0;
    file_.check(cg_nbocos(file_.id(), 1, zone_, &count));
    for (int boundary = 1; boundary <= count; ++boundary) read_boundary(boundary);
    faces_.for_each_left([&](const std::string& section, const auto& face) {
      boundary_named(section, BoundaryCondition::none).faces.push_back(face);
    });
  }

  void go_to_condition(int number) const {
    file_.check(cg_goto(file_.id(), 1, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", number, "end"));
  }

  /// The faces of a condition are given by a list, or by the two ends of a range. A condition on nodes is
  /// skipped: its faces, if in the file, are a section.
  void read_boundary(int number) {
    Name name{};
    BCType_t type = BCTypeNull;
    PointSetType_t set = PointSetTypeNull;
    cgsize_t count = 0, normals = 0;
    std::array<int, 3> normal{};
    DataType_t normal_type = DataTypeNull;
    int datasets = 0;
    GridLocation_t location = Vertex;
    file_.check(cg_boco_info(file_.id(), 1, zone_, number, name.data(), &type, &set, &count, normal.data(),
                             &normals, &normal_type, &datasets));
    file_.check(cg_boco_gridlocation_read(file_.id(), 1, zone_, number, &location));
    if (set != ElementRange && set != ElementList && location == Vertex) return;
    const bool is_range = set == PointRange || set == ElementRange;
    if (count < 0 || (is_range && count != 2))
      refuse("boundary " + std::string(name.data()) + " has " + std::to_string(count) + " numbers where " +
             (is_range ? "a range has 2" : "a list is"));
    std::vector<cgsize_t> elements(count);
    file_.check(cg_boco_read(file_.id(), 1, zone_, number, elements.data(), nullptr));
    go_to_condition(number);
    const std::string full = file_.descriptor_here(full_name_descriptor).value_or(name.data());
    const auto layers = file_.descriptor_here(layers_descriptor);
    FileBoundary& boundary = boundary_named(full, condition_of(type));
    if (layers) boundary.layers = layers_of_text(*layers);
    if (is_range) return take_range(elements[0], elements[1], boundary);
    for (const cgsize_t element : elements) take_face(element, boundary);
  }

  void take_range(cgsize_t first, cgsize_t last, FileBoundary& boundary) {
    if (last < first)
      refuse("boundary " + boundary.name + " is of the elements " + range_text(first, last) +
             ", which is no range");
    for (std::int64_t element = first; element <= last; ++element)
      take_face(element, boundary);  // ends at the first element that is not a face
  }

  void take_face(std::int64_t element, FileBoundary& boundary) {
    const auto face = faces_.take(element);
    if (!face) {
      refuse("boundary " + boundary.name + " names element " + std::to_string(element) + ", which is no " +
             (mesh_.dimension == 2 ? "BAR_2" : "face") + " or belongs to another boundary");
    }
    boundary.faces.push_back(*face);
  }

  /// Returns the condition at the current node. For type FamilySpecified it is that of the family.
  BoundaryCondition condition_of(BCType_t type) {
    std::array<char, 660> family{};
    if (type != FamilySpecified || cg_famname_read(family.data()) != CG_OK) return condition_of_cgns(type);
    return families_.condition_of(file_, family.data());
  }

  void read_strips() {
    file_.check(cg_goto(file_.id(), 1, "Zone_t", zone_, "end"));
    const std::string text = file_.descriptor_here(strips_descriptor).value_or("");
    mesh_.strips = strips_in_comments(text, static_cast<std::int32_t>(nodes_)).strips;
    mesh_.pairs = pairs_in_comments(text);
    mesh_.named_nodes = nodes_in_comments(text, static_cast<std::int32_t>(nodes_));
  }

  /// Values in cells are in the order of the elements. Returns how many cells there are; unknown if two have
  /// the same number.
  std::int64_t find_first_rows() const {
    std::vector<CgnsSection*> sections;
    for (CgnsSection& section : contents_.sections) sections.push_back(&section);
    std::ranges::sort(sections, {}, &CgnsSection::first_row);
    std::int64_t cells = 0, next_element = 1;
    bool distinct = true;
    for (CgnsSection* const section : sections) {
      distinct = distinct && section->first_row >= next_element;
      next_element = section->first_row + section->cells;
      section->first_row = cells;
      cells += section->cells;
    }
    return distinct ? cells : CgnsArray::unknown;
  }

  void note_solution() {
    Field names = note_cgns_values({file_, 1, zone_, nodes_, cells_}, path(), find_first_rows(), contents_);
    if (!names.empty()) mesh_.solution = std::move(names);
  }

  void read_solution() {
    const Field own = read_cgns_values({file_, 1, zone_, nodes_, cells_}, elements_);
    if (own.empty()) return;
    if (first_node_ == 0) {
      mesh_.solution.emplace();
      mesh_.solution->names = own.names;
      mesh_.solution->cells.names = own.cells.names;
    }
    if (!mesh_.solution || own.width() != mesh_.solution->width() ||
        own.cells.width() != mesh_.solution->cells.width())
      refuse("its solution has other variables than the first zone's");
    std::vector<double>& values = mesh_.solution->values;
    values.insert(values.end(), own.values.begin(), own.values.end());
    auto row = own.cells.values.begin();
    for (std::size_t kind = 0; kind < cell_kinds; ++kind) {
      const auto end = row + std::ssize(own.cells.names) * std::ssize(elements_[kind]);
      cell_values_[kind].insert(cell_values_[kind].end(), row, end);
      row = end;
    }
  }

  const File& file_;
  std::string base_path_;
  int zone_;
  std::size_t number_;
  bool alone_;  ///< whether the file has no other zone
  CgnsContents& contents_;
  FileMesh& mesh_;
  CgnsFamilies& families_;
  ValuesByKind& cell_values_;
  std::string name_;
  std::int32_t block_ = 0;
  cgsize_t nodes_ = 0, cells_ = 0;
  /// For each kind: element numbers in the zone.
  std::array<std::vector<std::int64_t>, cell_kinds> elements_;
  std::size_t first_node_ = 0;
  CgnsFaces faces_;
};

/// Returns the zones in the order of their ordinals, if each has one; libcgns sorts them by name.
std::vector<int> zones_in_order(const File& file, int zones) {
  std::vector<std::pair<int, int>> order;
  for (int zone = 1; zone <= zones; ++zone) {
    int ordinal = 0;
    file.check(cg_goto(file.id(), 1, "Zone_t", zone, "end"));
    const bool has_ordinal = zones > 1 && cg_ordinal_read(&ordinal) == CG_OK;
    order.emplace_back(has_ordinal ? ordinal : zone, zone);
  }
  std::ranges::stable_sort(order);
  std::vector<int> sorted;
  for (const auto& [ordinal, zone] : order) sorted.push_back(zone);
  return sorted;
}

void require_whole_solution(const FileMesh& mesh, const std::string& path) {
  if (!mesh.solution) return;
  const auto& [names, values, constants, cells] = *mesh.solution;
  if (values.size() == names.size() * mesh.points.size() &&
      std::ssize(cells.values) == std::ssize(cells.names) * cell_count(mesh))
    return;
  throw InputError(path + ": some of its zones have a solution, others none");
}

/// Reads the file; a plane mesh of one zone, if allowed, by ranges.
CgnsContents contents_of(const std::string& path, bool may_be_by_ranges) {
  const File file(path, path);
  const auto [cell_dimension, zones, base_path] = first_base(file);
  if (cell_dimension != 2 && cell_dimension != 3)
    throw InputError(path + ": its cells are " + std::to_string(cell_dimension) + "D; 2D and 3D can be read");
  if (zones == 0) throw InputError(path + ": holds no zone");
  CgnsContents contents;
  contents.by_ranges = may_be_by_ranges && cell_dimension == 2 && zones == 1;
  FileMesh& mesh = contents.mesh;
  mesh.dimension = cell_dimension;
  CgnsFamilies families;
  ValuesByKind cell_values;
  std::vector<std::size_t> first_nodes;
  std::vector<std::string> names;
  std::vector<ZoneConnection> connections;
  for (const int zone : zones_in_order(file, zones)) {
    first_nodes.push_back(mesh.points.size());
    ZoneReader reader(file, base_path, zone, first_nodes.size() - 1, zones == 1, contents, families,
                      cell_values);
    reader.read(connections);
    names.push_back(reader.name());
  }
  if (contents.by_ranges) return contents;
  for (const std::vector<double>& values : cell_values) {
    if (mesh.solution) std::ranges::copy(values, std::back_inserter(mesh.solution->cells.values));
  }
  require_whole_solution(mesh, path);
  if (zones > 1)
    unite_nodes(mesh, first_nodes, links_of(connections, names, first_nodes, mesh.points.size(), path));
  if (cell_dimension == 3 && zones > 1) drop_inner_faces(mesh);
  if (cell_dimension == 3) drop_empty_groups(mesh);
  return contents;
}

}  // namespace

CgnsContents read_cgns_by_library(const std::string& path, bool may_be_by_ranges) {
  CgnsContents contents = contents_of(path, may_be_by_ranges);
  if (!contents.by_ranges || find_places(path, contents)) return contents;
  return contents_of(path, false);
}

}  // namespace quadloop::io
