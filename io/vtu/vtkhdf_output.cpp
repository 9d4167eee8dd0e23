#include "io/vtu/vtkhdf_output.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "io/files/hdf5_output.hpp"
#include "io/text/name_index.hpp"
#include "io/vtu/vtkhdf_file.hpp"
#include "io/vtu/vtu_layers.hpp"

namespace quadloop::io {

namespace {

constexpr const char* root_name = "VTKHDF";
constexpr std::array<std::int64_t, 2> format_version{1, 0};

hid_t type_in_file(VtkNumber number) {
  switch (number) {
    case VtkNumber::float64: return file_type<double>();
    case VtkNumber::int64: return file_type<std::int64_t>();
    case VtkNumber::int32: return file_type<std::int32_t>();
    case VtkNumber::uint8: return file_type<std::uint8_t>();
  }
  return -1;
}

/// Name of an array of points or cells in the file.
std::string mesh_array(const std::string& name) {
  if (name == vtk_connectivity) return "Connectivity";
  if (name == vtk_offsets) return "Offsets";
  if (name == vtk_types) return "Types";
  return name;
}

/// The file on rank 0, without the contents of its arrays.
class VtkHdfFrame {
 public:
  explicit VtkHdfFrame(const StagedFile& staged)
      : file_{staged, Hdf5Output::State::created},
        root_{file_.add_group(file_.id(), root_name)},
        point_data_{file_.add_group(root_.id(), "PointData")},
        cell_data_{file_.add_group(root_.id(), "CellData")},
        field_data_{file_.add_group(root_.id(), "FieldData")} {
    file_.put_numbers(root_.id(), "Version", std::span<const std::int64_t>(format_version));
    file_.put_text(root_.id(), "Type", "UnstructuredGrid");
  }

  /// Adds a number for the only piece.
  void put_count(const char* name, std::int64_t count) const {
    const hsize_t pieces = 1;
    file_.put_array(root_.id(), name, std::span(&pieces, 1), &count);
  }

  void put_field(const std::string& name, const std::vector<std::string>& texts) const {
    if (!texts.empty()) file_.put_texts(field_data_.id(), name.c_str(), texts);
  }
  template <class Number>
  void put_field(const std::string& name, const std::vector<Number>& numbers) const {
    const hsize_t count = numbers.size();
    file_.put_array(field_data_.id(), name.c_str(), std::span(&count, 1), numbers.data());
  }

  /// Returns the offset of the array in the file.
  std::int64_t reserve(VtkSection section, const std::string& name, VtkNumber number, std::int64_t rows,
                       int components) const {
    const bool is_data = section == VtkSection::point_data || section == VtkSection::cell_data;
    const Hdf5Handle& group = section == VtkSection::point_data  ? point_data_
                              : section == VtkSection::cell_data ? cell_data_
                                                                 : root_;
    const std::array<hsize_t, 2> size{static_cast<hsize_t>(rows), static_cast<hsize_t>(components)};
    return file_.reserve(group.id(), (is_data ? name : mesh_array(name)).c_str(), type_in_file(number),
                         std::span(size).first(components == 1 ? 1 : 2));
  }

  void close() {
    for (Hdf5Handle* group : {&field_data_, &cell_data_, &point_data_, &root_}) *group = {};
    file_.close();
  }

 private:
  Hdf5Output file_;  // first, so that it outlives the groups
  Hdf5Handle root_, point_data_, cell_data_, field_data_;
};

}  // namespace

/// On rank 0: creates the file; returns the offsets of its arrays.
std::vector<std::int64_t> VtkHdfOutput::create(std::int64_t points, std::int64_t cells) const {
  VtkHdfFrame frame(staged());
  frame.put_count("NumberOfPoints", points);
  frame.put_count("NumberOfCells", cells);
  for_each_array([&](const Array& array) {
    if (array.section == VtkSection::cells && array.name == vtk_connectivity)
      frame.put_count("NumberOfConnectivityIds", array.rows);
  });
  frame.put_field(vtk_boundary_names, boundaries());
  for (const FieldArray& field : fields())
    std::visit([&](const auto& values) { frame.put_field(field.name, values); }, field.values);
  std::vector<std::int64_t> places;
  for_each_array([&](const Array& array) {
    places.push_back(frame.reserve(array.section, array.name, array.number, array.rows, array.components));
  });
  frame.close();
  return places;
}

void VtkHdfOutput::write(std::int64_t points, std::int64_t cells) {
  const Communicator& comm = file().communicator();
  std::vector<std::int64_t> places;
  comm.together([&] {
    if (comm.is_root()) places = create(points, cells);
  });
  comm.broadcast(places);
  auto place = places.begin();
  for_each_array([&](const Array& array) {
    file().move_to(*place++);
    array.write();
  });
  file().close();
}

std::vector<std::string> vtkhdf_variable_names(const std::vector<std::string>& names) {
  DistinctNames distinct;
  for (const char* const name :
       {"", ".", "..", "boundary", "block", vtu_layer_height_asked, vtu_layer_height})
    distinct.reserve(name);
  std::vector<std::string> result;
  for (std::string name : names) {
    std::ranges::replace(name, '/', '_');
    result.push_back(distinct.name(name, [&](const std::string& suffix) { return name + suffix; }));
  }
  return result;
}

}  // namespace quadloop::io
