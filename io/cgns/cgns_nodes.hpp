#pragma once

// For io/ only: includes the HDF5 library.
#include <cstdint>
#include <span>
#include <string>

#include "io/files/hdf5_handle.hpp"
#include "io/files/output_file.hpp"

namespace quadloop::io {

/// Adds nodes to a CGNS file that libcgns has written and closed. For each child libcgns traverses all its
/// siblings, so that its time is quadratic in the number of boundaries (40 s for 5000); this is linear. A
/// node is a group with its name, label and type as attributes and a dataset " data", as specified by the
/// CGNS mapping to HDF5. Failures are OutputErrors that name the output.
class CgnsNodes {
 public:
  using Node = Hdf5Handle;

  explicit CgnsNodes(const StagedFile& staged);

  /// Returns the node at a path of names ("/Base/domain").
  Node at(const std::string& path) const;

  /// Add a child without data, with text, with integers (`rows` x `columns` in C order; a list if
  /// `columns` is 0), or with real numbers.
  Node add(const Node& parent, const std::string& name, const char* label) const;
  Node add_text(const Node& parent, const std::string& name, const char* label,
                const std::string& text) const;
  Node add_integers(const Node& parent, const std::string& name, const char* label,
                    std::span<const std::int32_t> values, std::size_t columns = 0) const;
  Node add_reals(const Node& parent, const std::string& name, const char* label,
                 std::span<const float> values) const;

  /// A list of `count` integers written in pieces; must be destroyed before the file.
  class Array {
   public:
    void put(std::span<const std::int32_t> values);

   private:
    friend class CgnsNodes;
    Array(const CgnsNodes& nodes, Hdf5Handle dataset) : nodes_{&nodes}, dataset_{std::move(dataset)} {}
    const CgnsNodes* nodes_;
    Hdf5Handle dataset_;
    hsize_t next_ = 0;
  };
  Array add_array(const Node& parent, const std::string& name, const char* label, std::int64_t count) const;

  void close();

 private:
  void check(bool good) const;
  Hdf5Handle checked(hid_t id, Hdf5Handle::Release release) const;
  Node group(const Node& parent, const std::string& name, const char* label, const char* type) const;
  void put_text_attribute(const Node& node, const char* name, const Hdf5Handle& type,
                          const std::string& text) const;
  Hdf5Handle dataset(const Node& node, hid_t file_type, std::span<const hsize_t> size) const;
  void put_data(const Node& node, hid_t file_type, hid_t memory_type, std::span<const hsize_t> size,
                const void* data) const;

  QuietHdf5 quiet_;  // first, so that it outlives what the handles release
  std::string shown_;
  mutable Hdf5Handle file_;  ///< abandoned after a failed write
  Hdf5Handle name_type_, type_type_, scalar_, single_, groups_, small_data_, large_data_;
};

}  // namespace quadloop::io
