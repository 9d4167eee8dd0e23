#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "io/cgns/cgns_condition.hpp"
#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_solid_file.hpp"
#include "io/cgns/cgns_values.hpp"
#include "io/model/clean_up.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

using File = CgnsFile<InputError>;
using Name = std::array<char, 33>;

/// A face of a section, until a patch takes it.
struct LooseFace {
  FileBoundary::Face nodes;
  std::size_t section;  ///< index among the sections' names
  bool taken = false;
};

class CgnsSolidReader {
 public:
  explicit CgnsSolidReader(const File& file) : file_{file} {}

  FileMesh read() {
    read_points();
    int sections = 0;
    file_.check(cg_nsections(file_.id(), 1, 1, &sections));
    for (int section = 1; section <= sections; ++section) read_section(section);
    read_conditions();
    take_loose();
    read_solution();
    drop_empty_groups(mesh_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError(file_.shown() + ": " + message);
  }

  void read_points() {
    Name name{};
    std::array<cgsize_t, 9> size{};
    ZoneType_t type = ZoneTypeNull;
    file_.check(cg_zone_read(file_.id(), 1, 1, name.data(), size.data()));
    file_.check(cg_zone_type(file_.id(), 1, 1, &type));
    if (type != Unstructured) refuse("only an unstructured zone can be read");
    nodes_ = size[0];
    cells_ = size[1];
    if (nodes_ < 1) refuse("its zone is said to have " + std::to_string(nodes_) + " nodes");
    std::array<std::vector<double>, 3> columns;
    const cgsize_t first = 1;
    for (int k = 0; k < 3; ++k) {
      columns[k].resize(nodes_);
      const std::string coordinate = std::string("Coordinate") + "XYZ"[k];
      file_.check(cg_coord_read(file_.id(), 1, 1, coordinate.c_str(), RealDouble, &first, &nodes_,
                                columns[k].data()));
    }
    for (cgsize_t i = 0; i < nodes_; ++i) {
      const Point3 p{columns[0][i], columns[1][i], columns[2][i]};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        refuse("node " + std::to_string(i + 1) + " has a coordinate that is not finite");
      mesh_.points.push_back(p);
    }
  }

  static std::size_t width_of(int type) {
    switch (type) {
      case TRI_3: return 3;
      case QUAD_4:
      case TETRA_4: return 4;
      case PYRA_5: return 5;
      case PENTA_6: return 6;
      case HEXA_8: return 8;
      default: return 0;
    }
  }

  template <std::size_t width>
  std::array<std::int32_t, width> row(const cgsize_t* numbers) const {
    std::array<std::int32_t, width> nodes;
    for (std::size_t k = 0; k < width; ++k) {
      if (numbers[k] < 1 || numbers[k] > nodes_)
        refuse("an element names node " + std::to_string(numbers[k]) + ", which is none of 1 to " +
               std::to_string(nodes_));
      nodes[k] = static_cast<std::int32_t>(numbers[k] - 1);
    }
    return nodes;
  }

  void read_section(int section) {
    Name name{};
    ElementType_t type = ElementTypeNull;
    cgsize_t first = 0, last = 0, size = 0;
    int boundary = 0, parents = 0;
    file_.check(
        cg_section_read(file_.id(), 1, 1, section, name.data(), &type, &first, &last, &boundary, &parents));
    if (type == NODE || type == BAR_2) return;
    const std::size_t width = width_of(type);
    if (width == 0)
      refuse("section " + std::string(name.data()) + " holds " + cg_ElementTypeName(type) +
             "; only TETRA_4, PYRA_5, PENTA_6, HEXA_8, TRI_3 and QUAD_4 can be read of three dimensions");
    file_.check(cg_ElementDataSize(file_.id(), 1, 1, section, &size));
    const std::int64_t elements = std::int64_t{last} - first + 1;
    if (first < 1 || elements < 1 || size != elements * static_cast<std::int64_t>(width))
      refuse("section " + std::string(name.data()) + " is said to hold the elements " +
             std::to_string(first) + " to " + std::to_string(last) + ", which its data are not");
    std::vector<cgsize_t> data(size);
    file_.check(cg_elements_read(file_.id(), 1, 1, section, data.data(), nullptr));
    sections_.emplace_back(name.data());
    for (std::int64_t i = 0; i < elements; ++i) add(type, first + i, data.data() + i * width);
  }

  void add(int type, std::int64_t element, const cgsize_t* numbers) {
    switch (type) {
      case TETRA_4: add_volume<4>(element, numbers); break;
      case PYRA_5: add_volume<5>(element, numbers); break;
      case PENTA_6: add_volume<6>(element, numbers); break;
      case HEXA_8: add_volume<8>(element, numbers); break;
      case TRI_3: {
        const auto nodes = row<3>(numbers);
        add_face(element, {nodes[0], nodes[1], nodes[2], FileBoundary::no_node});
        break;
      }
      default: add_face(element, row<4>(numbers));
    }
  }

  template <std::size_t width>
  void add_volume(std::int64_t element, const cgsize_t* numbers) {
    add_cell<kind_of_width<width>()>(mesh_, row<width>(numbers), mesh_.block_named("domain"));
    elements_[width].push_back(element);
  }

  void add_face(std::int64_t element, const FileBoundary::Face& nodes) {
    face_of_element_.emplace(element, faces_.size());
    faces_.push_back({nodes, sections_.size() - 1});
  }

  FileBoundary& patch_named(const std::string& name, const std::string& condition) {
    const std::size_t before = mesh_.boundaries.size();
    FileBoundary& patch = mesh_.boundaries[mesh_.boundary_named(name)];
    if (mesh_.boundaries.size() > before) patch.condition = condition;
    return patch;
  }

  void read_conditions() {
    int count = 0;
    file_.check(cg_nbocos(file_.id(), 1, 1, &count));
    for (int condition = 1; condition <= count; ++condition) read_face_condition(condition);
  }

  /// A BC that names nodes instead of faces is passed over.
  void read_face_condition(int number) {
    const auto condition = read_condition(file_, 1, 1, number, [this](const std::string& s) { refuse(s); });
    if (!condition) return;
    FileBoundary& patch =
        patch_named(full_name(number, condition->name.data()), condition_of(number, condition->type));
    const std::vector<cgsize_t>& elements = condition->elements;
    if (!condition->is_range) {
      for (const cgsize_t element : elements) take(element, patch);
      return;
    }
    if (elements[1] < elements[0])
      refuse("boundary " + patch.name + " is of the elements " + std::to_string(elements[0]) + " to " +
             std::to_string(elements[1]) + ", which is no range");
    for (std::int64_t element = elements[0]; element <= elements[1]; ++element) take(element, patch);
  }

  void take(std::int64_t element, FileBoundary& patch) {
    const auto found = face_of_element_.find(element);
    if (found == face_of_element_.end())
      refuse("boundary " + patch.name + " names element " + std::to_string(element) + ", which is no face");
    faces_[found->second].taken = true;
    patch.faces.push_back(faces_[found->second].nodes);
  }

  void go_to(int condition) const {
    file_.check(cg_goto(file_.id(), 1, "Zone_t", 1, "ZoneBC_t", 1, "BC_t", condition, "end"));
  }

  std::string full_name(int condition, const std::string& name) const {
    int descriptors = 0;
    go_to(condition);
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
  std::string condition_of(int condition, BCType_t type) const {
    std::array<char, 660> family{};
    go_to(condition);
    if (type != FamilySpecified || cg_famname_read(family.data()) != CG_OK) return condition_of_cgns(type);
    int families = 0;
    file_.check(cg_nfamilies(file_.id(), 1, &families));
    for (int f = 1; f <= families; ++f) {
      Name name{}, its_condition{};
      int conditions = 0, geometries = 0;
      file_.check(cg_family_read(file_.id(), 1, f, name.data(), &conditions, &geometries));
      if (conditions == 0 || std::string(name.data()) != family.data()) continue;
      file_.check(cg_fambc_read(file_.id(), 1, f, 1, its_condition.data(), &type));
      return condition_of_cgns_family(type, its_condition.data());
    }
    return "none";
  }

  /// Faces that no BC names belong to a patch of their section's name.
  void take_loose() {
    for (const LooseFace& face : faces_) {
      if (!face.taken) patch_named(sections_[face.section], "none").faces.push_back(face.nodes);
    }
  }

  void read_solution() {
    Field found = read_cgns_values({file_, 1, 1, nodes_, cells_}, elements_);
    if (!found.empty()) mesh_.solution = std::move(found);
  }

  const File& file_;
  FileMesh mesh_;
  cgsize_t nodes_ = 0, cells_ = 0;
  std::array<std::vector<std::int64_t>, 9>
      elements_;  ///< of cells of so many nodes: their numbers in the zone
  std::vector<std::string> sections_;
  std::vector<LooseFace> faces_;
  std::unordered_map<std::int64_t, std::size_t> face_of_element_;
};

}  // namespace

FileMesh read_cgns_solid(const CgnsFile<InputError>& file, int zones) {
  if (zones != 1)
    throw InputError(file.shown() + ": holds " + std::to_string(zones) +
                     " zones; of three dimensions one can be read");
  return CgnsSolidReader(file).read();
}

}  // namespace quadloop
