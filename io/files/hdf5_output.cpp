#include "io/files/hdf5_output.hpp"

#include <vector>

#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"

namespace quadloop::io {

Hdf5Output::Hdf5Output(const StagedFile& staged, State state, LinkOrder order) : shown_{staged.path} {
  file_ = open(staged, state, order);
}

Hdf5Handle Hdf5Output::open(const StagedFile& staged, State state, LinkOrder order) const {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  const char* const name = staged.temporary.c_str();
  if (state == State::existing) return checked(H5Fopen(name, H5F_ACC_RDWR, access.id()), H5Fclose);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  if (order == LinkOrder::of_creation)
    H5Pset_link_creation_order(creation.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return checked(H5Fcreate(name, H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
}

void Hdf5Output::check(bool good) const {
  if (good) return;
  file_.abandon();
  if (quiet_.reason() != 0) refuse_output(shown_, quiet_.reason());
  throw OutputError(shown_ + ": cannot be written; is the disk full?");
}

Hdf5Handle Hdf5Output::checked(hid_t id, Hdf5Handle::Release release) const {
  check(id >= 0);
  return {id, release};
}

Hdf5Handle Hdf5Output::space_of(std::span<const hsize_t> size) const {
  if (size.empty()) return checked(H5Screate(H5S_SCALAR), H5Sclose);
  return checked(H5Screate_simple(size32(size), size.data(), nullptr), H5Sclose);
}

Hdf5Handle Hdf5Output::add_group(hid_t parent, const char* name) const {
  const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  return checked(H5Gcreate2(parent, name, H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose);
}

void Hdf5Output::put_attribute(hid_t node, const char* name, const Data& data) const {
  const Hdf5Handle space = space_of(data.size);
  const Hdf5Handle attribute =
      checked(H5Acreate2(node, name, data.type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute.id(), data.type_in_memory, data.values) >= 0);
}

void Hdf5Output::put_text(hid_t node, const char* name, const std::string& text) const {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), text.size());
  put_attribute(node, name, {type.id(), type.id(), {}, text.data()});
}

void Hdf5Output::put_dataset(hid_t parent, const char* name, const Data& data) const {
  const Hdf5Handle space = space_of(data.size);
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  Hdf5Handle dataset = checked(
      H5Dcreate2(parent, name, data.type, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Dclose);
  check(H5Dwrite(dataset.id(), data.type_in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values) >= 0 &&
        dataset.close() >= 0);
}

void Hdf5Output::put_texts(hid_t parent, const char* name, std::span<const std::string> texts) const {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  std::vector<const char*> pointers;
  pointers.reserve(texts.size());
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t count = pointers.size();
  put_dataset(parent, name, {type.id(), type.id(), {&count, 1}, pointers.data()});
}

std::int64_t Hdf5Output::reserve(hid_t parent, const char* name, hid_t type,
                                 std::span<const hsize_t> size) const {
  const Hdf5Handle space = space_of(size), creation = creation_of_reserved_space();
  Hdf5Handle dataset =
      checked(H5Dcreate2(parent, name, type, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Dclose);
  const auto place = static_cast<std::int64_t>(H5Dget_offset(dataset.id()));
  const bool is_empty = H5Sget_simple_extent_npoints(space.id()) == 0;
  check((place >= 0 || is_empty) && dataset.close() >= 0);
  return place;
}

}  // namespace quadloop::io
