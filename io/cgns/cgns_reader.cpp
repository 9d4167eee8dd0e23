#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/cgns/cgns_bars.hpp"
#include "io/cgns/cgns_boundaries.hpp"
#include "io/cgns/cgns_condition.hpp"
#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_solid_file.hpp"
#include "io/cgns/cgns_values.hpp"
#include "io/cgns/cgns_zones.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/files/reading/separate_reader.hpp"
#include "io/model/layers_text.hpp"
#include "io/model/pass_mesh.hpp"
#include "io/model/strip_text.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"

namespace quadloop {

namespace {

using File = CgnsFile<InputError>;
using Name = std::array<char, 33>;

/// Reads one zone into the mesh; nodes are numbered after those that are already there.
class ZoneReader {
 public:
  ZoneReader(const File& file, int base, int zone, LoadedMesh& loaded, CgnsBoundaries& boundaries)
      : file_{file}, base_{base}, zone_{zone}, loaded_{loaded}, boundaries_{boundaries} {}

  void read() {
    read_head();
    read_coordinates();
    int sections = 0;
    file_.check(cg_nsections(file_.id(), base_, zone_, &sections));
    for (int section = 1; section <= sections; ++section) read_section(section);
    const std::int32_t block = loaded_.blocks++;
    loaded_.triangle_to_block.resize(loaded_.mesh.triangles.size(), block);
    loaded_.quad_to_block.resize(loaded_.mesh.quads.size(), block);
    bars_.sort();
    read_periodic();
    read_boundaries();
    read_strips(block);
    read_solution();
  }

 private:
  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError(file_.shown() + ": zone " + loaded_.block_names.back() + ": " + message);
  }

  void read_head() {
    Name name{};
    std::array<cgsize_t, 9> size{};
    ZoneType_t type = ZoneTypeNull;
    file_.check(cg_zone_read(file_.id(), base_, zone_, name.data(), size.data()));
    file_.check(cg_zone_type(file_.id(), base_, zone_, &type));
    loaded_.block_names.emplace_back(name.data());
    if (type != Unstructured) refuse("only unstructured zones can be read");
    nodes_ = size[0];
    cells_ = size[1];
    if (nodes_ < 1) refuse("it is said to have " + std::to_string(nodes_) + " nodes");
    first_node_ = loaded_.mesh.points.size();
    if (first_node_ + nodes_ > std::numeric_limits<std::int32_t>::max())
      refuse("too many nodes for one rank");
  }

  std::vector<double> coordinate(const char* name) const {
    std::vector<double> values(nodes_);
    const cgsize_t first = 1;
    file_.check(cg_coord_read(file_.id(), base_, zone_, name, RealDouble, &first, &nodes_, values.data()));
    return values;
  }

  void read_coordinates() {
    const std::vector<double> x = coordinate("CoordinateX"), y = coordinate("CoordinateY");
    int coordinates = 0;
    file_.check(cg_ncoords(file_.id(), base_, zone_, &coordinates));
    if (coordinates > 2) {
      for (const double z : coordinate("CoordinateZ")) {
        if (z != 0) refuse("its nodes do not lie in the plane z = 0");
      }
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
        refuse("node " + std::to_string(i + 1) + " has a coordinate that is not finite");
      loaded_.mesh.points.push_back({x[i], y[i]});
    }
  }

  NodeId node_of(cgsize_t number) const {
    if (number < 1 || number > nodes_) {
      refuse("an element names node " + std::to_string(number) + ", which is none of 1 to " +
             std::to_string(nodes_));
    }
    return NodeId{static_cast<std::int32_t>(first_node_ + number - 1)};
  }

  template <std::size_t width>
  std::array<NodeId, width> row_at(const cgsize_t* numbers) const {
    std::array<NodeId, width> row;
    for (std::size_t k = 0; k < width; ++k) row[k] = node_of(numbers[k]);
    return row;
  }

  void add_element(int type, std::int64_t element, const cgsize_t* numbers) {
    if (type == TRI_3) {
      loaded_.mesh.triangles.push_back(row_at<3>(numbers));
      elements_[0].push_back(element);
    } else if (type == QUAD_4) {
      loaded_.mesh.quads.push_back(row_at<4>(numbers));
      elements_[1].push_back(element);
    } else {
      bars_.add(element, row_at<2>(numbers));
    }
  }

  static std::size_t width_of(int type) {
    return type == TRI_3 ? 3 : type == QUAD_4 ? 4 : type == BAR_2 ? 2 : 0;
  }

  void read_section(int section) {
    Name name{};
    ElementType_t type = ElementTypeNull;
    cgsize_t first = 0, last = 0, size = 0;
    int boundary = 0, parents = 0;
    file_.check(cg_section_read(file_.id(), base_, zone_, section, name.data(), &type, &first, &last,
                                &boundary, &parents));
    if (type == NODE) return;
    if (type != MIXED && width_of(type) == 0) {
      refuse("section " + std::string(name.data()) + " holds " + cg_ElementTypeName(type) +
             "; only TRI_3, QUAD_4, BAR_2 and MIXED can be read");
    }
    file_.check(cg_ElementDataSize(file_.id(), base_, zone_, section, &size));
    const std::int64_t elements = std::int64_t{last} - first + 1;
    if (first < 1 || elements < 1 || size < 0)
      refuse("section " + std::string(name.data()) + " is said to hold the elements " +
             range_text(first, last));
    bars_.begin_section(name.data());
    std::vector<cgsize_t> data(size);
    const std::int64_t found =
        type == MIXED ? read_mixed(section, data, first) : read_rows(section, type, data, first);
    if (found == elements) return;
    refuse("section " + std::string(name.data()) + " holds " + std::to_string(found) +
           " elements, where its range " + range_text(first, last) + " is of " + std::to_string(elements));
  }

  static std::string range_text(cgsize_t first, cgsize_t last) {
    return std::to_string(first) + " to " + std::to_string(last);
  }

  /// How many elements the section holds.
  std::int64_t read_rows(int section, int type, std::vector<cgsize_t>& data, std::int64_t element) {
    file_.check(cg_elements_read(file_.id(), base_, zone_, section, data.data(), nullptr));
    const std::size_t width = width_of(type);
    for (std::size_t i = 0; i + width <= data.size(); i += width)
      add_element(type, element++, data.data() + i);
    return data.size() / width;
  }

  /// Each element is its type, then its nodes. Where each begins follows from that: the file's own offsets,
  /// of which the library does not tell how many it is going to write, are left alone.
  std::int64_t read_mixed(int section, std::vector<cgsize_t>& data, std::int64_t element) {
    file_.check(cg_poly_elements_read(file_.id(), base_, zone_, section, data.data(), nullptr, nullptr));
    const std::int64_t first = element;
    for (std::size_t i = 0; i < data.size();) {
      const std::size_t width = width_of(data[i]);
      if (width == 0 || i + width >= data.size())
        refuse("a MIXED section holds an element that is no triangle, quad or bar");
      add_element(data[i], element++, data.data() + i + 1);
      i += width + 1;
    }
    return element - first;
  }

  void read_boundaries() {
    int count = 0;
    file_.check(cg_nbocos(file_.id(), base_, zone_, &count));
    for (int boundary = 1; boundary <= count; ++boundary) read_boundary(boundary);
    bars_.for_each_left([&](const std::string& section, const auto& edge) {
      boundaries_.named(loaded_.mesh, section, "none").edges.push_back(edge);
    });
  }

  /// A BC that names nodes instead of edges is passed over: its edges, if the file has them, come as a
  /// section.
  void read_boundary(int boundary) {
    const auto condition =
        read_condition(file_, base_, zone_, boundary, [this](const std::string& s) { refuse(s); });
    if (!condition) return;
    const std::vector<cgsize_t>& elements = condition->elements;
    const std::string full = descriptor(boundary, full_name_descriptor).value_or(condition->name.data());
    BoundaryEdges& edges = boundaries_.named(loaded_.mesh, full, condition_of(boundary, condition->type));
    if (const auto layers = descriptor(boundary, layers_descriptor)) edges.layers = layers_of_text(*layers);
    if (condition->is_range) return take_range(elements[0], elements[1], edges);
    for (const cgsize_t element : elements) take_bar(element, edges);
  }

  void take_range(cgsize_t first, cgsize_t last, BoundaryEdges& edges) {
    if (last < first)
      refuse("boundary " + edges.name + " is of the elements " + range_text(first, last) +
             ", which is no range");
    for (std::int64_t element = first; element <= last; ++element)
      take_bar(element, edges);  // ends at the first that is no bar
  }

  void take_bar(std::int64_t element, BoundaryEdges& edges) {
    const auto edge = bars_.take(element);
    if (!edge) {
      refuse("boundary " + edges.name + " names element " + std::to_string(element) +
             ", which is no BAR_2 or belongs to another boundary");
    }
    edges.edges.push_back(*edge);
  }

  /// Nodes of connectivities that have a node Periodic_t, on this zone's side; each side has its own as a
  /// rule.
  void read_periodic() {
    int count = 0;
    file_.check(cg_nconns(file_.id(), base_, zone_, &count));
    for (int connection = 1; connection <= count; ++connection) {
      std::array<float, 3> centre{}, angle{}, shift{};
      if (cg_conn_periodic_read(file_.id(), base_, zone_, connection, centre.data(), angle.data(),
                                shift.data()) == CG_OK)
        mark_periodic(connection);
    }
  }

  void mark_periodic(int connection) {
    Name name{}, donor{};
    GridLocation_t location = Vertex;
    GridConnectivityType_t type = GridConnectivityTypeNull;
    PointSetType_t set = PointSetTypeNull, donor_set = PointSetTypeNull;
    ZoneType_t donor_zone = ZoneTypeNull;
    DataType_t donor_type = DataTypeNull;
    cgsize_t count = 0, donors = 0;
    file_.check(cg_conn_info(file_.id(), base_, zone_, connection, name.data(), &location, &type, &set,
                             &count, donor.data(), &donor_zone, &donor_set, &donor_type, &donors));
    if (count < 1) return;
    std::vector<cgsize_t> numbers(count);
    file_.check(cg_conn_read_short(file_.id(), base_, zone_, connection, numbers.data()));
    if (set == PointRange && count == 2) {
      if (numbers[1] - numbers[0] > std::max<std::int64_t>(nodes_, bars_.size()))
        refuse("connectivity " + std::string(name.data()) + " is of " + range_text(numbers[0], numbers[1]) +
               ", which is more than there are");
      for (cgsize_t number = numbers[0] + 1; number < numbers[1]; ++number) numbers.push_back(number);
    }
    for (const cgsize_t number : numbers) {
      if (location == Vertex)
        loaded_.periodic_nodes.push_back(node_of(number));
      else if (const auto edge = bars_.find(number))
        loaded_.periodic_nodes.insert(loaded_.periodic_nodes.end(), edge->begin(), edge->end());
    }
  }

  /// Meshes of several zones have none.
  void read_strips(std::int32_t block) {
    file_.check(cg_goto(file_.id(), base_, "Zone_t", zone_, "end"));
    const auto text = block > 0 ? std::nullopt : descriptor_here(strips_descriptor);
    loaded_.mesh.strips = strips_in_comments(text.value_or(""), static_cast<std::int32_t>(nodes_)).strips;
  }

  std::optional<std::string> descriptor(int boundary, const std::string& name) const {
    file_.check(cg_goto(file_.id(), base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", boundary, "end"));
    return descriptor_here(name);
  }

  /// The text of the last descriptor of this name below the node that was gone to, if it has one.
  std::optional<std::string> descriptor_here(const std::string& name) const {
    int descriptors = 0;
    file_.check(cg_ndescriptors(&descriptors));
    std::optional<std::string> result;
    for (int d = 1; d <= descriptors; ++d) {
      Name label{};
      char* text = nullptr;
      file_.check(cg_descriptor_read(d, label.data(), &text));
      if (label.data() == name) result = text;
      cg_free(text);
    }
    return result;
  }

  /// A BC of type FamilySpecified has its type with the family.
  std::string condition_of(int boundary, BCType_t type) {
    std::array<char, 660> family{};
    file_.check(cg_goto(file_.id(), base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", boundary, "end"));
    if (type != FamilySpecified || cg_famname_read(family.data()) != CG_OK) return condition_of_cgns(type);
    return boundaries_.condition_of_family(file_, base_, family.data());
  }

  /// Rows of the triangles of all zones go before the quads'.
  void read_solution() {
    const Field own = read_cgns_values({file_, base_, zone_, nodes_, cells_}, elements_);
    if (own.empty()) return;
    if (first_node_ == 0) {
      loaded_.solution = own;
      return;
    }
    if (!loaded_.solution || own.width() != loaded_.solution->width() ||
        own.cells.width() != loaded_.solution->cells.width())
      refuse("its solution has other variables than the first zone's");
    Field& result = *loaded_.solution;
    result.values.insert(result.values.end(), own.values.begin(), own.values.end());
    const auto width = std::ssize(own.cells.names);
    const auto quads = own.cells.values.begin() + width * std::ssize(elements_[0]);
    std::vector<double>& cells = result.cells.values;
    cells.insert(cells.begin() + width * (std::ssize(loaded_.mesh.triangles) - std::ssize(elements_[0])),
                 own.cells.values.begin(), quads);
    cells.insert(cells.end(), quads, own.cells.values.end());
  }

  const File& file_;
  int base_, zone_;
  LoadedMesh& loaded_;
  CgnsBoundaries& boundaries_;
  cgsize_t nodes_ = 0, cells_ = 0;
  std::array<std::vector<std::int64_t>, 2>
      elements_;  ///< of triangles and of quads: their numbers in the zone
  std::size_t first_node_ = 0;
  CgnsBars bars_;
};

void require_whole_solution(const LoadedMesh& loaded, const std::string& path) {
  if (!loaded.solution) return;
  const Mesh& mesh = loaded.mesh;
  const auto& [names, values, constants, cells] = *loaded.solution;
  if (values.size() == names.size() * mesh.points.size() &&
      cells.values.size() == cells.width() * (mesh.triangles.size() + mesh.quads.size()))
    return;
  throw InputError(path + ": some of its zones have a solution, others none");
}

LoadedMesh read_plane(const File& file, int zones, const std::string& path) {
  LoadedMesh loaded;
  CgnsBoundaries boundaries;
  loaded.blocks = 0;
  std::vector<std::size_t> first_nodes;
  for (int zone = 1; zone <= zones; ++zone) {
    first_nodes.push_back(loaded.mesh.points.size());
    ZoneReader(file, 1, zone, loaded, boundaries).read();
  }
  if (zones == 0) throw InputError(path + ": holds no zone");
  require_whole_solution(loaded, path);
  unite_zones(loaded, first_nodes);
  loaded.mesh.owned_nodes = size32(loaded.mesh.points);
  return loaded;
}

MeshOfFile read_here(const std::string& path) {
  const File file(path, path, CG_MODE_READ);
  const auto [cell_dimension, zones] = first_base(file);
  if (cell_dimension == 3) return read_cgns_solid(file, zones);
  if (cell_dimension == 2) return read_plane(file, zones, path);
  throw InputError(path + ": its cells are " + std::to_string(cell_dimension) + "D; 2D and 3D can be read");
}

}  // namespace

MeshOfFile read_cgns(const std::string& path) {
  return read_separately<MeshOfFile>(path, [&] { return read_here(path); });
}

}  // namespace quadloop
