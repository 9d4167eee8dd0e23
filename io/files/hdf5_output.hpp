#pragma once

// For io/ only: includes the HDF5 library.
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "io/files/hdf5_handle.hpp"
#include "io/files/output_file.hpp"

namespace quadloop::io {

/// An HDF5 file that one rank writes: groups, attributes and small arrays. For large arrays only space is
/// reserved, which all ranks fill later without HDF5 (RowOutput). The bytes depend on the contents alone: no
/// times are stored. Failures are OutputErrors that name the output; after one the file is not touched, as
/// HDF5 may crash on a file that it could not write.
class Hdf5Output {
 public:
  /// Whether the file is created, or was written before.
  enum class State { existing, created };
  /// Whether the links of a file and its groups are indexed by name only, or also by their order of creation.
  enum class LinkOrder { by_name, of_creation };

  Hdf5Output(const StagedFile& staged, State state, LinkOrder order = LinkOrder::by_name);

  hid_t id() const { return file_.id(); }
  void check(bool good) const;
  Hdf5Handle checked(hid_t id, Hdf5Handle::Release release) const;

  /// Creates a group in the file (id()) or in another group.
  Hdf5Handle add_group(hid_t parent, const char* name) const;

  /// Add an attribute of the file or a group: one number, several, or a text of fixed length.
  template <class Number>
  void put_number(hid_t node, const char* name, Number value) const {
    put_attribute(node, name, {file_type<Number>(), memory_type<Number>(), {}, &value});
  }
  template <class Number>
  void put_numbers(hid_t node, const char* name, std::span<const Number> values) const {
    const hsize_t count = values.size();
    put_attribute(node, name, {file_type<Number>(), memory_type<Number>(), {&count, 1}, values.data()});
  }
  void put_text(hid_t node, const char* name, const std::string& text) const;

  /// Writes a dataset of numbers, of the given size in C order.
  template <class Number>
  void put_array(hid_t parent, const char* name, std::span<const hsize_t> size, const Number* values) const {
    put_dataset(parent, name, {file_type<Number>(), memory_type<Number>(), size, values});
  }
  /// The same for texts of varying length. Their bytes are UTF-8, but HDF5 is not told: it converts no text
  /// between character sets, and VTK 9.1 reads with the default.
  void put_texts(hid_t parent, const char* name, std::span<const std::string> texts) const;

  /// Creates a dataset for which only space is reserved, contiguous and not filled. Returns its offset in the
  /// file; negative if it is empty.
  std::int64_t reserve(hid_t parent, const char* name, hid_t type, std::span<const hsize_t> size) const;

  void close() const { check(file_.close() >= 0); }

 private:
  struct Data {
    hid_t type, type_in_memory;
    std::span<const hsize_t> size;  ///< of each dimension; empty: one value
    const void* values;
  };

  Hdf5Handle open(const StagedFile& staged, State state, LinkOrder order) const;
  Hdf5Handle space_of(std::span<const hsize_t> size) const;
  void put_attribute(hid_t node, const char* name, const Data& data) const;
  void put_dataset(hid_t parent, const char* name, const Data& data) const;

  QuietHdf5 quiet_;  // first, so that it outlives what the handles release
  std::string shown_;
  mutable Hdf5Handle file_;  ///< abandoned after a failure
};

}  // namespace quadloop::io
