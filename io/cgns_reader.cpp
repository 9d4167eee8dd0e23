#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "io/cgns_file.hpp"
#include "io/cgns_handle.hpp"
#include "io/cgns_names.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

using File = CgnsFile<InputError>;
using Name = std::array<char, 33>;

/// The edges of one BAR_2 (or part of a MIXED) section, by their element numbers.
struct Bars {
  std::string section;
  std::map<cgsize_t, std::array<NodeId, 2>> edges;
};

/// Reads one zone into the mesh; nodes are numbered after those that are already there.
class ZoneReader {
 public:
  ZoneReader(const File& file, int base, int zone, LoadedMesh& loaded) : file_{file}, base_{base}, zone_{zone}, loaded_{loaded} {}

  void read() {
    read_head();
    read_coordinates();
    int sections = 0;
    file_.check(cg_nsections(file_.id(), base_, zone_, &sections));
    for (int section = 1; section <= sections; ++section) read_section(section);
    const std::int32_t block = loaded_.blocks++;
    loaded_.triangle_to_block.resize(loaded_.mesh.triangles.size(), block);
    loaded_.quad_to_block.resize(loaded_.mesh.quads.size(), block);
    read_boundaries();
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
    first_node_ = loaded_.mesh.points.size();
    if (first_node_ + static_cast<std::size_t>(nodes_) > std::numeric_limits<std::int32_t>::max()) refuse("too many nodes for one rank");
  }

  std::vector<double> coordinate(const char* name) const {
    std::vector<double> values(static_cast<std::size_t>(nodes_));
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
      if (!std::isfinite(x[i]) || !std::isfinite(y[i])) refuse("node " + std::to_string(i + 1) + " has a coordinate that is not finite");
      loaded_.mesh.points.push_back({x[i], y[i]});
    }
  }

  NodeId node_of(cgsize_t number) const {
    if (number < 1 || number > nodes_) {
      refuse("an element names node " + std::to_string(number) + ", which is none of 1 to " + std::to_string(nodes_));
    }
    return NodeId{static_cast<std::int32_t>(first_node_ + static_cast<std::size_t>(number) - 1)};
  }

  template <std::size_t width>
  std::array<NodeId, width> row_at(const cgsize_t* numbers) const {
    std::array<NodeId, width> row;
    for (std::size_t k = 0; k < width; ++k) row[k] = node_of(numbers[k]);
    return row;
  }

  void add_element(int type, cgsize_t element, const cgsize_t* numbers) {
    if (type == TRI_3) {
      loaded_.mesh.triangles.push_back(row_at<3>(numbers));
    } else if (type == QUAD_4) {
      loaded_.mesh.quads.push_back(row_at<4>(numbers));
    } else {
      bars_.back().edges.emplace_hint(bars_.back().edges.end(), element, row_at<2>(numbers));
    }
  }

  static std::size_t width_of(int type) { return type == TRI_3 ? 3 : type == QUAD_4 ? 4 : type == BAR_2 ? 2 : 0; }

  void read_section(int section) {
    Name name{};
    ElementType_t type = ElementTypeNull;
    cgsize_t first = 0, last = 0, size = 0;
    int boundary = 0, parents = 0;
    file_.check(cg_section_read(file_.id(), base_, zone_, section, name.data(), &type, &first, &last, &boundary, &parents));
    if (type == NODE) return;
    if (type != MIXED && width_of(type) == 0) {
      refuse("section " + std::string(name.data()) + " holds " + cg_ElementTypeName(type) + "; only TRI_3, QUAD_4, BAR_2 and MIXED can be read");
    }
    file_.check(cg_ElementDataSize(file_.id(), base_, zone_, section, &size));
    std::vector<cgsize_t> data(static_cast<std::size_t>(size));
    bars_.push_back({name.data(), {}});
    if (type == MIXED) {
      std::vector<cgsize_t> offsets(static_cast<std::size_t>(last - first) + 2);
      file_.check(cg_poly_elements_read(file_.id(), base_, zone_, section, data.data(), offsets.data(), nullptr));
      add_mixed(data, first);
    } else {
      file_.check(cg_elements_read(file_.id(), base_, zone_, section, data.data(), nullptr));
      const std::size_t width = width_of(type);
      for (std::size_t i = 0; i + width <= data.size(); i += width) add_element(type, first++, data.data() + i);
    }
  }

  /// Each element is its type, then its nodes.
  void add_mixed(const std::vector<cgsize_t>& data, cgsize_t element) {
    for (std::size_t i = 0; i < data.size();) {
      const int type = static_cast<int>(data[i]);
      const std::size_t width = width_of(type);
      if (width == 0 || i + width >= data.size()) refuse("a MIXED section holds an element that is no triangle, quad or bar");
      add_element(type, element++, data.data() + i + 1);
      i += width + 1;
    }
  }

  void read_boundaries() {
    int count = 0;
    file_.check(cg_nbocos(file_.id(), base_, zone_, &count));
    for (int boundary = 1; boundary <= count; ++boundary) read_boundary(boundary);
    for (Bars& bars : bars_) {
      for (const auto& [element, edge] : bars.edges) boundary_named(bars.section, "none").edges.push_back(edge);
    }
  }

  /// A BC that names nodes instead of edges is passed over: its edges, if the file has them, come as a section.
  void read_boundary(int boundary) {
    Name name{};
    BCType_t type = BCTypeNull;
    PointSetType_t set = PointSetTypeNull;
    cgsize_t count = 0, normals = 0;
    std::array<int, 3> normal{};
    DataType_t normal_type = DataTypeNull;
    int datasets = 0;
    file_.check(cg_boco_info(file_.id(), base_, zone_, boundary, name.data(), &type, &set, &count, normal.data(), &normals, &normal_type, &datasets));
    GridLocation_t location = Vertex;
    file_.check(cg_boco_gridlocation_read(file_.id(), base_, zone_, boundary, &location));
    const bool of_elements = set == ElementRange || set == ElementList || location != Vertex;
    if (!of_elements) return;
    std::vector<cgsize_t> elements(static_cast<std::size_t>(count));
    file_.check(cg_boco_read(file_.id(), base_, zone_, boundary, elements.data(), nullptr));
    if (set == PointRange || set == ElementRange) {
      const cgsize_t first = elements.at(0), last = elements.at(1);
      elements.resize(static_cast<std::size_t>(std::max<cgsize_t>(0, last - first + 1)));
      std::iota(elements.begin(), elements.end(), first);
    }
    BoundaryEdges& edges = boundary_named(full_name(boundary, name.data()), condition_of(boundary, type));
    for (const cgsize_t element : elements) edges.edges.push_back(take_bar(element, edges.name));
  }

  std::array<NodeId, 2> take_bar(cgsize_t element, const std::string& boundary) {
    for (Bars& bars : bars_) {
      const auto found = bars.edges.find(element);
      if (found == bars.edges.end()) continue;
      const std::array<NodeId, 2> edge = found->second;
      bars.edges.erase(found);
      return edge;
    }
    refuse("boundary " + boundary + " names element " + std::to_string(element) + ", which is no BAR_2 or belongs to another boundary");
  }

  std::string full_name(int boundary, const char* name) const {
    int descriptors = 0;
    file_.check(cg_goto(file_.id(), base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", boundary, "end"));
    file_.check(cg_ndescriptors(&descriptors));
    std::string result = name;
    for (int d = 1; d <= descriptors; ++d) {
      Name label{};
      char* text = nullptr;
      file_.check(cg_descriptor_read(d, label.data(), &text));
      if (std::string(label.data()) == full_name_descriptor) result = text;
      cg_free(text);
    }
    return result;
  }

  /// A BC of type FamilySpecified has its type with the family.
  std::string condition_of(int boundary, BCType_t type) const {
    std::array<char, 660> family{};
    file_.check(cg_goto(file_.id(), base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", boundary, "end"));
    if (type != FamilySpecified || cg_famname_read(family.data()) != CG_OK) return condition_of_cgns(type);
    if (!families_) read_families();
    const auto found = families_->find(family.data());
    return found == families_->end() ? "none" : found->second;
  }

  void read_families() const {
    families_.emplace();
    int families = 0;
    file_.check(cg_nfamilies(file_.id(), base_, &families));
    for (int f = 1; f <= families; ++f) {
      Name name{}, condition{};
      int conditions = 0, geometries = 0;
      BCType_t type = BCTypeNull;
      file_.check(cg_family_read(file_.id(), base_, f, name.data(), &conditions, &geometries));
      if (conditions == 0) continue;
      file_.check(cg_fambc_read(file_.id(), base_, f, 1, condition.data(), &type));
      families_->emplace(name.data(), condition_of_cgns(type));
    }
  }

  BoundaryEdges& boundary_named(const std::string& name, const std::string& condition) {
    auto& boundaries = loaded_.mesh.boundaries;
    const auto found = std::find_if(boundaries.begin(), boundaries.end(), [&](const auto& b) { return b.name == name; });
    if (found != boundaries.end()) return *found;
    return boundaries.emplace_back(BoundaryEdges{name, condition, {}});
  }

  void read_solution() {
    int solutions = 0;
    file_.check(cg_nsols(file_.id(), base_, zone_, &solutions));
    for (int s = 1; s <= solutions; ++s) {
      Name name{};
      GridLocation_t location = Vertex;
      file_.check(cg_sol_info(file_.id(), base_, zone_, s, name.data(), &location));
      if (location == Vertex) return read_fields(s);
    }
  }

  void read_fields(int solution) {
    int fields = 0;
    file_.check(cg_nfields(file_.id(), base_, zone_, solution, &fields));
    if (!loaded_.solution) loaded_.solution.emplace();
    Solution& result = *loaded_.solution;
    const auto width = static_cast<std::size_t>(fields);
    if (first_node_ > 0 && result.names.size() != width) refuse("its solution has other variables than the first zone's");
    result.values.resize((first_node_ + static_cast<std::size_t>(nodes_)) * width);
    std::vector<double> column(static_cast<std::size_t>(nodes_));
    for (int f = 1; f <= fields; ++f) {
      Name name{};
      DataType_t type = RealDouble;
      const cgsize_t first = 1;
      file_.check(cg_field_info(file_.id(), base_, zone_, solution, f, &type, name.data()));
      file_.check(cg_field_read(file_.id(), base_, zone_, solution, name.data(), RealDouble, &first, &nodes_, column.data()));
      if (first_node_ == 0) result.names.push_back(variable_name_of_cgns(name.data()));
      for (std::size_t i = 0; i < column.size(); ++i) result.values[(first_node_ + i) * width + static_cast<std::size_t>(f) - 1] = column[i];
    }
  }

  const File& file_;
  int base_, zone_;
  LoadedMesh& loaded_;
  cgsize_t nodes_ = 0;
  std::size_t first_node_ = 0;
  std::vector<Bars> bars_;
  mutable std::optional<std::map<std::string, std::string>> families_;  ///< of the base: family to condition, once it is asked for
};

}  // namespace

LoadedMesh read_cgns(const std::string& path) {
  const File file(path, path, CG_MODE_READ);
  int bases = 0, zones = 0, cell_dimension = 0, physical_dimension = 0;
  Name name{};
  file.check(cg_nbases(file.id(), &bases));
  if (bases == 0) throw InputError(path + ": holds no CGNS base");
  file.check(cg_base_read(file.id(), 1, name.data(), &cell_dimension, &physical_dimension));
  if (cell_dimension != 2) throw InputError(path + ": its cells are " + std::to_string(cell_dimension) + "D, not 2D");
  file.check(cg_nzones(file.id(), 1, &zones));
  LoadedMesh loaded;
  loaded.blocks = 0;
  for (int zone = 1; zone <= zones; ++zone) ZoneReader(file, 1, zone, loaded).read();
  if (zones == 0) throw InputError(path + ": holds no zone");
  loaded.mesh.owned_nodes = static_cast<std::int32_t>(loaded.mesh.points.size());
  return loaded;
}

}  // namespace quadloop
