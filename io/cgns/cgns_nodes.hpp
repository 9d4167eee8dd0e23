#pragma once

// For io/ only: includes the HDF5 library.
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "io/files/hdf5_output.hpp"
#include "io/files/output_file.hpp"

namespace quadloop::io {

/// Adds nodes to a CGNS file, on one rank; the contents of large arrays are written later, by all ranks,
/// where space was reserved for them. A node is a group with its name, label and type as attributes and a
/// dataset " data", as specified by the CGNS mapping to HDF5. libcgns is not used, because it cannot reserve
/// space, stores times, and has 32-bit sizes; its time is quadratic in the number of boundaries (40 s for
/// 5000), as it traverses all siblings of each child. Failures are OutputErrors that name the output.
class CgnsNodes {
 public:
  using Node = Hdf5Handle;

  /// A file is created with a root only.
  using State = Hdf5Output::State;

  /// `size_bytes`: of the numbers of nodes and elements in the file, 4 or 8.
  CgnsNodes(const StagedFile& staged, State state, int size_bytes = 4);

  /// Returns the node at a path of names ("/Base/domain").
  Node at(const std::string& path) const;

  /// Add a child without data, with text, with integers (`rows` x `columns` in C order; a list if
  /// `columns` is 0), or with real numbers.
  Node add(const Node& parent, const std::string& name, const char* label) const;
  Node add_text(const Node& parent, const std::string& name, const char* label,
                const std::string& text) const;
  Node add_integers(const Node& parent, const std::string& name, const char* label,
                    std::span<const std::int32_t> values, std::size_t columns = 0) const;
  Node add_sizes(const Node& parent, const std::string& name, const char* label,
                 std::span<const std::int64_t> values, std::size_t columns = 0) const;
  Node add_reals(const Node& parent, const std::string& name, const char* label,
                 std::span<const float> values) const;

  /// Add a list of `count` reals, or of numbers of nodes or elements, for which only space is reserved.
  Node add_array(const Node& parent, const std::string& name, std::int64_t count);
  Node add_array_of_sizes(const Node& parent, const std::string& name, std::int64_t count);
  /// Adds a section: the elements `range` of a type of libcgns, with space for their nodes.
  Node add_section(const Node& zone, const std::string& name, std::int32_t type,
                   const std::array<std::int64_t, 2>& range, std::int64_t nodes_of_each);
  static constexpr const char* elements_name = "ElementConnectivity";
  /// Offsets of these lists in the file, by their paths.
  const std::map<std::string, std::int64_t>& places() const { return places_; }

  void close() { file_.close(); }

 private:
  void check(bool good) const { file_.check(good); }
  Hdf5Handle checked(hid_t id, Hdf5Handle::Release release) const { return file_.checked(id, release); }
  Node group(const Node& parent, const std::string& name, const char* label, const char* type) const;
  void put_text_attribute(const Node& node, const char* name, const Hdf5Handle& type,
                          const std::string& text) const;
  Hdf5Handle dataset(const Node& node, const char* name, hid_t file_type,
                     std::span<const hsize_t> size) const;
  void put_root() const;
  Node reserve(const Node& parent, const std::string& name, const char* type, hid_t file_type,
               std::int64_t count);
  const char* size_type() const { return size_bytes_ == 8 ? "I8" : "I4"; }
  hid_t size_type_in_file() const {
    return size_bytes_ == 8 ? file_type<std::int64_t>() : file_type<std::int32_t>();
  }
  template <class Number>
  void put_table(const Node& node, hid_t file_type, std::span<const Number> values,
                 std::size_t columns) const;
  void put_data(const Node& node, hid_t file_type, hid_t memory_type, std::span<const hsize_t> size,
                const void* data) const;

  Hdf5Output file_;  // first, so that it outlives the handles
  int size_bytes_;
  Hdf5Handle name_type_, type_type_, scalar_, single_, groups_, small_data_, large_data_;
  std::map<std::string, std::int64_t> places_;
};

}  // namespace quadloop::io
