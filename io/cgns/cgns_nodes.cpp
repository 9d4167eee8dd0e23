#include "io/cgns/cgns_nodes.hpp"

#include <array>
#include <utility>

#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t name_size = 33, type_size = 3;  // including the terminating 0, as in the standard
constexpr hsize_t largest_small_data =
    1024;  // maximum number of values that HDF5 stores in the object header
constexpr const char* data_name = " data";

Hdf5Handle text_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), size);
  return type;
}

Hdf5Handle creation_of_datasets(H5D_layout_t layout) {
  Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  H5Pset_layout(creation.id(), layout);
  return creation;
}

}  // namespace

CgnsNodes::CgnsNodes(const StagedFile& staged, State state, int size_bytes)
    : file_{staged, state, Hdf5Output::LinkOrder::of_creation}, size_bytes_{size_bytes} {
  name_type_ = text_type(name_size);
  type_type_ = text_type(type_size);
  const hsize_t one = 1;
  scalar_ = checked(H5Screate(H5S_SCALAR), H5Sclose);
  single_ = checked(H5Screate_simple(1, &one, nullptr), H5Sclose);
  groups_ = checked(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(groups_.id(), false);
  H5Pset_link_creation_order(groups_.id(),
                             H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);  // order of the children
  small_data_ = creation_of_datasets(H5D_COMPACT);
  large_data_ = creation_of_datasets(H5D_CONTIGUOUS);
  if (state == State::created) put_root();
}

/// As ADF's root, by which libcgns knows its files; texts with the terminating 0.
void CgnsNodes::put_root() const {
  const Node root = at("/");
  put_text_attribute(root, "name", name_type_, "HDF5 MotherNode");
  put_text_attribute(root, "label", name_type_, "Root Node of HDF5 File");
  put_text_attribute(root, "type", type_type_, "MT");
  std::string version = "HDF5 Version " + std::to_string(H5_VERS_MAJOR) + "." +
                        std::to_string(H5_VERS_MINOR) + "." + std::to_string(H5_VERS_RELEASE);
  version.resize(name_size);
  for (const auto& [name, text] :
       {std::pair(" format", std::string("IEEE_LITTLE_32") + '\0'), std::pair(" hdf5version", version)}) {
    const hsize_t length = text.size();
    const Hdf5Handle data = dataset(root, name, H5T_STD_I8LE, std::span(&length, 1));
    check(H5Dwrite(data.id(), H5T_NATIVE_CHAR, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0);
  }
}

CgnsNodes::Node CgnsNodes::at(const std::string& path) const {
  return checked(H5Gopen2(file_.id(), path.c_str(), H5P_DEFAULT), H5Gclose);
}

CgnsNodes::Node CgnsNodes::add(const Node& parent, const std::string& name, const char* label) const {
  return group(parent, name, label, "MT");
}

CgnsNodes::Node CgnsNodes::add_text(const Node& parent, const std::string& name, const char* label,
                                    const std::string& text) const {
  Node node = group(parent, name, label, "C1");
  const hsize_t length = text.size();
  put_data(node, H5T_STD_I8LE, H5T_NATIVE_CHAR, std::span(&length, 1), text.data());
  return node;
}

template <class Number>
void CgnsNodes::put_table(const Node& node, hid_t file_type, std::span<const Number> values,
                          std::size_t columns) const {
  const std::array<hsize_t, 2> size{columns == 0 ? values.size() : values.size() / columns, columns};
  put_data(node, file_type, memory_type<Number>(), std::span(size).first(columns == 0 ? 1 : 2),
           values.data());
}

CgnsNodes::Node CgnsNodes::add_integers(const Node& parent, const std::string& name, const char* label,
                                        std::span<const std::int32_t> values, std::size_t columns) const {
  Node node = group(parent, name, label, "I4");
  put_table(node, file_type<std::int32_t>(), values, columns);
  return node;
}

CgnsNodes::Node CgnsNodes::add_sizes(const Node& parent, const std::string& name, const char* label,
                                     std::span<const std::int64_t> values, std::size_t columns) const {
  Node node = group(parent, name, label, size_type());
  put_table(node, size_type_in_file(), values, columns);
  return node;
}

CgnsNodes::Node CgnsNodes::add_reals(const Node& parent, const std::string& name, const char* label,
                                     std::span<const float> values) const {
  Node node = group(parent, name, label, "R4");
  const hsize_t size = values.size();
  put_data(node, H5T_IEEE_F32LE, H5T_NATIVE_FLOAT, std::span(&size, 1), values.data());
  return node;
}

CgnsNodes::Node CgnsNodes::add_array(const Node& parent, const std::string& name, std::int64_t count) {
  return reserve(parent, name, "R8", file_type<double>(), count);
}

CgnsNodes::Node CgnsNodes::add_array_of_sizes(const Node& parent, const std::string& name,
                                              std::int64_t count) {
  return reserve(parent, name, size_type(), size_type_in_file(), count);
}

CgnsNodes::Node CgnsNodes::reserve(const Node& parent, const std::string& name, const char* type,
                                   hid_t file_type, std::int64_t count) {
  Node node = group(parent, name, "DataArray_t", type);
  const hsize_t size = count;
  const std::int64_t place = file_.reserve(node.id(), data_name, file_type, std::span(&size, 1));
  std::string path(H5Iget_name(node.id(), nullptr, 0), '\0');
  H5Iget_name(node.id(), path.data(), path.size() + 1);
  places_[path] = place;
  return node;
}

CgnsNodes::Node CgnsNodes::add_section(const Node& zone, const std::string& name, std::int32_t type,
                                       const std::array<std::int64_t, 2>& range, std::int64_t nodes_of_each) {
  const std::array<std::int32_t, 2> type_and_parents{type, 0};
  Node section = add_integers(zone, name, "Elements_t", type_and_parents);
  add_sizes(section, "ElementRange", "IndexRange_t", range);
  add_array_of_sizes(section, elements_name, (range[1] - range[0] + 1) * nodes_of_each);
  return section;
}

CgnsNodes::Node CgnsNodes::group(const Node& parent, const std::string& name, const char* label,
                                 const char* type) const {
  Node node =
      checked(H5Gcreate2(parent.id(), name.c_str(), H5P_DEFAULT, groups_.id(), H5P_DEFAULT), H5Gclose);
  put_text_attribute(node, "name", name_type_, name);
  put_text_attribute(node, "label", name_type_, label);
  put_text_attribute(node, "type", type_type_, type);
  const Hdf5Handle flags = checked(
      H5Acreate2(node.id(), "flags", file_type<std::int32_t>(), single_.id(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  const std::int32_t tracked = 1;
  check(H5Awrite(flags.id(), memory_type<std::int32_t>(), &tracked) >= 0);
  return node;
}

void CgnsNodes::put_text_attribute(const Node& node, const char* name, const Hdf5Handle& type,
                                   const std::string& text) const {
  std::array<char, name_size> padded{};
  QUADLOOP_REQUIRE(text.size() < padded.size(), "a CGNS name of more than 32 characters", text);
  text.copy(padded.data(), text.size());
  const Hdf5Handle attribute =
      checked(H5Acreate2(node.id(), name, type.id(), scalar_.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute.id(), type.id(), padded.data()) >= 0);
}

Hdf5Handle CgnsNodes::dataset(const Node& node, const char* name, hid_t file_type,
                              std::span<const hsize_t> size) const {
  hsize_t count = 1;
  for (const hsize_t length : size) count *= length;
  const Hdf5Handle space = checked(H5Screate_simple(size32(size), size.data(), nullptr), H5Sclose);
  const hid_t creation = count <= largest_small_data ? small_data_.id() : large_data_.id();
  return checked(H5Dcreate2(node.id(), name, file_type, space.id(), H5P_DEFAULT, creation, H5P_DEFAULT),
                 H5Dclose);
}

void CgnsNodes::put_data(const Node& node, hid_t file_type, hid_t memory_type, std::span<const hsize_t> size,
                         const void* data) const {
  const Hdf5Handle whole = dataset(node, data_name, file_type, size);
  check(H5Dwrite(whole.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
}

}  // namespace quadloop::io
