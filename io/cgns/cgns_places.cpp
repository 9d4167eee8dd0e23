#include "io/cgns/cgns_places.hpp"

#include <array>
#include <tuple>

#include "io/files/hdf5_handle.hpp"

namespace quadloop::io {

namespace {

/// Sets the kind of the numbers in a dataset; returns their size in bytes, 0 for other kinds.
hsize_t find_number(const Hdf5Handle& data, CgnsArray& array) {
  using enum CgnsArray::Number;
  const std::array<std::tuple<hid_t, CgnsArray::Number, bool>, 8> kinds{{{H5T_IEEE_F64LE, real_64, false},
                                                                         {H5T_IEEE_F64BE, real_64, true},
                                                                         {H5T_IEEE_F32LE, real_32, false},
                                                                         {H5T_IEEE_F32BE, real_32, true},
                                                                         {H5T_STD_I32LE, integer_32, false},
                                                                         {H5T_STD_I32BE, integer_32, true},
                                                                         {H5T_STD_I64LE, integer_64, false},
                                                                         {H5T_STD_I64BE, integer_64, true}}};
  const Hdf5Handle type(H5Dget_type(data.id()), H5Tclose);
  for (const auto& [id, number, big_endian] : kinds) {
    if (H5Tequal(type.id(), id) <= 0) continue;
    array.number = number;
    array.big_endian = big_endian;
    return H5Tget_size(id);
  }
  return 0;
}

/// Whether an object is in the file itself, not in one that a link refers to.
bool is_in_file(const Hdf5Handle& file, const Hdf5Handle& object) {
  H5O_info_t of_file{}, of_object{};
  return H5Oget_info2(file.id(), &of_file, H5O_INFO_BASIC) >= 0 &&
         H5Oget_info2(object.id(), &of_object, H5O_INFO_BASIC) >= 0 && of_file.fileno == of_object.fileno;
}

bool find_place(const Hdf5Handle& file, hsize_t file_size, CgnsArray& array) {
  if (array.count < 1) return false;
  const auto count = static_cast<hsize_t>(array.count);
  const Hdf5Handle data(H5Dopen2(file.id(), (array.path + "/ data").c_str(), H5P_DEFAULT), H5Dclose);
  if (!data.valid() || !is_in_file(file, data)) return false;
  const Hdf5Handle space(H5Dget_space(data.id()), H5Sclose);
  hsize_t found = 0;
  if (H5Sget_simple_extent_ndims(space.id()) != 1 ||
      H5Sget_simple_extent_dims(space.id(), &found, nullptr) != 1 || found != count)
    return false;
  const haddr_t place = H5Dget_offset(data.id());  // defined only for data in one piece
  const hsize_t size = find_number(data, array);
  if (place == HADDR_UNDEF || size == 0 || place > file_size || count > (file_size - place) / size)
    return false;
  array.place = static_cast<std::int64_t>(place);
  return true;
}

}  // namespace

bool find_places(const std::string& path, CgnsContents& contents) {
  const QuietHdf5 hdf5;
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  hsize_t size = 0;
  if (!file.valid() || H5Fget_filesize(file.id(), &size) < 0) return false;
  bool all = true;
  for_each_array(contents, [&](CgnsArray& array) { all = all && find_place(file, size, array); });
  return all;
}

}  // namespace quadloop::io
